#include "plot/plot.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "plot/draw.hpp"

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

TEST(Csv, HasErrorBarsValuesAndUnits) {
  Points points{{1.0, 2.0}, {0.5, 0.6}};
  points.with_sd({0.1, 0.2});
  points.name = "measured";
  Plot plot;
  plot.x = {"V", "m/s"};
  plot.y = {"e"};
  plot.layers = {points, Discs{{1.0}, {2.0}, {3.0}}};
  EXPECT_EQ(csv_of({"p", "", 1, 1, {plot}}),
            "V [m/s],measured: e,\"measured: e, lower\",\"measured: e, upper\",e,value\n"
            "1,0.5,0.4,0.6,,\n"
            "2,0.6,0.4,0.8,,\n"
            "1,,,,2,3\n");
}

TEST(Csv, OfAPictureWithoutDataIsEmpty) {
  Plot plot;
  plot.layers = {Rule{}, Region{}};
  EXPECT_EQ(csv_of({"p", "", 1, 1, {plot}}), "");
}

}  // namespace
}  // namespace recoil::plot
