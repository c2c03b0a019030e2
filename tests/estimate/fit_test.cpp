// The full fit and the paper's two-point iteration on data whose truth is known.
#include "estimate/fit.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "estimate/capture_velocity.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"
#include "support/synthetic.hpp"

namespace recoil {
namespace {

using synthetic::Design;

FitOptions one_start() {
  FitOptions options;
  options.several_starts = false;
  return options;
}

FitResult fit_design(const Design& design, bool f0_free = false, Solver solver = Solver::fast,
                     const FitOptions& options = one_start()) {
  const std::vector<Dataset> datasets = {synthetic::dataset(design)};
  ImpactModel model = make_model(synthetic::spec(f0_free), datasets);
  model.solver.kind = solver;
  return fit(model, gather(datasets), options);
}

TEST(Fit, ThatEndsWithoutAnAnswerTellsTheBestSoFar) {
  const Dataset dataset = synthetic::dataset({});
  FitOptions options = one_start();
  options.minimiser.max_iterations = 1;
  const ImpactModel model = make_model(synthetic::spec(), {dataset});
  options.start = model.initial();
  options.start[0] *= 30.0;
  const FitResult fitted = fit(model, gather({dataset}), options);
  ASSERT_FALSE(fitted.usable);
  for (const char* name : {"C_H = ", "C_A = "}) {
    const std::size_t at = fitted.failure.find(name);
    ASSERT_NE(at, std::string::npos) << fitted.failure;
    EXPECT_GT(std::stod(fitted.failure.substr(at + 6)), 0.0);
  }
}

TEST(Residual, IsGaussianInRestitutionAwayFromCapture) {
  Observation point;
  PointWeights weights;
  point.restitution = 0.8;
  weights.sd = 0.01;
  for (const double model_e : {0.75, 0.79, 0.8, 0.83}) {
    EXPECT_NEAR(weighted_residual(point, weights, model_e * model_e).value, (0.8 - model_e) / 0.01,
                2e-2 * (1.0 + std::abs(0.8 - model_e) / 0.01));
  }
}

TEST(Residual, HasTheVarianceOfTheSquareAtCapture) {
  // At e = m = 0 the variance of e^2 for Gaussian noise is 2 sigma^4 (+ psi): finite, not 4 e^2
  // s^2.
  Observation point;
  PointWeights weights;
  point.restitution = 0.0;
  weights.sd = 0.02;
  const WeightedResidual at = weighted_residual(point, weights, 0.0);
  EXPECT_TRUE(std::isfinite(at.value));
  EXPECT_LT(at.slope, 0.0);
  EXPECT_GT(at.slope, -1.0 / (0.02 * 0.02));
}

RC_GTEST_PROP(Residual, FallsSmoothlyWithTheModelAndHasItsOwnSlope, ()) {
  Observation point;
  PointWeights weights;
  point.restitution = *rc::gen::inRange(0, 1100) / 1000.0;
  weights.sd = *rc::gen::inRange(1, 200) / 1000.0;
  point.censored = *rc::gen::inRange(0, 4) == 0;
  point.captured = point.censored ? 1 : 0;
  const double m = *rc::gen::inRange(-3000, 1200) / 1000.0;
  const double h = 1e-6 * std::max(std::abs(m), weights.sd * weights.sd);
  const WeightedResidual at = weighted_residual(point, weights, m);
  const double difference = (weighted_residual(point, weights, m + h).value -
                             weighted_residual(point, weights, m - h).value) /
                            (2.0 * h);
  RC_ASSERT(std::isfinite(at.value));
  RC_ASSERT(std::abs(difference - at.slope) <= 1e-4 * std::abs(at.slope) + 1e-6);
  RC_ASSERT((point.censored ? at.slope >= 0.0 : at.slope <= 0.0));
}

TEST(Fit, RecoversTheTruthFromNoiselessPoints) {
  const Design design;
  const FitResult result = fit_design(design);
  ASSERT_TRUE(result.usable) << result.failure;
  // y = e^2 - sigma^2 shifts noiseless points by sigma^2: a bias far below the standard error.
  EXPECT_NEAR(result.theta[0], design.C_H, 0.02 * result.std_error[0]);
  EXPECT_NEAR(result.theta[1], design.C_A, 0.02 * result.std_error[1]);
  EXPECT_LT(result.chi2, 1e-2);
  EXPECT_EQ(result.dof, 12);
}

TEST(Fit, RecoversAFreeAdhesionForceOfTwoSizes) {
  Design design;
  design.f0 = 10.0;  // not the value of eq. 12
  design.velocities = {2.9, 3.2, 4.0, 6.5, 12.0, 25.0, 50.0, 90.0};
  design.diameters = {4.9e-6, 6.89e-6};
  const FitResult result = fit_design(design, true);
  ASSERT_TRUE(result.usable) << result.failure;
  EXPECT_NEAR(result.theta[2], 10.0, 0.1 * result.std_error[2]);
}

TEST(Fit, CapturedPointsAreDataNotGaps) {
  Design design;
  design.velocities = {0.6, 0.8, 2.5, 6.0, 25.0, 90.0};  // the slowest two are captured
  const Dataset data = synthetic::dataset(design);
  const auto captured = std::count_if(data.points.begin(), data.points.end(),
                                      [](const ImpactPoint& p) { return p.captured > 0; });
  ASSERT_GE(captured, 3);
  const FitResult result = fit_design(design);
  ASSERT_TRUE(result.usable) << result.failure;
  EXPECT_NEAR(result.theta[1], design.C_A, 0.3 * result.std_error[1]);
}

TEST(Fit, CapturedPointsThatTheModelCapturesAreNoDegreesOfFreedom) {
  Design design;
  design.velocities = {0.1, 0.2, 0.3, 2.5, 4.0, 6.5, 12.0, 25.0, 90.0};  // three deep in capture
  design.diameters = {4.9e-6};
  const FitResult result = fit_design(design);
  ASSERT_TRUE(result.usable) << result.failure;
  EXPECT_EQ(result.dof, 6 - 2);
}

TEST(Fit, BothSolversGiveTheSameEstimate) {
  const Design design;
  const FitResult fast = fit_design(design);
  const FitResult reference = fit_design(design, false, Solver::reference);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_NEAR(fast.theta[j], reference.theta[j], 0.01 * reference.std_error[j]);
    EXPECT_NEAR(fast.std_error[j], reference.std_error[j], 0.01 * reference.std_error[j]);
  }
}

TEST(Fit, AllStartsAgreeAndAreReported) {
  const FitResult result = fit_design(Design{}, false, Solver::fast, FitOptions{});
  ASSERT_GE(result.starts.size(), 9U);
  int agreeing = 0;
  for (const StartSummary& start : result.starts) {
    if (start.converged() && std::abs(start.end[1] - result.theta[1]) < 1e-3 * result.theta[1]) {
      ++agreeing;
    }
  }
  EXPECT_GE(agreeing, 7);
}

TEST(Fit, NoAdhesionDampingInTheDataRestsOnTheBound) {
  Design design;
  design.C_A = 0.0;
  Dataset data = synthetic::dataset(design);
  // Less loss at low velocity than C_H alone gives: C_A would have to be negative.
  for (ImpactPoint& point : data.points) {
    if (point.incident_velocity < 10.0) point.restitution = std::min(1.0, point.restitution + 0.02);
  }
  const std::vector<Dataset> datasets = {data};
  const FitResult result =
      fit(make_model(synthetic::spec(), datasets), gather(datasets), one_start());
  ASSERT_TRUE(result.usable);
  EXPECT_TRUE(result.at_bound[1]);
  EXPECT_EQ(result.theta[1], 0.0);
  EXPECT_EQ(result.std_error[1], 0.0);
}

TEST(Fit, TooFewPointsIsAFailureInWords) {
  Design design;
  design.diameters = {4.9e-6};
  design.velocities = {5.0};
  const FitResult result = fit_design(design);
  EXPECT_FALSE(result.usable);
  EXPECT_NE(result.failure.find("1 point cannot determine 2 free parameters"), std::string::npos);
}

TEST(Fit, WidensTheErrorsWhereTheModelMisses) {
  Dataset data = synthetic::dataset(Design{});
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    data.points[i].restitution += i % 2 == 0 ? 0.04 : -0.04;  // four standard deviations
  }
  const std::vector<Dataset> datasets = {data};
  const FitResult result =
      fit(make_model(synthetic::spec(), datasets), gather(datasets), one_start());
  ASSERT_TRUE(result.usable);
  EXPECT_LT(result.p_value, 1e-6);
  EXPECT_NEAR(result.noise_scale, std::sqrt(result.chi2 / result.dof), 1e-12);
  EXPECT_GT(result.noise_scale, 3.0);
}

TEST(Predict, AnswersThatAreKeptAreThoseOfAnEvaluation) {
  const synthetic::Design design;
  const Dataset dataset = synthetic::dataset(design);
  const ImpactModel model = make_model(synthetic::spec(), {dataset});
  const std::vector<PointConditions> points = gather({dataset}).conditions();
  PointPredictor kept(model, points);
  std::vector<double> other = model.initial();
  other[model.slot_C_A[0]] *= 1.5;
  // The first theta, another, the first again, the last twice; the gradient last.
  for (const auto& [theta, gradient] :
       {std::pair(model.initial(), true), std::pair(other, false), std::pair(model.initial(), true),
        std::pair(other, false), std::pair(other, true), std::pair(other, true)}) {
    PointPredictor fresh(model, points);
    fresh.evaluate(theta, gradient);
    kept.evaluate_blocks(theta, gradient, [](std::size_t, std::span<const ImpactResult>) {});
    std::vector<double> row(theta.size());
    std::vector<double> expected(theta.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(kept.at(i).restitution_squared, fresh.at(i).restitution_squared) << i;
      if (!gradient) continue;
      kept.gradient_row(i, 1.0, row);
      fresh.gradient_row(i, 1.0, expected);
      EXPECT_EQ(row, expected) << i;
    }
  }
}

TEST(Predict, GradientInEveryParameterMatchesDifferences) {
  const std::vector<Dataset> datasets = {synthetic::dataset(Design{})};
  for (const Solver solver : {Solver::fast, Solver::reference}) {
    ImpactModel model = make_model(synthetic::spec(true), datasets);
    model.solver.kind = solver;
    const std::vector<double> theta = {3e-3, 0.03, 8.9};
    for (const double d : {2.58e-6, 6.89e-6}) {  // not the diameter at which f0 is stated
      for (const double v : {0.5, 3.0, 30.0}) {  // captured (2.58 um), slow, fast
        const Prediction at = predict(model, theta, 0, d, v, true);
        ASSERT_TRUE(at.usable());
        for (std::size_t j = 0; j < 3; ++j) {
          // Fourth-order central difference: truncation ~1e-9, noise of the integrator ~1e-11 / h.
          const double h = 2e-3 * theta[j];
          const auto e2 = [&](double steps) {
            std::vector<double> moved = theta;
            moved[j] += steps * h;
            return predict(model, moved, 0, d, v, false).restitution_squared;
          };
          const double difference =
              (8.0 * (e2(1.0) - e2(-1.0)) - (e2(2.0) - e2(-2.0))) / (12.0 * h);
          EXPECT_NEAR(at.gradient[j] * theta[j], difference * theta[j],
                      1e-7 * std::max(1.0, std::abs(difference * theta[j])))
              << "slot " << j << ", d = " << d << ", V = " << v;
        }
      }
    }
  }
}

TEST(CaptureVelocity, MatchesTheIndependentSimulator) {
  const Design design;
  const std::vector<Dataset> datasets = {synthetic::dataset(design)};
  const ImpactModel model = make_model(synthetic::spec(), datasets);
  const std::vector<double> theta = {design.C_H, design.C_A, design.f0};
  const Truth truth = synthetic::truth_of(design);
  for (const double d : {2.58e-6, 4.9e-6, 6.89e-6}) {
    const CaptureVelocity found = capture_velocity(model, theta, 0, d);
    ASSERT_TRUE(found.found);
    EXPECT_NEAR(found.value / true_capture_velocity(truth, d), 1.0, 1e-6);
    for (std::size_t j = 0; j < 3; ++j) {  // gradient against differences
      std::vector<double> more = theta, less = theta;
      more[j] *= 1.0 + 1e-4;
      less[j] *= 1.0 - 1e-4;
      const double difference =
          (capture_velocity(model, more, 0, d).value - capture_velocity(model, less, 0, d).value) /
          (2e-4 * theta[j]);
      EXPECT_NEAR(found.gradient[j] / difference, 1.0, 1e-3) << "slot " << j;
    }
  }
  EXPECT_EQ(capture_velocity(model, std::vector<double>{0.0, 0.0, 8.9}, 0, 4.9e-6).value, 0.0);
  EXPECT_FALSE(capture_velocity(model, std::vector<double>{0.0, 9.0, 8.9}, 0, 4.9e-6).found);
}

TEST(CaptureVelocity, IsFoundFromWhereverOneLooksFirst) {
  const Dataset data = synthetic::dataset({});
  const ImpactModel model = make_model(synthetic::spec(), {data});
  const std::vector<double> theta = {3.12e-3, 4.87e-2, 8.9};
  for (const double diameter : {1.5e-6, 4.9e-6, 200e-6}) {
    const double found = capture_velocity(model, theta, 0, diameter).value;
    for (const double times : {0.02, 0.3, 0.9, 1.5, 10.0, 100.0}) {
      const CaptureVelocity again = capture_velocity(model, theta, 0, diameter, times * found);
      EXPECT_TRUE(again.found) << times << " of " << found;
      EXPECT_NEAR(again.value / found, 1.0, 1e-8) << times;
    }
  }
}

}  // namespace
}  // namespace recoil
