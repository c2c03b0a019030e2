// Points of which some impacts were captured: the likelihood of one point, and what becomes of the
// bias of survivors' means, on impacts simulated one by one by code that the fitter does not use.
#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/fit.hpp"
#include "estimate/residual.hpp"
#include "estimate/reweighting.hpp"
#include "support/synthetic.hpp"
#include "support/temporary_folder.hpp"

namespace recoil {
namespace {

/// 14 of 20 impacts rebounded, and differ.
DrawnPoint mixed_point() {
  DrawnPoint made;
  auto& [point, weights] = made;
  point.restitution = 0.36;
  weights.sd = 0.03;
  weights.mean_sd = 0.03;
  point.events = 20;
  point.captured = 6;
  point.counted = true;
  weights.scatter = 0.15;
  weights.shift = -0.01;
  return made;
}

TEST(Captures, CountsAloneGiveTheBinomialEstimate) {
  auto [point, weights] = mixed_point();
  weights.mean_sd = 1e4;  // the mean says nothing
  locate_peak(point, weights);
  const double u = gsl_cdf_ugaussian_Pinv(14.0 / 20.0);
  EXPECT_NEAR(weights.peak.at, u * weights.scatter - weights.shift, 1e-7);
  // r^2 is the deviance of 6 in 20 under p = 1/2: 2 (6 ln 0.6 + 14 ln 1.4), at u = 0.
  const double r = weighted_residual(point, weights, -weights.shift).value;
  EXPECT_NEAR(r * r, 2.0 * (6.0 * std::log(0.6) + 14.0 * std::log(1.4)), 1e-6);
  EXPECT_GT(r, 0.0);  // the point lies above
}

TEST(Captures, AllCapturedIsTobitToThePowerOfTheCountWhereImpactsDiffer) {
  Observation point;
  PointWeights weights;
  weights.sd = 0.01;
  weights.scatter = 0.02;
  point.censored = true;
  point.events = point.captured = 7;
  // At m = 0 each impact is captured with probability 1/2.
  EXPECT_NEAR(weighted_residual(point, weights, 0.0).value, std::sqrt(14.0 * std::log(2.0)), 1e-12);
  // What all impacts of the point share leaves a single one: n_eff -> 1.
  weights.input_sd = 100.0;
  EXPECT_NEAR(weighted_residual(point, weights, 0.0).value, std::sqrt(2.0 * std::log(2.0)), 1e-5);
}

TEST(Captures, AllCapturedIsOneObservationWhereNothingIsKnownOfTheImpacts) {
  Observation point;
  PointWeights weights;
  weights.sd = 0.1;
  point.censored = true;
  point.events = point.captured = 40;
  EXPECT_NEAR(weighted_residual(point, weights, 0.0).value, std::sqrt(2.0 * std::log(2.0)), 1e-12);
  // s = sqrt(2) sd^2: one s below zero costs -2 ln Phi(1).
  const double s = std::sqrt(2.0) * 0.01;
  EXPECT_NEAR(weighted_residual(point, weights, -s).value,
              std::sqrt(-2.0 * std::log(gsl_cdf_ugaussian_P(1.0))), 1e-12);
}

TEST(Captures, CountsWithoutAnyEAreBinomial) {
  // 6 of 20 captured: the deviance of the counts alone, zero at its peak (closed form).
  auto [point, weights] = mixed_point();
  point.restitution = 0.0;
  point.censored = true;
  locate_peak(point, weights);
  const double u = gsl_cdf_ugaussian_Pinv(14.0 / 20.0);
  EXPECT_NEAR(weights.peak.at, u * weights.scatter - weights.shift, 1e-7);
  const double r = weighted_residual(point, weights, -weights.shift).value;
  EXPECT_NEAR(r * r, 2.0 * (6.0 * std::log(0.6) + 14.0 * std::log(1.4)), 1e-6);
  // None of 7 captured mirrors 7 of 7: at m = 0 each impact has the probability 1/2.
  point.events = 7;
  point.captured = 0;
  weights.shift = 0.0;
  const WeightedResidual none = weighted_residual(point, weights, 0.0);
  EXPECT_NEAR(none.value * none.value, 14.0 * std::log(2.0), 1e-12);
  EXPECT_LT(none.value * none.slope, 0.0);  // less where the model rebounds
  EXPECT_NEAR(weighted_residual(point, weights, 1.0).value, 0.0, 1e-4);
}

TEST(Captures, ResidualIsTheSignedRootOfTheDevianceAndSmooth) {
  for (const bool counted : {true, false}) {
    auto [point, weights] = mixed_point();
    point.counted = counted;
    locate_peak(point, weights);
    const double unit = 1.0 / std::sqrt(0.5 * weights.peak.curvature);
    for (const double away : {-3.0, -0.5, -2e-3, -0.9e-3, 0.0, 0.5e-3, 1.1e-3, 0.2, 4.0}) {
      const double m = weights.peak.at + away * unit;
      const WeightedResidual at = weighted_residual(point, weights, m);
      EXPECT_NEAR(at.value * at.value, event_deviance(point, weights, m) - weights.peak.deviance,
                  1e-9);
      EXPECT_EQ(at.value > 0.0, away < 0.0);
      const double h = 0.02 * unit;
      const double difference = (weighted_residual(point, weights, m + h).value -
                                 weighted_residual(point, weights, m - h).value) /
                                (2.0 * h);
      EXPECT_NEAR(at.slope / difference, 1.0, 1e-3) << away;
    }
  }
}

/// Impacts that differ: each has its own adhesion. e of every impact comes from the simulator of
/// the reconstructions.
class ImpactsOfManySpheres {
 public:
  static constexpr double diameter = 4.9e-6;
  static constexpr double measuring_sd = 0.04;  // of one e
  static constexpr int events = 20;

  /// @param spread relative sd of the capture velocity from sphere to sphere
  explicit ImpactsOfManySpheres(double spread) {
    truth_.density = 1350.0;
    truth_.stiffness = 1.789e9;
    truth_.adhesion_force = 8.9;
    truth_.reference_diameter = diameter;
    truth_.C_H = 3e-3;
    truth_.C_A = 0.03;
    capture_velocity_ = true_capture_velocity(truth_, diameter);
    synthetic::Design design;
    design.diameters = {diameter};
    design.velocities.clear();
    for (const double relative : {0.8, 0.9, 1.0, 1.1, 1.25, 1.5, 2.0, 3.0, 5.0, 10.0, 20.0, 40.0}) {
      design.velocities.push_back(relative * capture_velocity_);
    }
    design_ = synthetic::dataset(design);
    for (const ImpactPoint& point : design_.points) tabulate(point, spread);
  }

  double capture_velocity() const { return capture_velocity_; }

  /// @param rows where given, it gets the same impacts, one row each
  Dataset draw(std::uint64_t index, Dataset* rows = nullptr) const {
    RandomStream random(5, RandomPurpose::coverage, index);
    Dataset data = design_;
    if (rows != nullptr) {
      *rows = design_;
      rows->points.clear();
    }
    for (std::size_t i = 0; i < data.points.size(); ++i) {
      ImpactPoint& point = data.points[i];
      point.events = events;
      point.captured = 0;
      point.counted = true;
      double sum = 0.0;
      for (int event = 0; event < events; ++event) {
        const double e = at(i, random.normal());
        const double noise = measuring_sd * random.normal();
        if (rows != nullptr) {
          ImpactPoint& row = rows->points.emplace_back(design_.points[i]);
          row.counted = true;
          row.captured = e > 0.0 ? 0 : 1;
          row.restitution = e > 0.0 ? std::max(0.0, e + noise) : 0.0;
          row.restitution_sd.reset();
        }
        if (e > 0.0) {
          sum += std::max(0.0, e + noise);
        } else {
          ++point.captured;
        }
      }
      const int rebounds = events - point.captured;
      point.restitution = rebounds > 0 ? sum / rebounds : 0.0;
      point.restitution_sd = event_sd_[i] / std::sqrt(rebounds > 0 ? rebounds : events);
    }
    return data;
  }

 private:
  static constexpr int cells = 200;  // of z in [-4.5, 4.5]
  static constexpr double reach = 4.5;

  void tabulate(const ImpactPoint& point, double spread) {
    std::vector<double> row;
    double weight = 0.0;
    double first = 0.0;
    double second = 0.0;
    for (int k = 0; k <= cells; ++k) {
      const double z = reach * (2.0 * k / cells - 1.0);
      Truth own = truth_;
      own.adhesion_force *= std::exp(-spread / 1.875 * z);  // V* ~ f0^(15/8)
      row.push_back(true_restitution(own, diameter, point.incident_velocity));
      if (row.back() == 0.0) continue;
      const double density = std::exp(-0.5 * z * z);
      weight += density;
      first += density * row.back();
      second += density * row.back() * row.back();
    }
    e_.push_back(row);
    const double variance =
        weight > 0.0 ? second / weight - first * first / (weight * weight) : 0.0;
    event_sd_.push_back(std::hypot(std::sqrt(std::max(0.0, variance)), measuring_sd));
  }

  double at(std::size_t point, double z) const {
    const double x = std::clamp((z / reach + 1.0) * 0.5 * cells, 0.0, cells - 1e-9);
    const auto k = static_cast<std::size_t>(x);
    const double part = x - static_cast<double>(k);
    const double a = e_[point][k];
    const double b = e_[point][k + 1];
    if (a == 0.0 || b == 0.0) return part < 0.5 ? a : b;
    return std::sqrt((1.0 - part) * a * a + part * b * b);
  }

  Truth truth_;
  double capture_velocity_ = 0.0;
  Dataset design_;
  std::vector<std::vector<double>> e_;
  std::vector<double> event_sd_;
};

/// Means over data sets, relative to the truth.
struct Bias {
  double C_A = 0.0;
  double capture = 0.0;
  double spread = 0.0;  // mean event_spread
  double C_A_scatter = 0.0;
};

Bias bias(const ImpactsOfManySpheres& impacts, bool as_survivors_mean) {
  constexpr int sets = 60;
  Bias bias;
  double squares = 0.0;
  for (std::uint64_t s = 0; s < sets; ++s) {
    Dataset data = impacts.draw(s);
    for (ImpactPoint& point : data.points) {
      point.counted = point.counted && !as_survivors_mean;
      if (as_survivors_mean && !point.all_captured()) point.captured = 0;
    }
    const ImpactModel model = make_model(synthetic::spec(), {data});
    FitOptions options;
    options.several_starts = false;
    const FitResult fitted = fit(model, gather({data}), options);
    if (!fitted.usable) {
      ADD_FAILURE() << fitted.failure;
      continue;
    }
    const double error = fitted.theta[1] / 0.03 - 1.0;
    bias.C_A += error / sets;
    squares += error * error / sets;
    const double found =
        capture_velocity(model, fitted.theta, 0, ImpactsOfManySpheres::diameter).value;
    bias.capture += (found / impacts.capture_velocity() - 1.0) / sets;
    bias.spread += fitted.weights.noise.event_spread / sets;
  }
  bias.C_A_scatter = std::sqrt(squares - bias.C_A * bias.C_A);
  return bias;
}

/// The same impacts as 240 rows and as 12 means with their counts, the noise not stated: the
/// estimates differ by less than a tenth of the 95 % interval, 0.4 standard errors.
TEST(Captures, RowsAreImpacts) {
  const ImpactsOfManySpheres impacts(0.1);
  for (std::uint64_t s = 0; s < 5; ++s) {
    Dataset rows;
    Dataset means = impacts.draw(s, &rows);
    for (ImpactPoint& point : means.points) point.restitution_sd.reset();
    const auto fitted = [](const Dataset& data) {
      return fit(make_model(synthetic::spec(), {data}), gather({data}));
    };
    const FitResult by_row = fitted(rows);
    const FitResult by_mean = fitted(means);
    ASSERT_TRUE(by_row.usable && by_mean.usable) << by_row.failure << by_mean.failure;
    EXPECT_GT(by_row.weights.noise.event_spread, 0.05) << s;
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_NEAR(by_row.theta[j], by_mean.theta[j], 0.4 * by_mean.std_error[j]) << s << " " << j;
    }
    const auto captured_below = [](const FitResult& fit) {
      return capture_velocity(fit.model, fit.theta, 0, ImpactsOfManySpheres::diameter);
    };
    const CaptureVelocity v = captured_below(by_mean);
    const double error =
        std::hypot(v.gradient[0] * by_mean.std_error[0], v.gradient[1] * by_mean.std_error[1]);
    EXPECT_NEAR(captured_below(by_row).value, v.value, 0.4 * error) << s;
  }
}

TEST(Captures, SurvivorsMeansAreUnbiasedWhereTheyWereNot) {
  const ImpactsOfManySpheres impacts(0.1);
  const Bias before = bias(impacts, true);
  EXPECT_LT(before.C_A, -0.15);  // fitted as plain means: -22 %, of the capture velocity -8 %
  EXPECT_LT(before.capture, -0.05);
  const Bias after = bias(impacts, false);
  EXPECT_NEAR(after.C_A, 0.0, 3.0 * after.C_A_scatter / std::sqrt(60.0) + 0.005);
  EXPECT_NEAR(after.capture, 0.0, 0.005);
  EXPECT_NEAR(after.spread, 0.1, 0.01);
  EXPECT_LT(after.C_A_scatter, 0.5 * before.C_A_scatter + 0.02);
}

TEST(Captures, BouncedFractionsGiveTheCaptureVelocity) {
  // Counts alone, as an impactor has them: every sphere from the simulator of the reconstructions
  // with its own adhesion. The probit of ln V on the same design (scipy 1.10, maximum
  // likelihood of V* and the spread 0.1, 200 simulated sets of 12 points of 20 impacts) has no bias
  // and a standard error of V* of 1.66 %.
  const ImpactsOfManySpheres impacts(0.1);
  constexpr int sets = 40;
  double mean = 0.0;
  double square = 0.0;
  for (std::uint64_t s = 0; s < sets; ++s) {
    Dataset data = impacts.draw(s);
    for (ImpactPoint& point : data.points) {
      point.counts_only = !point.all_captured();
      point.restitution = 0.0;
      point.restitution_sd.reset();
    }
    const ImpactModel model = make_model(synthetic::spec(), {data});
    const FitResult fitted = fit(model, gather({data}));
    ASSERT_TRUE(fitted.usable) << fitted.failure;
    const double found =
        capture_velocity(model, fitted.theta, 0, ImpactsOfManySpheres::diameter).value;
    const double error = found / impacts.capture_velocity() - 1.0;
    mean += error / sets;
    square += error * error / sets;
  }
  EXPECT_LT(std::sqrt(square), 0.0166 * (1.0 + 3.0 / std::sqrt(2.0 * sets)));
  EXPECT_NEAR(mean, 0.0, 3.0 * std::sqrt(square / sets));
}

/// Exact means of 40 impacts with a large stated sd, and one point below the capture velocity.
Dataset exact_with_captured_point() {
  const ImpactsOfManySpheres impacts(0.0);
  synthetic::Design design;
  design.diameters = {ImpactsOfManySpheres::diameter};
  design.velocities.clear();
  for (const double relative : {0.85, 1.34, 2.1, 3.3, 5.2, 8.2, 12.9, 20.2, 31.8, 50.0}) {
    design.velocities.push_back(relative * impacts.capture_velocity());
  }
  Dataset data = synthetic::dataset(design);
  for (ImpactPoint& point : data.points) {
    point.counted = true;
    point.events = 40;
    if (point.captured > 0) point.captured = 40;
    point.restitution_sd.reset();
    if (point.captured == 0) point.restitution_sd = 0.1 * point.restitution;
  }
  return data;
}

TEST(Captures, ACapturedPointAtItsPlaceChangesNothing) {
  const Dataset data = exact_with_captured_point();
  ASSERT_TRUE(data.points[0].all_captured());
  Dataset without = data;
  without.points.erase(without.points.begin());
  for (const bool f0_free : {false, true}) {
    const FitSpec spec = synthetic::spec(f0_free);
    const FitResult with = fit(make_model(spec, {data}), gather({data}));
    const FitResult rest = fit(make_model(spec, {without}), gather({without}));
    ASSERT_TRUE(with.usable && rest.usable) << with.failure << rest.failure;
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_NEAR(with.theta[j] / rest.theta[j], 1.0, 1e-3) << j << f0_free;
    }
  }
}

TEST(Captures, ByThemselvesFarBelowTheCaptureVelocityTheyLeaveTheFitOnFlatGround) {
  synthetic::Design design;
  design.velocities = {0.1, 0.15, 0.2};
  Dataset data = synthetic::dataset(design);
  for (ImpactPoint& point : data.points) {
    point.restitution = 0.0;
    point.events = point.captured = 20;
  }
  const std::vector<Dataset> datasets = {data};
  const FitResult fitted = fit(make_model(synthetic::spec(), datasets), gather(datasets));
  ASSERT_TRUE(fitted.usable) << fitted.failure;
  EXPECT_EQ(fitted.ending, DescentEnd::flat);
  EXPECT_EQ(fitted.flat, (std::vector<std::size_t>{0, 1}));
  EXPECT_TRUE(fitted.covariance.empty());
  for (const StartSummary& start : fitted.starts) {
    EXPECT_FALSE(start.converged());
    EXPECT_EQ(start.outcome,
              &start == &fitted.best_start() ? StartOutcome::best : StartOutcome::flat);
  }
}

TEST(Captures, WithoutAMixedPointNothingRemainsOfTheSpread) {
  const ImpactsOfManySpheres impacts(0.1);
  const Dataset data = impacts.draw(1);
  FitResult fitted = fit(make_model(synthetic::spec(), {data}), gather({data}));
  ASSERT_TRUE(fitted.usable) << fitted.failure;
  ASSERT_GT(fitted.weights.noise.event_spread, 0.0);
  EXPECT_FALSE(fitted.spread_covariance.empty());
  // A replicate in which no impact of a point with rebounds was captured.
  Observations replicate = fitted.data;
  for (Observation& point : replicate.points) {
    if (!point.censored) point.captured = 0;
  }
  const ReweightedFit refitted =
      reweighted_fit(fitted.model, replicate, fitted.weights.noise, fitted.theta);
  EXPECT_TRUE(refitted.run.converged) << refitted.run.message;
  EXPECT_EQ(refitted.weights.noise.event_spread, 0.0);
  for (const PointWeights& own : refitted.weights.points) EXPECT_EQ(own.scatter, 0.0);
}

TEST(Captures, TheRoundsEndAtOnePlaceFromWhereverTheyStart) {
  const ImpactsOfManySpheres impacts(0.03);
  for (const std::uint64_t draw : {2U, 3U, 4U}) {
    const Dataset data = impacts.draw(draw);
    const FitResult fitted = fit(make_model(synthetic::spec(true), {data}), gather({data}));
    ASSERT_TRUE(fitted.usable) << fitted.failure;
    ASSERT_GT(fitted.weights.noise.event_spread, 0.0);
    for (const double factor : {0.7, 1.4}) {
      std::vector<double> start = fitted.theta;
      for (std::size_t j = 0; j < 2; ++j) start[j] *= factor;
      Noise noise;
      noise.event_spread = 0.05 * factor;
      const ReweightedFit refitted = reweighted_fit(fitted.model, gather({data}), noise, start);
      EXPECT_TRUE(refitted.run.converged && refitted.at_rest);
      for (std::size_t j = 0; j < 3; ++j) {
        EXPECT_NEAR((refitted.run.theta[j] - fitted.theta[j]) / fitted.std_error[j], 0.0, 0.02);
      }
      EXPECT_NEAR(refitted.weights.noise.event_spread / fitted.weights.noise.event_spread, 1.0,
                  0.02);
    }
  }
}

TEST(Captures, AreDrawnAsTheyAreFitted) {
  // Simulated points have the binomial count and the survivors' mean that the likelihood expects.
  auto [point, weights] = mixed_point();
  const double m = 0.06;
  const double p = gsl_cdf_ugaussian_Q((m + weights.shift) / weights.scatter);
  const double expected = expected_restitution(point, weights, m);
  constexpr int draws = 4000;
  double captured = 0.0;
  double mean = 0.0;
  int means = 0;
  for (int i = 0; i < draws; ++i) {
    RandomStream random(3, RandomPurpose::bootstrap, static_cast<std::uint64_t>(i));
    const auto [drawn, own] = simulate_observation(point, weights, m, 1.0, std::nullopt, random);
    captured += static_cast<double>(drawn.captured) / draws;
    EXPECT_EQ(drawn.censored, drawn.captured == 20);
    if (drawn.censored) continue;
    mean += drawn.restitution;
    ++means;
    // As many as scatter now: sd_1 / sqrt(n - k).
    EXPECT_NEAR(own.sd, 0.03 * std::sqrt(14.0 / drawn.rebounds()), 1e-12);
  }
  EXPECT_NEAR(captured, 20.0 * p, 4.0 * std::sqrt(20.0 * p * (1.0 - p) / draws));
  EXPECT_NEAR(mean / means, expected, 4.0 * 0.035 / std::sqrt(draws));
}

// Three sizes, 20 impacts per point, drawn one by one: V* scatters by 6 %, e by 2 %. A point at the
// limit above which its scatter does not count went to and fro, round by round.
constexpr const char* made_package = R"({
 "name": "ds",
 "resources": [
  {
   "name": "points",
   "path": "points.csv",
   "schema": {
    "fields": [
     {
      "name": "series",
      "type": "string"
     },
     {
      "name": "diameter",
      "type": "number",
      "unit": "um"
     },
     {
      "name": "incident_velocity",
      "type": "number",
      "unit": "m/s"
     },
     {
      "name": "restitution",
      "type": "number",
      "unit": "1"
     },
     {
      "name": "events",
      "type": "integer",
      "unit": "1"
     },
     {
      "name": "captured",
      "type": "integer",
      "unit": "1"
     }
    ]
   }
  }
 ],
 "recoil": {
  "provenance": "synthetic",
  "particle": {
   "material": "ammonium fluorescein",
   "density": 1350,
   "youngs_modulus": 1200000000.0,
   "poisson_ratio": 0.33
  },
  "surface": {
   "material": "molybdenum",
   "youngs_modulus": 320000000000.0,
   "poisson_ratio": 0.31
  },
  "adhesion_energy": 0.25
 }
})";
constexpr const char* made_points = R"(series,diameter,incident_velocity,restitution,events,captured
d2.58,2.58,1.938501,0.202948,20,17
d2.58,2.58,2.101743,0.229048,20,9
d2.58,2.58,2.244580,0.325587,20,0
d2.58,2.58,2.448633,0.423843,20,0
d2.58,2.58,2.754712,0.521064,20,0
d2.58,2.58,3.264843,0.612262,20,0
d2.58,2.58,4.081054,0.675381,20,0
d2.58,2.58,5.509423,0.736914,20,0
d2.58,2.58,7.754003,0.771167,20,0
d2.58,2.58,11.222899,0.786147,20,0
d2.58,2.58,16.324217,0.786564,20,0
d2.58,2.58,24.486326,0.774627,20,0
d4.9,4.9,0.812832,0.182862,20,18
d4.9,4.9,0.881281,0.240923,20,5
d4.9,4.9,0.941173,0.330737,20,2
d4.9,4.9,1.026735,0.480793,20,0
d4.9,4.9,1.155077,0.569912,20,0
d4.9,4.9,1.368980,0.672131,20,0
d4.9,4.9,1.711224,0.750193,20,0
d4.9,4.9,2.310153,0.813200,20,0
d4.9,4.9,3.251326,0.841321,20,0
d4.9,4.9,4.705867,0.861684,20,0
d4.9,4.9,6.844898,0.876284,20,0
d4.9,4.9,10.267347,0.868127,20,0
d6.89,6.89,0.519035,,20,20
d6.89,6.89,0.562743,0.199570,20,5
d6.89,6.89,0.600988,0.333623,20,2
d6.89,6.89,0.655623,0.481752,20,0
d6.89,6.89,0.737576,0.601506,20,0
d6.89,6.89,0.874165,0.707003,20,0
d6.89,6.89,1.092706,0.775625,20,0
d6.89,6.89,1.475153,0.833488,20,0
d6.89,6.89,2.076141,0.868859,20,0
d6.89,6.89,3.004941,0.891258,20,0
d6.89,6.89,4.370823,0.902883,20,0
d6.89,6.89,6.556234,0.900837,20,0
)";

TEST(Captures, RoundsEndWhereAPointIsAtTheLimitOfItsScatter) {
  support::TemporaryFolder folder;
  folder.write("ds/datapackage.json", made_package);
  folder.write("ds/points.csv", made_points);
  folder.write("fit.toml", "dataset = \"ds\"\n[uncertainty]\nmaterials = false\n");
  const FitSpec spec = load_fit(folder / "fit.toml");
  const std::vector<Dataset> datasets = {load_dataset(folder / "ds")};
  const FitResult fitted = fit(make_model(spec, datasets), gather(datasets, spec));
  ASSERT_TRUE(fitted.usable);
  EXPECT_TRUE(fitted.weights_at_rest);
}

}  // namespace
}  // namespace recoil
