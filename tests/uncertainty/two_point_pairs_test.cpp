// Every pair of points: runs together against runs alone, closed forms near the truth, counting.
#include "uncertainty/two_point_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "estimate/predictor.hpp"
#include "support/noisy_case.hpp"

namespace recoil {
namespace {

using synthetic::Case;
using synthetic::Design;

/// A fit to noiseless points: the estimate is the truth, and the simulated noise is `sd`.
Case exact_case(double sd) {
  Case made;
  Design design;
  design.sd = sd;
  made.datasets = {synthetic::dataset(design)};
  made.data = gather(made.datasets);
  made.fitted = fit(make_model(synthetic::spec(), made.datasets), made.data);
  return made;
}

std::vector<PairStudy> study(const Case& c, int simulations, int threads = 0,
                             std::uint64_t seed = 5) {
  return study_two_point_pairs(c.fitted, {{0, 4.9e-6}}, {simulations, seed, threads});
}

TEST(TwoPointPairs, TogetherAndAloneGiveTheSameDigits) {
  const Case c = synthetic::noisy_case();
  std::vector<TwoPoints> pairs;
  for (const double e_low : {0.30, 0.52, 0.55, 0.60, 0.70, 0.999}) {
    for (const double e_high : {0.80, 0.86, 0.90, 0.97}) {
      pairs.push_back({0, 4.9e-6, {2.5, e_low}, {90.0, e_high}});
    }
  }
  const std::vector<TwoPointRun> together = iterate_two_points(c.fitted.model, pairs);
  bool some_failed = false;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const TwoPointRun alone =
        iterate_two_points(c.fitted.model, std::span(pairs).subspan(i, 1)).front();
    EXPECT_EQ(alone.status, together[i].status);
    EXPECT_EQ(alone.C_H, together[i].C_H);
    EXPECT_EQ(alone.C_A, together[i].C_A);
    EXPECT_EQ(alone.iterations, together[i].iterations);
    if (alone.status != TwoPointStatus::converged) {
      some_failed = true;
      continue;
    }
    // What converged reproduces both points.
    const std::vector<double> theta = two_point_theta(c.fitted.model, 0, alone);
    EXPECT_NEAR(predict(c.fitted.model, theta, 0, 4.9e-6, 2.5, false).restitution(),
                pairs[i].low.restitution, 1e-6);
    EXPECT_NEAR(predict(c.fitted.model, theta, 0, 4.9e-6, 90.0, false).restitution(),
                pairs[i].high.restitution, 1e-6);
  }
  EXPECT_TRUE(some_failed);
}

TEST(TwoPointPairs, AreThosePairsWhoseVelocitiesDifferByHalf) {
  const Case c = exact_case(1e-3);
  const std::vector<PairStudy> found = study(c, 9);
  ASSERT_EQ(found.size(), 1U);
  // 2.5, 4, 6.5, 12, 25, 50, 90 m/s: all 21 pairs are 1.5 apart.
  EXPECT_EQ(found[0].pairs.size(), 21U);
  EXPECT_EQ(found[0].points, 7U);
  EXPECT_EQ(found[0].taken, 7U);
  const PairQuality& paper = found[0].pairs[found[0].paper];
  EXPECT_EQ(c.data.points[paper.low_point].velocity, 2.5);
  EXPECT_EQ(c.data.points[paper.high_point].velocity, 90.0);
  EXPECT_EQ(c.data.points[paper.low_point].diameter, 4.9e-6);
  for (const PairQuality& pair : found[0].pairs) {
    int all = 0;
    for (const int count : pair.ended) all += count;
    EXPECT_EQ(all, 9);
    EXPECT_GE(c.data.points[pair.high_point].velocity,
              1.5 * c.data.points[pair.low_point].velocity);
  }
}

/// Standard deviations of C_H and C_A of a pair, to first order in the noise: with J the slopes of
/// e at the two points, by differences of `predict`, theta = J^-1 e.
struct Linear {
  double C_H, C_A;
};
Linear linear_spread(const Case& c, double v_low, double v_high, double sd) {
  const std::vector<double>& theta = c.fitted.theta;
  const auto e = [&](double v, std::size_t slot, double factor) {
    std::vector<double> moved = theta;
    moved[slot] *= factor;
    return predict(c.fitted.model, moved, 0, 4.9e-6, v, false).restitution();
  };
  double J[2][2];
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t j = 0; j < 2; ++j) {
      const double v = k == 0 ? v_low : v_high;
      J[k][j] = (e(v, j, 1.001) - e(v, j, 0.999)) / (0.002 * theta[j]);
    }
  }
  const double det = J[0][0] * J[1][1] - J[0][1] * J[1][0];
  return {sd * std::hypot(J[1][1], J[0][1]) / std::abs(det),
          sd * std::hypot(J[1][0], J[0][0]) / std::abs(det)};
}

TEST(TwoPointPairs, SpreadIsThatOfTheLinearTheoryWhenTheNoiseIsSmall) {
  constexpr double sd = 2e-4;
  const Case c = exact_case(sd);
  const PairStudy found = study(c, 499).front();
  EXPECT_NEAR(found.truth_C_H / 3e-3, 1.0, 1e-4);
  EXPECT_NEAR(found.truth_C_A / 0.03, 1.0, 1e-4);
  for (const PairQuality& pair : found.pairs) {
    const double low = c.data.points[pair.low_point].velocity;
    const double high = c.data.points[pair.high_point].velocity;
    if (low > 7.0 || high < 20.0) continue;  // the others are not linear even now
    const Linear expected = linear_spread(c, low, high, sd);
    ASSERT_TRUE(pair.C_H.spread && pair.C_A.spread);
    EXPECT_EQ(pair.without_answer(), 0.0);
    // The robust spread of 499 values is uncertain by 5 %.
    EXPECT_NEAR(*pair.C_H.spread / expected.C_H, 1.0, 0.2) << low << " " << high;
    EXPECT_NEAR(*pair.C_A.spread / expected.C_A, 1.0, 0.2) << low << " " << high;
    EXPECT_NEAR(*pair.C_H.median, found.truth_C_H, 0.3 * expected.C_H);
    EXPECT_NEAR(*pair.C_A.median, found.truth_C_A, 0.3 * expected.C_A);
  }
  // All points together know more than any two of them.
  for (const PairQuality& pair : found.pairs) {
    EXPECT_LT(*found.C_A.spread, pair.C_A.spread.value_or(INFINITY));
  }
}

TEST(TwoPointPairs, HeldOutErrorIsTheNoiseWhereTheCalibrationIsExact) {
  constexpr double sd = 1e-3;
  const Case c = exact_case(sd);
  const PairStudy found = study(c, 99).front();
  // sqrt(sd^2 + error^2): hardly above the noise for the full fit, never below it for a pair.
  ASSERT_TRUE(found.held_out.series && found.held_out.diameters);
  EXPECT_GE(*found.held_out.series, sd);
  EXPECT_LT(*found.held_out.series, 1.15 * sd);
  for (const PairQuality& pair : found.pairs) {
    if (!pair.held_out.series) continue;
    EXPECT_GE(*pair.held_out.series, sd);
    ASSERT_TRUE(pair.held_out.diameters.has_value());
    EXPECT_GE(*pair.held_out.diameters, *found.held_out.diameters);
  }
  // The measured points are exact: what is left of the error there is that of the iteration.
  const PairQuality& paper = found.pairs[found.paper];
  ASSERT_EQ(paper.measured.status, TwoPointStatus::converged);
  EXPECT_LT(*paper.measured_held_out.series, 1e-5);
  EXPECT_NEAR(paper.measured.C_A / 0.03, 1.0, 1e-5);
}

TEST(TwoPointPairs, MeasuredErrorLeavesOutThePairItself) {
  Case c = synthetic::noisy_case();
  const PairStudy found = study(c, 9).front();
  const PairQuality& paper = found.pairs[found.paper];
  ASSERT_EQ(paper.measured.status, TwoPointStatus::converged);
  const std::vector<double> theta = two_point_theta(c.fitted.model, 0, paper.measured);
  std::vector<std::size_t> series, others;
  for (std::size_t i = 0; i < c.data.points.size(); ++i) {
    if (c.data.points[i].diameter != 4.9e-6) {
      others.push_back(i);
    } else if (i != paper.low_point && i != paper.high_point) {
      series.push_back(i);
    }
  }
  EXPECT_NEAR(*paper.measured_held_out.series,
              root_mean_square(c.fitted.model, theta, c.fitted.data, series), 1e-8);
  EXPECT_NEAR(*paper.measured_held_out.diameters,
              root_mean_square(c.fitted.model, theta, c.fitted.data, others), 1e-8);
}

TEST(TwoPointPairs, NoiseThatDrownsThePointsLeavesNoAnswerAndIsCounted) {
  const Case c = exact_case(0.25);
  const PairStudy found = study(c, 60).front();
  const PairQuality& paper = found.pairs[found.paper];
  EXPECT_GT(paper.without_answer(), 0.3);
  const int converged = paper.ended[static_cast<std::size_t>(TwoPointStatus::converged)];
  EXPECT_NEAR(paper.without_answer(), 1.0 - converged / 60.0, 1e-12);
  EXPECT_GT(paper.ended[static_cast<std::size_t>(TwoPointStatus::no_hertz_damping)], 0)
      << "a simulated e at or above 1";
  EXPECT_GT(paper.ended[static_cast<std::size_t>(TwoPointStatus::too_few_points)], 0)
      << "a simulated point that was captured";
}

TEST(TwoPointPairs, ASimulatedCaptureEndsItsPair) {
  Design design;
  design.velocities = {1.25, 2.5, 6.5, 25.0, 90.0};  // 4.9 um stay on the surface below 1.1 m/s
  Case c;
  c.datasets = {synthetic::dataset(design)};
  for (ImpactPoint& point : c.datasets[0].points) {
    point.events = 3;
    point.counted = true;
    point.captured = point.restitution == 0.0 ? 3 : point.incident_velocity < 2.0 ? 1 : 0;
  }
  c.data = gather(c.datasets);
  c.fitted = fit(make_model(synthetic::spec(), c.datasets), c.data);
  ASSERT_TRUE(c.fitted.usable);
  // Impacts that scatter so widely that three in a row stay in one of twenty simulated sets.
  for (Observation& point : c.fitted.data.points) {
    if (point.weights.scatter > 0.0) point.weights.scatter = 1.0;
  }
  const PairStudy found = study(c, 200).front();
  const PairQuality& paper = found.pairs[found.paper];
  ASSERT_EQ(c.data.points[paper.low_point].velocity, 1.25);
  EXPECT_GT(paper.ended[static_cast<std::size_t>(TwoPointStatus::too_few_points)], 2);
}

TEST(TwoPointPairs, LeavesOutWhatCannotBeCalibrated) {
  Case c;
  Design design;
  design.velocities = {0.5, 0.9, 2.5, 6.5, 25.0, 90.0};  // the first two are captured
  c.datasets = {synthetic::dataset(design)};
  c.data = gather(c.datasets);
  c.fitted = fit(make_model(synthetic::spec(), c.datasets), c.data);
  ASSERT_TRUE(c.fitted.usable);
  const PairStudy found = study(c, 9).front();
  for (const PairQuality& pair : found.pairs) {
    EXPECT_FALSE(c.data.points[pair.low_point].censored);
    EXPECT_GE(c.data.points[pair.low_point].velocity, 2.5);
  }
  EXPECT_EQ(found.pairs.size(), 6U);
}

TEST(TwoPointPairs, ThinsManyPointsEvenlyAndSaysSo) {
  Case c;
  Design design;
  design.diameters = {4.9e-6};
  design.velocities.clear();
  for (int i = 0; i < 40; ++i) design.velocities.push_back(2.5 * std::pow(36.0, i / 39.0));
  c.datasets = {synthetic::dataset(design)};
  c.data = gather(c.datasets);
  c.fitted = fit(make_model(synthetic::spec(), c.datasets), c.data);
  const PairStudy found = study(c, 9).front();
  EXPECT_EQ(found.points, 40U);
  EXPECT_EQ(found.taken, 16U);
  EXPECT_LE(found.pairs.size(), 120U);
  EXPECT_EQ(found.pairs[found.paper].low_point, 0U);
  EXPECT_EQ(found.pairs[found.paper].high_point, 39U);
  EXPECT_FALSE(found.held_out.diameters.has_value()) << "there is no other diameter";
}

TEST(TwoPointPairs, EveryDigitIsTheSameAtAnyThreadCountAndHangsOnTheSeed) {
  const Case c = synthetic::noisy_case();
  const PairStudy one = study(c, 19, 1).front();
  const PairStudy four = study(c, 19, 4).front();
  const PairStudy other = study(c, 19, 4, 6).front();
  ASSERT_EQ(one.pairs.size(), four.pairs.size());
  EXPECT_EQ(one.C_A.spread, four.C_A.spread);
  EXPECT_NE(one.C_A.spread, other.C_A.spread);
  for (std::size_t i = 0; i < one.pairs.size(); ++i) {
    EXPECT_EQ(one.pairs[i].C_H.median, four.pairs[i].C_H.median);
    EXPECT_EQ(one.pairs[i].held_out.series, four.pairs[i].held_out.series);
    EXPECT_EQ(one.pairs[i].ended, four.pairs[i].ended);
  }
}

TEST(TwoPointPairs, AreNotMadeWhenNotAskedFor) {
  const Case c = synthetic::noisy_case();
  EXPECT_TRUE(study(c, 0).empty());
  UncertaintyOptions options = synthetic::small(0);
  options.profile = options.curves = options.capture = false;
  options.two_point = false;
  EXPECT_TRUE(assess_uncertainty(c.fitted, c.datasets, options).pairs.empty());
  options.two_point = true;
  const UncertaintyResult with = assess_uncertainty(c.fitted, c.datasets, options);
  ASSERT_EQ(with.pairs.size(), 1U);
  EXPECT_EQ(with.pairs[0].simulations, 39) << "no more than replicates";
}

}  // namespace
}  // namespace recoil
