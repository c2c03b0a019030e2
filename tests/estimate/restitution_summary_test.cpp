// What points say of e without a model. The expected numbers were made with numpy and scipy
// (lstsq, stats.t, stats.f, stats.norm) from the formulas in the comments.
#include "estimate/restitution_summary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

namespace recoil {
namespace {

struct Row {
  std::size_t series;
  double velocity, restitution;
};

Dataset dataset_of(const std::vector<Row>& rows, double sd = 0.0) {
  Dataset data;
  data.id = "made";
  for (const Row& row : rows) {
    while (data.series.size() <= row.series) {
      data.series.push_back(std::string(1, static_cast<char>('a' + data.series.size())));
    }
    ImpactPoint point;
    point.series = row.series;
    point.diameter = 0.03;
    point.incident_velocity = row.velocity;
    point.restitution = row.restitution;
    if (sd > 0.0) point.restitution_sd = sd;
    data.points.push_back(point);
  }
  return data;
}

const std::vector<Row> two_series = {{0, 1.0, 0.80}, {0, 2.0, 0.78}, {0, 4.0, 0.77},
                                     {0, 8.0, 0.73}, {1, 1.0, 0.70}, {1, 2.0, 0.69},
                                     {1, 4.0, 0.66}, {1, 8.0, 0.64}};

void expect_interval(const std::optional<std::array<double, 2>>& found, double lower,
                     double upper) {
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR((*found)[0], lower, 1e-9);
  EXPECT_NEAR((*found)[1], upper, 1e-9);
}

TEST(RestitutionSummary, MeansSlopeAndDifferenceFromTheScatter) {
  const RestitutionSummary found = summarise_restitution({dataset_of(two_series)});
  ASSERT_EQ(found.means.size(), 2U);
  EXPECT_EQ(found.means[0].points, 4);
  EXPECT_NEAR(found.means[0].value, 0.77, 1e-12);
  // mean -+ t(3) s / sqrt(4)
  expect_interval(found.means[0].interval, 0.723155658769668, 0.816844341230332);
  // Ordinary least squares with an intercept for each series, 5 degrees of freedom.
  EXPECT_NEAR(*found.velocity.value, -0.07142145404007827, 1e-12);
  expect_interval(found.velocity.interval, -0.09061111718766808, -0.05223179089248846);
  EXPECT_NEAR(*found.velocity.p_value, 0.00021125306041242564, 1e-9);
  EXPECT_NEAR(*found.series.value, 0.0975, 1e-12);
  expect_interval(found.series.interval, 0.08458298613405404, 0.11041701386594469);
  EXPECT_NEAR(*found.series.p_value, 6.708934509697094e-06, 1e-12);
  EXPECT_EQ(found.most_different, (std::array<std::size_t, 2>{0, 1}));
}

// e rises near capture and falls again: no slope, but a parabola in x = log10 V. By numpy and
// scipy: lstsq of [1, x] and [1, x, x^2] / sd, and the larger one of chi2.sf(q, k) and f.sf(q / k /
// s^2, k, dof) with q = b' C^-1 b of the k coefficients behind the intercept.
TEST(RestitutionSummary, AParabolaShowsWhatASlopeDoesNot) {
  const std::vector<double> velocities = {0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0};
  const auto summary = [&](const std::vector<double>& restitutions) {
    std::vector<Row> rows;
    for (std::size_t i = 0; i < velocities.size(); ++i) {
      rows.push_back({0, velocities[i], restitutions[i]});
    }
    return summarise_restitution({dataset_of(rows, 0.02)});
  };
  const RestitutionSummary arch = summary({0.52, 0.68, 0.80, 0.86, 0.87, 0.82, 0.71, 0.55});
  EXPECT_NEAR(*arch.velocity.p_value, 0.8276531835456677, 1e-9);
  EXPECT_NEAR(*arch.bend, 1.1626862036466014e-08, 1e-13);
  EXPECT_EQ(arch.velocities, (std::array<double, 2>{0.5, 64.0}));
  EXPECT_EQ(arch.values, (std::array<double, 2>{0.52, 0.87}));
  const RestitutionSummary flat = summary({0.80, 0.82, 0.79, 0.83, 0.78, 0.81, 0.80, 0.82});
  EXPECT_NEAR(*flat.bend, 0.8970614147968622, 1e-9);
}

TEST(RestitutionSummary, StatedErrorsThatAreLargerThanTheScatterDecide) {
  const RestitutionSummary found = summarise_restitution({dataset_of(two_series, 0.03)});
  // The scatter alone would give 0.0468 to either side of the mean, the stated error 0.0294.
  expect_interval(found.means[0].interval, 0.723155658769668, 0.816844341230332);
  expect_interval(found.velocity.interval, -0.13318888998109746, -0.009654018099058873);
  EXPECT_NEAR(*found.velocity.p_value, 0.02343308324225098, 1e-9);
  // The stated errors alone would give 4.3e-06: the larger p-value counts, that of the scatter.
  EXPECT_NEAR(*found.series.p_value, 6.708934509697094e-06, 1e-12);
}

TEST(RestitutionSummary, AnErrorThatAHeightSharesDoesNotAverageOut) {
  Dataset data = dataset_of(std::vector<Row>(10, {0, 1.0, 0.8}), 0.01);
  for (ImpactPoint& point : data.points) {
    point.setting = "500 mm";
    point.setting_velocity_sd = 0.02;
  }
  // 1.959964 (0.01^2 / 10 + (0.8 * 0.02)^2)^(1/2)
  const auto found = summarise_restitution({data}).means[0].interval;
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR((*found)[1] - 0.8, 0.0319660, 1e-6);
}

TEST(RestitutionSummary, HeightsThatScatterMoreThanTheirDropsCountAsOneReadingEach) {
  std::vector<Row> rows;
  const double velocity[] = {2.0, 3.0, 4.0, 6.0};
  const double restitution[] = {0.60, 0.66, 0.58, 0.63};
  for (int k = 0; k < 4; ++k) {
    for (const double off : {-0.001, 0.0, 0.001}) {
      rows.push_back({0, velocity[k], restitution[k] + off});
    }
  }
  const RestitutionSummary found = summarise_restitution({dataset_of(rows)});
  // The four means on a line, 2 degrees of freedom.
  EXPECT_NEAR(*found.velocity.value, 0.017753179695428417, 1e-12);
  expect_interval(found.velocity.interval, -0.5083339478655816, 0.5438403072564385);
  EXPECT_NEAR(*found.velocity.p_value, 0.897867770255, 1e-9);
  ASSERT_EQ(found.means.size(), 5U);  // the series and its four heights
  EXPECT_FALSE(found.means[0].velocity.has_value());
  EXPECT_NEAR(*found.means[3].velocity, 4.0, 1e-12);
  EXPECT_NEAR(found.means[3].value, 0.58, 1e-12);
  EXPECT_EQ(found.means[3].points, 3);
}

// One number at a time: 0.80 three times in each of the launches 0.78, ..., 0.82. The mean of a
// launch is one reading: 0.80 -+ t(4) s / sqrt(5) with s = sqrt(0.00025), not t(14) of 15 points.
TEST(RestitutionSummary, TheScatterOfAMeanIsThatBetweenLaunches) {
  std::vector<Row> rows;
  for (int launch = 0; launch < 5; ++launch) {
    for (int k = 0; k < 3; ++k) rows.push_back({0, 1.0 + k, 0.78 + 0.01 * launch});
  }
  Dataset data = dataset_of(rows);
  for (std::size_t i = 0; i < rows.size(); ++i) data.points[i].launch = std::to_string(i / 3);
  const RestitutionSummary found = summarise_restitution({data});
  ASSERT_FALSE(found.means.empty());
  EXPECT_EQ(found.means.front().points, 15);
  EXPECT_EQ(found.means.front().launches, 5);
  expect_interval(found.means.front().interval, 0.80 - 2.7764451051977987 * 0.0070710678118654752,
                  0.80 + 2.7764451051977987 * 0.0070710678118654752);
}

TEST(RestitutionSummary, DiametersOfOneSizeMakeOneSeries) {
  Dataset data = dataset_of({{0, 1.0, 0.8}, {0, 2.0, 0.79}, {0, 3.0, 0.81}, {0, 4.0, 0.8}});
  for (std::size_t i = 0; i < 4; ++i)
    data.points[i].diameter *= 1.0 + 0.02 * static_cast<double>(i);
  const RestitutionSummary found = summarise_restitution({data});
  ASSERT_EQ(found.means.size(), 1U);
  EXPECT_EQ(found.means.front().points, 4);
  EXPECT_NEAR(found.means.front().diameter, 0.03 * 1.03, 1e-12);
  EXPECT_TRUE(found.velocity.p_value.has_value());
}

/// Launches of a ball with e = a + b log10 V at every bounce, whose instants have errors, and an
/// independent scatter of e.
Dataset timed_launches(std::size_t launches, double a, double b, double of_instants, double scatter,
                       std::mt19937& random) {
  constexpr double g = 9.80665;
  constexpr int flights = 7;
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> start(3.0, 4.0);
  Dataset data = dataset_of({});
  data.series = {"a"};
  for (std::size_t launch = 0; launch < launches; ++launch) {
    std::vector<double> instants = {of_instants * normal(random)};
    double velocity = start(random);
    double exact = 0.0;
    for (int k = 0; k < flights; ++k) {
      exact += 2.0 * velocity / g;
      instants.push_back(exact + of_instants * normal(random));
      velocity *= a + b * std::log10(velocity) + scatter * normal(random);
    }
    for (std::size_t k = 0; k + 2 < instants.size(); ++k) {
      const double first = instants[k + 1] - instants[k];
      const double second = instants[k + 2] - instants[k + 1];
      ImpactPoint point;
      point.diameter = 0.03;
      point.launch = std::to_string(launch);
      point.incident_velocity = 0.5 * g * first;
      const double e = second / first;
      point.restitution = e;
      point.restitution_sd = of_instants / first * std::sqrt(1.0 + (1.0 + e) * (1.0 + e) + e * e);
      data.points.push_back(point);
    }
  }
  return data;
}

/// 25 launches in each of 200 sets: 190 intervals of 200 hold the truth, with a standard deviation
/// of 3.1. Independent errors would give slopes with intervals several times too wide.
TEST(RestitutionSummary, IntervalsOfTimedLaunchesHoldTheTruth) {
  std::mt19937 random(12);
  constexpr int sets = 200;
  struct Case {
    double scatter;
    double widest;  ///< of the slope's interval, as a multiple of its actual standard deviation
  };
  for (const auto& [scatter, widest] : {Case{0.0, 2.4}, Case{0.01, 2.6}}) {
    int slopes = 0, means = 0;
    double width = 0.0, sum = 0.0, square = 0.0;
    for (int k = 0; k < sets; ++k) {
      const RestitutionSummary found =
          summarise_restitution({timed_launches(25, 0.85, -0.03, 1e-3, scatter, random)});
      ASSERT_TRUE(found.velocity.interval);
      const auto& [low, high] = *found.velocity.interval;
      slopes += low < -0.03 && -0.03 < high ? 1 : 0;
      width += 0.5 * (high - low) / sets;
      sum += *found.velocity.value / sets;
      square += *found.velocity.value * *found.velocity.value / sets;
      // The mean of e over the bounces of many launches, to 1e-4.
      static const double mean = [] {
        std::mt19937 other(1);
        return summarise_restitution({timed_launches(4000, 0.85, -0.03, 1e-9, 0.0, other)})
            .means.front()
            .value;
      }();
      const auto& of_mean = *found.means.front().interval;
      means += of_mean[0] < mean && mean < of_mean[1] ? 1 : 0;
    }
    EXPECT_GE(slopes, 181) << scatter;
    EXPECT_LT(width, widest * std::sqrt(square - sum * sum)) << scatter;
    EXPECT_GE(means, 181) << scatter;
  }
}

TEST(RestitutionSummary, OneWrongHeightOrLaunchIsNamed) {
  for (const bool launch : {false, true}) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    int named = 0, wrong = 0, accused = 0;
    for (int set = 0; set < 100; ++set) {
      const bool right = set % 2 == 0;  // every second set hides nothing
      Dataset data = dataset_of({});
      data.series = {"a"};
      for (const double height : {0.25, 0.35, 0.45, 0.55, 0.65}) {
        const double fallen = height + (height == 0.45 && !right ? 0.03 : 0.0);
        for (int k = 0; k < 10; ++k) {
          const double rebound = 0.88 * 0.88 * fallen + 0.005 * normal(random);
          ImpactPoint point;
          point.diameter = 0.04;
          point.incident_velocity = std::sqrt(2.0 * 9.80665 * height);
          if (launch) point.incident_velocity *= 1.0 + 1e-6 * k;  // no setting
          point.restitution = std::sqrt(rebound / height);
          point.restitution_sd = 0.5 * point.restitution * 0.005 / rebound;
          (launch ? point.launch : point.setting) = std::to_string(height);
          data.points.push_back(point);
        }
      }
      const std::optional<OutlyingBatch> found = summarise_restitution({data}).outlier;
      if (right) {
        accused += found ? 1 : 0;
        continue;
      }
      if (!found) continue;
      const bool it = found->name == std::to_string(0.45) && found->launch == launch;
      ++(it ? named : wrong);
      // 0.88 (sqrt(0.48 / 0.45) - 1) = 0.02886
      if (it) {
        EXPECT_NEAR(found->difference, 0.02886, 0.01);
      }
    }
    EXPECT_GE(named, 45);
    EXPECT_EQ(wrong, 0);
    EXPECT_LE(accused, 3);
  }
}

/// Ladder from heights [m], of which one may be wrong, with errors of 2 mm of the rebounds.
struct Ladder {
  std::vector<double> heights;
  std::function<double(double)> restitution;  ///< e(V)
  double wrong = 0.0;                         ///< a stated height [m]; 0: none is wrong
  double excess = 0.0;                        ///< of the stated over the true height [m]
  double terminal_velocity = 1e9;             ///< of drag proportional to V^2 [m/s]
  std::string unit = " mm";                   ///< in the names of the settings
  int repeats = 3;
};

/// V^2 after a fall: V_t^2 (1 - exp(-2 g h / V_t^2)).
double square_after_fall(double height, double terminal) {
  return -terminal * terminal * std::expm1(-2.0 * 9.80665 * height / (terminal * terminal));
}

Dataset ladder_dataset(const Ladder& drops, std::mt19937& random) {
  constexpr double error = 0.002;
  std::normal_distribution<double> normal;
  Dataset data = dataset_of({});
  data.series = {"a"};
  for (const double height : drops.heights) {
    const double fallen = height - (height == drops.wrong ? drops.excess : 0.0);
    const double actual = std::sqrt(square_after_fall(fallen, drops.terminal_velocity));
    const double stated = std::sqrt(square_after_fall(height, drops.terminal_velocity));
    for (int k = 0; k < drops.repeats; ++k) {
      ImpactPoint point;
      point.diameter = 0.04;
      point.incident_velocity = stated;
      const double rebound = drops.restitution(actual) * actual;
      // The height of the rebound changes V_rebound^2 by 2 g.
      const double seen = rebound + error * normal(random) * 9.80665 / rebound;
      point.restitution = seen / stated;
      point.restitution_sd = error * 9.80665 / rebound / stated;
      point.setting = "a from " + std::to_string(std::lround(1000.0 * height)) + drops.unit;
      data.points.push_back(point);
    }
  }
  return data;
}

const std::vector<double> seven_heights = {0.3, 0.5, 0.7, 0.9, 1.05, 1.2, 1.5};

double falling_linearly(double V) { return 1.0 - 0.05 * V; }

// Every height is right, and e follows a law of impact. Of 100 sets at most 5 may accuse a height
// that is tested at 1 %.
TEST(RestitutionSummary, ACurvedLawIsNoWrongHeight) {
  struct Case {
    const char* law;
    std::function<double(double)> restitution;
  };
  const std::vector<std::vector<double>> ladders = {{0.1, 0.2, 0.4, 0.8},
                                                    {0.1, 0.2, 0.4, 0.8, 1.6},
                                                    {0.05, 0.1, 0.2, 0.4, 0.8, 1.6},
                                                    seven_heights,
                                                    {0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6, 0.8}};
  for (const Case& one :
       {Case{"constant", [](double) { return 0.9; }}, Case{"1 - 0.05 V", falling_linearly},
        Case{"0.75 V^-1/4", [](double V) { return 0.75 * std::pow(V, -0.25); }},
        Case{"1 - 0.3 V^1/5", [](double V) { return 1.0 - 0.3 * std::pow(V, 0.2); }},
        Case{"(1 - 0.2 V^1/5)^1/2",
             [](double V) { return std::sqrt(1.0 - 0.2 * std::pow(V, 0.2)); }},
        Case{"yields at 2 m/s", [](double V) { return 0.9 * std::pow(std::max(V, 2.0), -0.25); }},
        Case{"yields at 3 m/s",
             [](double V) { return 0.9 * std::pow(std::max(V, 3.0), -0.25); }}}) {
    std::mt19937 random(21);
    int accused = 0;
    for (int set = 0; set < 100; ++set) {
      const Ladder drops{ladders[static_cast<std::size_t>(set % 5)], one.restitution};
      accused += summarise_restitution({ladder_dataset(drops, random)}).outlier ? 1 : 0;
    }
    EXPECT_LE(accused, 5) << one.law;
  }
}

// 120 cm is 114 cm. At the stated height V is that of a fall from 105 cm in vacuum, which is
// another height of the file.
TEST(RestitutionSummary, AWrongHeightHasTheNameAndTheErrorOfTheFile) {
  for (const double terminal : {1e9, 9.4}) {
    for (const char* unit : {" mm", ""}) {
      for (const auto& law : {std::function<double(double)>(falling_linearly),
                              std::function<double(double)>([](double) { return 0.9; })}) {
        std::mt19937 random(5);
        int named = 0;
        for (int set = 0; set < 10; ++set) {
          const Ladder drops{seven_heights, law, 1.2, 0.06, terminal, unit, 5};
          const std::optional<OutlyingBatch> found =
              summarise_restitution({ladder_dataset(drops, random)}).outlier;
          if (!found) continue;
          ++named;
          EXPECT_EQ(found->name, std::string("a from 1200") + unit);
          ASSERT_EQ(found->height.has_value(), *unit != '\0');
          double error = -0.05;
          if (found->height) {
            EXPECT_NEAR(*found->height, 1.2, 1e-12);
          } else {
            error = square_after_fall(1.14, terminal) / square_after_fall(1.2, terminal) - 1.0;
          }
          EXPECT_NEAR(found->height_error, error, 0.01);
        }
        EXPECT_GE(named, 9) << terminal;
      }
    }
  }
}

// The lowest and the highest height can only be extrapolated to, and nothing else may be blamed.
TEST(RestitutionSummary, AWrongOutermostHeightAccusesNone) {
  for (const double wrong : {0.3, 1.5}) {
    std::mt19937 random(8);
    int accused = 0;
    for (int set = 0; set < 20; ++set) {
      const Ladder drops{seven_heights, falling_linearly, wrong, 0.06 * wrong};
      accused += summarise_restitution({ladder_dataset(drops, random)}).outlier ? 1 : 0;
    }
    EXPECT_LE(accused, 1) << wrong;
  }
}

TEST(RestitutionSummary, SaysWhatCannotBeSeen) {
  const RestitutionSummary one =
      summarise_restitution({dataset_of({{0, 3.0, 0.8}, {0, 3.0, 0.8}, {0, 3.0, 0.8}})});
  EXPECT_NEAR(one.means.front().value, 0.8, 1e-12);
  EXPECT_FALSE(one.means.front().interval.has_value());
  EXPECT_EQ(one.means.front().why, "the readings are equal, and no error is stated");
  EXPECT_FALSE(one.velocity.p_value.has_value());
  EXPECT_EQ(one.velocity.why, "one velocity");
  EXPECT_EQ(one.series.why, "one series");
  const RestitutionSummary two =
      summarise_restitution({dataset_of({{0, 1.0, 0.8}, {0, 3.0, 0.7}})});
  EXPECT_FALSE(two.velocity.p_value.has_value());
  EXPECT_EQ(two.velocity.why, "as many unknowns as readings, and no error is stated");
  Dataset captured = dataset_of({{0, 1.0, 0.0}});
  captured.points.front().captured = 1;
  EXPECT_TRUE(summarise_restitution({captured}).means.empty());
}

// One point without an error takes the median of the others (0.02), by the
// formula of the weighted line in Python with sd = 0.01, 0.02, 0.02, 0.04 for x = log10 V.
TEST(RestitutionSummary, OneMissingErrorCountsWithTheMedian) {
  Dataset data = dataset_of({{0, 1.0, 0.80}, {0, 2.0, 0.79}, {0, 4.0, 0.76}, {0, 8.0, 0.70}});
  const double sd[] = {0.01, 0.02, 0.0, 0.04};
  for (std::size_t i = 0; i < 4; ++i) {
    if (sd[i] > 0.0) data.points[i].restitution_sd = sd[i];
  }
  const RestitutionSummary missing = summarise_restitution({data});
  EXPECT_EQ(missing.without_error, 1U);
  EXPECT_EQ(missing.rebounds, 4U);
  EXPECT_NEAR(*missing.velocity.value, -0.07972627427729675, 1e-9);
  data.points[2].restitution_sd = 0.02;
  const RestitutionSummary stated = summarise_restitution({data});
  EXPECT_EQ(stated.without_error, 0U);
  EXPECT_EQ(*stated.velocity.value, *missing.velocity.value);
  EXPECT_EQ(*stated.velocity.interval, *missing.velocity.interval);
}

TEST(RestitutionSummary, OnlySeriesOfOneSizeAreCompared) {
  Dataset data = dataset_of(two_series);
  for (ImpactPoint& point : data.points) point.diameter = point.series == 0 ? 0.03 : 0.05;
  const RestitutionSummary apart = summarise_restitution({data});
  EXPECT_FALSE(apart.series.p_value.has_value());
  EXPECT_EQ(apart.series.why, "no two series have one size");
  // A third series of the first size, 0.05 higher: only these two are compared.
  for (std::size_t i = 0; i < 4; ++i) {
    data.points.push_back(data.points[i]);
    data.points.back().series = 2;
    data.points.back().restitution += 0.05;
  }
  data.series.emplace_back("c");
  const RestitutionSummary found = summarise_restitution({data});
  EXPECT_NEAR(*found.series.value, 0.05, 1e-12);
  EXPECT_EQ(found.most_different, (std::array<std::size_t, 2>{2, 0}));
}

TEST(RestitutionSummary, WithAdhesionTheEndsOfEverySizeCount) {
  Dataset data = dataset_of({{0, 4.0, 0.80}, {0, 1.0, 0.30}, {0, 8.0, 0.70}, {0, 0.5, 0.0}}, 0.01);
  data.points[3].captured = 1;
  data.points.push_back(data.points[1]);  // the slowest rebounds: mean e 0.35
  data.points.back().restitution = 0.40;
  data.points.push_back(data.points[0]);
  data.points.back().diameter = 0.05;
  const RestitutionSummary found = summarise_restitution({data}, true);
  EXPECT_FALSE(found.velocity.p_value.has_value());
  EXPECT_FALSE(found.series.p_value.has_value());
  ASSERT_EQ(found.ranges.size(), 2U);
  const RestitutionRange& range = found.ranges.front();
  EXPECT_EQ(range.settings, 3U);
  EXPECT_EQ(range.slowest.velocity, 1.0);
  EXPECT_NEAR(range.slowest.value, 0.35, 1e-12);
  EXPECT_NEAR(range.slowest.error, 0.01 / std::sqrt(2.0), 1e-12);
  EXPECT_EQ(range.fastest.velocity, 8.0);
  EXPECT_EQ(range.largest.value, 0.80);
  EXPECT_TRUE(range.peaks());  // 0.80 and 0.70 are 7 standard errors apart
  EXPECT_EQ(found.ranges.back().diameter, 0.05);
}

/// Nothing hidden: in 5 % of data sets a slope or a difference is called one, stated errors or not.
TEST(RestitutionSummary, AccusesNothingInFivePerCent) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  constexpr int sets = 1000;
  for (const bool stated : {false, true}) {
    int slopes = 0, differences = 0;
    for (int k = 0; k < sets; ++k) {
      std::vector<Row> rows;
      for (std::size_t s = 0; s < 3; ++s) {
        for (const double velocity : {1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 4.0, 4.0, 4.0}) {
          rows.push_back({s, velocity, 0.7 + 0.01 * normal(random)});
        }
      }
      const RestitutionSummary found =
          summarise_restitution({dataset_of(rows, stated ? 0.01 : 0.0)});
      slopes += *found.velocity.p_value < 0.05 ? 1 : 0;
      differences += *found.series.p_value < 0.05 ? 1 : 0;
    }
    // 50 of 1000, standard deviation 6.9. Where both errors have to agree there are fewer. In the
    // 5 % in which the lack of fit is significant by chance, the means of the heights are used.
    EXPECT_LE(slopes, 71) << stated;
    EXPECT_GE(slopes, 15) << stated;
    EXPECT_LE(differences, 71) << stated;
    EXPECT_GE(differences, 15) << stated;
  }
}

}  // namespace
}  // namespace recoil
