#include "plot/plot.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "plot/gnuplot_script.hpp"

namespace recoil::plot {
namespace {

TEST(Range, HoldsAllFiniteValues) {
  const Range range = range_of({2.0, NAN, 4.0, INFINITY}, 0.1);
  EXPECT_DOUBLE_EQ(range.lower, 1.8);
  EXPECT_DOUBLE_EQ(range.upper, 4.2);
  EXPECT_TRUE(range.holds(4.2));
  EXPECT_FALSE(range.holds(1.7));
  EXPECT_EQ(range_of({}, 0.1).upper, 1.0);
  EXPECT_LT(range_of({5.0}, 0.1).lower, 5.0) << "room around a single value";
}

TEST(Range, OfALogarithmicAxisHasItsMarginInTheRatio) {
  const Range range = log_range_of({0.0, 1.0, 100.0, -3.0}, 0.5);
  EXPECT_NEAR(range.lower, 0.1, 1e-12);
  EXPECT_NEAR(range.upper, 1000.0, 1e-9);
}

TEST(Range, BetweenQuantiles) {
  const Range range = quantile_range({5.0, 1.0, 2.0, NAN, 3.0, 4.0}, 0.25, 0.75);
  EXPECT_EQ(range.lower, 2.0);
  EXPECT_EQ(range.upper, 4.0);
}

TEST(Scaling, BringsNumbersBetweenOneAndAThousand) {
  EXPECT_EQ(scaling_for(0.5, "s/m").unit, "s/m");
  const Scaling small = scaling_for(3.1e-3, "s/m");
  EXPECT_DOUBLE_EQ(small.factor, 1e3);
  EXPECT_EQ(small.unit, "10⁻³ s/m");
  EXPECT_EQ(scaling_for(2.5e12, "Pa").unit, "10¹² Pa");
  EXPECT_EQ(scaling_for(0.0, "Pa").factor, 1.0);
}

TEST(Ticks, OfALogarithmicAxisLieInItsRange) {
  EXPECT_EQ(log_ticks({0.9, 12.0}), (std::vector<double>{1.0, 2.0, 5.0, 10.0}));
  const std::vector<double> decades = log_ticks({0.1, 1000.0});
  ASSERT_EQ(decades.size(), 5U);
  EXPECT_DOUBLE_EQ(decades.front(), 0.1);
  EXPECT_DOUBLE_EQ(decades.back(), 1000.0);
  EXPECT_EQ(log_ticks({1.0, 6.0}), (std::vector<double>{1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0}));
}

TEST(Ticks, AreRoundAndAboutAsManyAsAsked) {
  EXPECT_DOUBLE_EQ(round_step({0.0, 10.0}, 5), 2.0);
  EXPECT_DOUBLE_EQ(round_step({0.0, 0.0098}, 5), 0.002);
  EXPECT_DOUBLE_EQ(round_step({2.0, 5.0}, 3), 1.0);
  EXPECT_EQ(round_step({1.0, 1.0}, 3), 0.0);
}

TEST(Names, AreFitForIds) {
  EXPECT_EQ(plot_name("overview-wall 1990/a_b"), "overview-wall-1990-a-b");
  EXPECT_EQ(plot_name("1990"), "f-1990");
  EXPECT_EQ(plot_name("'><"), "f-");
}

TEST(Data, OfAPictureAreColumnsWithUnits) {
  Points points{{1.0, 2.0}, {0.5, 0.6}};
  points.with_sd({0.1, 0.2});
  points.name = "measured";
  Plot plot;
  plot.x = {"V", "m/s"};
  plot.y = {"e"};
  plot.layers = {Rule{}, points, Line{{1.0}, {0.7}}};
  const Picture picture{"p", "", 1, 1, {plot}};
  const std::vector<DataTable> tables = data_of(picture);
  ASSERT_EQ(tables.size(), 2U) << "a rule holds no data";
  EXPECT_EQ(tables[0].name, "measured");
  ASSERT_EQ(tables[0].columns.size(), 4U);
  EXPECT_EQ(tables[0].columns[0].name, "V");
  EXPECT_EQ(tables[0].columns[0].unit, "m/s");
  EXPECT_EQ(tables[0].columns[1].values, points.y);
  EXPECT_EQ(tables[0].columns[3].name, "e, upper");
  EXPECT_NEAR(tables[0].columns[3].values[1], 0.8, 1e-12);
}

TEST(Csv, SharesTheRowsOfLayersOverTheSamePlaces) {
  Plot plot;
  plot.x = {"V", "m/s"};
  plot.y = {"e"};
  Points points{{1.0, 2.5}, {0.5, NAN}};
  points.name = "measured, by hand";
  Line fit{{1.0, 2.0, 3.0}, {0.123456, 0.25, 1.0 / 3.0}};
  fit.name = "the \"fit\"";
  Line other{{1.0, 2.0, 3.0}, {0.0, -0.0, 2e-7}};
  plot.layers = {fit, Rule{}, points, other, Line{{1.0, 2.0, 3.0}, {7.0, 8.0, 9.0}}};
  EXPECT_EQ(csv_of({"p", "", 1, 1, {plot}}),
            "V [m/s],\"the \"\"fit\"\": e\",\"measured, by hand: e\",e,e (2)\n"
            "1,0.12346,,0,7\n"
            "2,0.25,,0,8\n"
            "3,0.33333,,2e-07,9\n"
            "1,,0.5,,\n"
            "2.5,,,,\n");
}

TEST(Csv, HasTheNamesThatAnAxisGivesAndTheHeadingsOfPlots) {
  Plot plot;
  plot.heading = "one\nof two";
  plot.x = {"C_H", "s/m"};
  plot.y.ticks = {{0.0, "Wald"}, {1.0, "BCa"}, {2.0, "2"}};
  plot.layers = {Spans{{1.0, 0.0, 2.0}, {1.0, 3.0, 5.0}, {2.0, 4.0, 6.0}}};
  Plot second;
  second.layers = {Discs{{1.0}, {2.0}, {3.0}}};
  EXPECT_EQ(csv_of({"p", "", 1, 1, {plot, second}}),
            "one of two: y,\"one of two: C_H, lower [s/m]\",\"one of two: C_H, upper [s/m]\","
            "plot 2: x,plot 2: y,plot 2: value\n"
            "BCa,1,2,,,\n"
            "Wald,3,4,,,\n"
            "2,5,6,,,\n"
            ",,,1,2,3\n");
}

TEST(Csv, OfAPictureWithoutDataIsEmpty) {
  Plot plot;
  plot.layers = {Rule{}, Region{}};
  EXPECT_EQ(csv_of({"p", "", 1, 1, {plot}}), "");
}

}  // namespace
}  // namespace recoil::plot
