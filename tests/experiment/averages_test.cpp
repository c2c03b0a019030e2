// Points from impacts: means by hand, and what became of spheres without a rebound against truth.
#include "experiment/averages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "data/dataset.hpp"
#include "experiment/pairing_files.hpp"
#include "validation/studies/pairing_score.hpp"
#include "validation/synthetic/event_stream.hpp"

namespace {

using namespace recoil;

struct Made {
  std::vector<Passage> events;
  PairingResult pairs;

  Made() {
    pairs.height = 1e-3;
    pairs.velocity_spread = 0.01;
  }
  void rebound(double velocity, double restitution, double diameter = 50e-6) {
    const auto at = static_cast<std::uint32_t>(events.size());
    events.push_back({0.0, velocity, 0.0, diameter, 0, 0});
    Impact impact;
    impact.down = impact.up = at;
    impact.incident = velocity;
    impact.rebound = velocity * restitution;
    impact.restitution = restitution;
    impact.diameter = diameter;
    pairs.impacts.push_back(impact);
  }
  void stay(double velocity, double diameter = 50e-6) {
    events.push_back({0.0, velocity, 0.0, diameter, 0, 0});
    Unpaired lone;
    lone.down = static_cast<std::uint32_t>(events.size() - 1);
    lone.incident = velocity;
    pairs.unpaired.push_back(lone);
  }
};

TEST(Averages, MeansByHand) {
  Made made;
  for (const double e : {0.7, 0.8, 0.9, 0.8, 0.8}) made.rebound(1.0 + 0.1 * (e - 0.8), e);
  const Averages result = average(made.events, {"run"}, made.pairs, {});
  ASSERT_EQ(result.points.size(), 1U);
  const PointMean& point = result.points[0];
  EXPECT_EQ(point.series, "run");
  EXPECT_NEAR(point.restitution, 0.8, 1e-12);
  EXPECT_NEAR(point.scatter, std::sqrt(0.02 / 4.0), 1e-12);
  EXPECT_NEAR(point.restitution_sd, std::sqrt(0.02 / 4.0 / 5.0), 1e-12);
  EXPECT_NEAR(point.velocity, 1.0, 1e-12);
  EXPECT_NEAR(point.velocity_sd, 0.1 * point.restitution_sd, 1e-12);
  EXPECT_NEAR(point.diameter, 50e-6, 1e-15);
  EXPECT_EQ(point.events(), 5U);
  EXPECT_EQ(point.captured, 0U);
}

TEST(Averages, OneDiameterForASeriesCountsEverySphere) {
  Made made;
  for (int i = 0; i < 6; ++i) {
    made.rebound(1.0, i % 2 == 0 ? 0.7 : 0.8, 40e-6);
    made.rebound(2.0, i % 2 == 0 ? 0.8 : 0.9, 60e-6);
  }
  for (int i = 0; i < 3; ++i) made.stay(1.0, 100e-6);
  AverageOptions by;
  const Averages own = average(made.events, {"run"}, made.pairs, by);
  ASSERT_EQ(own.points.size(), 2U);
  EXPECT_NEAR(own.points[0].diameter, (6 * 40e-6 + 3 * 100e-6) / 9, 1e-15);
  EXPECT_NEAR(own.points[1].diameter, 60e-6, 1e-15);
  by.mean_diameter = true;
  const Averages one = average(made.events, {"run"}, made.pairs, by);
  ASSERT_EQ(one.points.size(), 2U);
  for (const PointMean& point : one.points) {
    EXPECT_NEAR(point.diameter, (6 * 40e-6 + 6 * 60e-6 + 3 * 100e-6) / 15, 1e-15);
  }
  EXPECT_EQ(one.points[0].restitution, own.points[0].restitution);
}

TEST(Averages, CapturedIsWhatTheLostCannotExplain) {
  Made made;
  for (int i = 0; i < 30; ++i) made.rebound(1.0, i % 2 == 0 ? 0.78 : 0.82);
  for (int i = 0; i < 10; ++i) made.stay(1.0);
  made.pairs.missed_share = 0.0625;  // 30 * 0.0625 / 0.9375 = 2 lost
  Averages result = average(made.events, {"run"}, made.pairs, {});
  EXPECT_NEAR(result.lost, 2.0, 1e-12);
  EXPECT_EQ(result.captured, 8U);
  EXPECT_EQ(result.points[0].events(), 38U);
  // 10 where 9 are expected is no excess.
  made.pairs.options.lost_share = 9.0 / 39.0;
  result = average(made.events, {"run"}, made.pairs, {});
  EXPECT_EQ(result.captured, 0U);
  EXPECT_NEAR(result.lost, 9.0, 1e-12);
  EXPECT_NEAR(result.unresolved, 1.0, 1e-12);
}

// With a thousand lost in one bin exp(-mean) is zero, and a tail summed from there is 1.
TEST(Averages, CapturesAreFoundAmongThousands) {
  Made made;
  for (int i = 0; i < 3000; ++i) made.rebound(1.0, i % 2 == 0 ? 0.78 : 0.82);
  for (int i = 0; i < 2500; ++i) made.stay(1.0);
  made.pairs.missed_share = 0.25;  // 3000 * 0.25 / 0.75 = 1000 lost
  AverageOptions by;
  by.per_bin = 10000;
  const Averages result = average(made.events, {"run"}, made.pairs, by);
  ASSERT_EQ(result.points.size(), 1U);
  EXPECT_NEAR(result.lost, 1000.0, 1e-9);
  EXPECT_EQ(result.captured, 1500U);
}

TEST(Averages, SlowReboundsAreExpectedBelowTheLimit) {
  Made made;
  made.pairs.height = 0.09 / (2.0 * 9.80665);  // sqrt(2 g h) = 0.3 m/s: e below 0.3 unseen at 1 m/s
  for (int i = 0; i < 40; ++i) made.rebound(1.0, i % 2 == 0 ? 0.4 : 0.6);
  for (int i = 0; i < 20; ++i) made.stay(1.0);
  const Averages result = average(made.events, {"run"}, made.pairs, {});
  // scatter 0.1 sqrt(40 / 39) = 0.10127, distance 1.975 sd, beyond it 2.4143 % of a normal.
  EXPECT_NEAR(result.too_slow, 40.0 * 0.024143 / (1.0 - 0.024143), 2e-3);
  EXPECT_TRUE(result.points[0].slow_known);
  EXPECT_EQ(result.captured, 19U);
}

TEST(Averages, AllCapturedIsAPoint) {
  Made made;
  for (int i = 0; i < 12; ++i) made.stay(0.3);
  const Averages result = average(made.events, {"run"}, made.pairs, {});
  ASSERT_EQ(result.points.size(), 1U);
  EXPECT_EQ(result.points[0].captured, 12U);
  EXPECT_NE(points_csv(result).find("run,50,0.3,,,,12,12\n"), std::string::npos)
      << points_csv(result);
}

TEST(Averages, DropHeightsAreNotMixedNorOneCutByItsErrors) {
  Made made;
  for (int i = 0; i < 200; ++i) {  // 1 % of error, 100 impacts at each of two velocities
    const double error = 0.01 * std::sqrt(2.0) * std::sin(i * 0.7);
    made.rebound((i < 100 ? 1.0 : 1.4) * (1.0 + error), 0.8 * (1.0 - error));
  }
  const Averages result = average(made.events, {"run"}, made.pairs, {});
  ASSERT_EQ(result.points.size(), 2U);
  EXPECT_NEAR(result.points[0].velocity, 1.0, 2e-3);
  EXPECT_NEAR(result.points[1].velocity, 1.4, 3e-3);
  // Continuous velocities are cut by number.
  Made wide;
  for (int i = 0; i < 400; ++i) wide.rebound(0.5 * std::pow(10.0, i / 400.0), 0.8);
  EXPECT_EQ(average(wide.events, {"run"}, wide.pairs, {}).points.size(), 10U);
}

// Errors that are small beside the distances of velocities do not make isolated impacts.
TEST(Averages, EveryReboundIsInAPoint) {
  struct Case {
    double error;     ///< of a velocity [1]
    std::size_t few;  ///< impacts at a velocity of their own
  };
  for (const auto& [error, few] :
       {Case{0.01, 0}, Case{0.0005, 0}, Case{1e-6, 0}, Case{0.0005, 3}}) {
    Made made;
    made.pairs.velocity_spread = error;
    for (int i = 0; i < 500; ++i) {  // 0.35 to 1.6 m/s, evenly but for the golden ratio's shifts
      made.rebound(0.35 + 1.25 * std::fmod(0.618033988749895 * i, 1.0), 0.8);
    }
    for (std::size_t i = 0; i < few; ++i) made.rebound(9.0, 0.7);
    const Averages result = average(made.events, {"run"}, made.pairs, {});
    std::size_t rebounds = 0;
    std::size_t bins = 0;
    for (const PointMean& point : result.points) {
      rebounds += point.rebounds;
      if (point.rebounds == 1) continue;
      EXPECT_NEAR(static_cast<double>(point.rebounds), 40.0, 5.0) << error;
      ++bins;
    }
    EXPECT_EQ(rebounds, 500 + few);
    EXPECT_EQ(result.points.size(), bins + few);
    EXPECT_EQ(result.single, few);
  }
}

TEST(Averages, SizeClasses) {
  Made made;
  for (int i = 0; i < 60; ++i) made.rebound(1.0, 0.5 + 0.005 * i, (20.0 + i) * 1e-6);
  AverageOptions options;
  options.size_edges = {24.5e-6, 45.5e-6, 64.5e-6};
  Averages result = average(made.events, {"run"}, made.pairs, options);
  ASSERT_EQ(result.points.size(), 2U);
  EXPECT_EQ(result.points[0].series, "run 24.5-45.5 um");
  EXPECT_EQ(result.outside_sizes, 60U - 40U);
  EXPECT_GT(result.points[1].restitution, result.points[0].restitution + 0.05);
  options.size_edges.clear();
  options.size_classes = 3;
  result = average(made.events, {"run"}, made.pairs, options);
  ASSERT_EQ(result.points.size(), 3U);
  for (const PointMean& point : result.points) EXPECT_EQ(point.rebounds, 20U);
}

struct Truth {
  double captured = 0.0;
  double too_slow = 0.0;
  double lost = 0.0;
};

Truth truth_of(const stream::Stream& stream) {
  Truth truth;
  for (std::size_t line = 2; line < stream.rows.size(); ++line) {
    const stream::Row& row = stream.rows[line];
    if (!row.usable || !row.down || row.impact != 1) continue;
    truth.captured += stream.fate[line] == stream::Fate::captured ? 1.0 : 0.0;
    truth.too_slow += stream.fate[line] == stream::Fate::too_slow ? 1.0 : 0.0;
    truth.lost += stream.fate[line] == stream::Fate::rebound_unseen ? 1.0 : 0.0;
  }
  return truth;
}

struct Sorted {
  Truth truth;
  Averages averages;
};

Sorted sorted(const stream::Design& design, const PairingOptions& options = {}) {
  const stream::Stream events = stream::simulate(design);
  const PassageTable table = stream::read(events);
  AverageOptions by_size;
  by_size.size_classes = 4;
  return {truth_of(events),
          average(table.passages, table.series, pair_passages(table.passages, options), by_size)};
}

TEST(Averages, FatesAgreeWithTheTruth) {
  stream::Design design;
  design.spheres = 8000;
  design.drop_heights = {0.01, 0.014, 0.02, 0.04, 0.1};
  const Sorted result = sorted(design);
  ASSERT_GT(result.truth.captured, 500.0);
  ASSERT_GT(result.truth.lost, 200.0);
  EXPECT_NEAR(static_cast<double>(result.averages.captured),
              result.truth.captured + result.truth.too_slow, 0.1 * result.truth.captured);
  EXPECT_NEAR(result.averages.lost, result.truth.lost, 0.25 * result.truth.lost);
}

TEST(Averages, ReboundsThatAreMissedMoreOftenNeedTheStatedShare) {
  stream::Design design;
  design.spheres = 8000;
  design.drop_heights = {0.02, 0.1, 0.5};
  design.rebound_seen = 0.8;
  const Sorted assumed = sorted(design);
  const double all = assumed.truth.captured + assumed.truth.too_slow;
  EXPECT_GT(static_cast<double>(assumed.averages.captured), 1.5 * all)
      << "if the assumption did no harm, the option would not be needed";
  // The share among the fastest says so, and with it the count is right.
  EXPECT_NEAR(assumed.averages.fast_unpaired, 1.0 - 0.97 * 0.8, 0.03);
  PairingOptions options;
  options.lost_share = assumed.averages.fast_unpaired;
  const Sorted stated = sorted(design, options);
  EXPECT_NEAR(static_cast<double>(stated.averages.captured), all, 0.25 * all);
}

TEST(Histograms, SturgesByHand) {
  std::vector<double> values;
  for (int i = 0; i < 100; ++i) values.push_back(i);
  const Histogram histogram = sturges(values);  // 1 + log2(100) = 7.64
  ASSERT_EQ(histogram.counts.size(), 8U);
  EXPECT_DOUBLE_EQ(histogram.width, 99.0 / 8.0);
  EXPECT_EQ(histogram.counts[0], 13U);  // 0 to 12, below 12.375
  std::size_t sum = 0;
  for (const std::size_t count : histogram.counts) sum += count;
  EXPECT_EQ(sum, 100U);
  EXPECT_EQ(sturges(std::vector<double>(64, 1.0)).counts, std::vector<std::size_t>{64});
  values.resize(64);
  EXPECT_EQ(sturges(values).counts.size(), 7U);  // 1 + log2(64), exactly
  EXPECT_TRUE(sturges({}).counts.empty());
}

TEST(Histograms, FreedmanDiaconisByHand) {
  std::vector<double> values;
  for (int i = 0; i <= 1000; ++i) values.push_back(i);
  // quartiles 249.5 and 750.5, of ranks 1002 p: width 2 * 501 / 1001^(1/3) = 100.167, 10 bins
  EXPECT_EQ(freedman_diaconis(values).counts.size(), 10U);
  std::vector<double> most_alike(100, 5.0);
  most_alike[0] = 1.0;
  EXPECT_EQ(freedman_diaconis(most_alike).counts.size(), sturges(most_alike).counts.size());
  std::vector<double> far = values;
  far.push_back(1e9);
  EXPECT_EQ(freedman_diaconis(far).counts.size(), 2000U);
}

}  // namespace
