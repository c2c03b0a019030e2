// The error of the laws: its functions, its place in a prediction, and a fit averaged over it.
#include "estimate/law_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/random.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/law_average.hpp"
#include "estimate/model_verdict.hpp"
#include "estimate/predictor.hpp"
#include "support/synthetic.hpp"

namespace recoil {
namespace {

using synthetic::Design;

constexpr double um = 1e-6;

std::vector<PointConditions> some_points() {
  std::vector<PointConditions> points;
  for (const double diameter : {2.0 * um, 5.0 * um}) {
    for (const double velocity : {0.9, 1.3, 2.0, 3.1, 5.0, 9.0, 17.0}) {
      points.push_back({0, diameter, velocity});
    }
  }
  return points;
}

double covariance(const LawError& error, const PointConditions& a, const PointConditions& b) {
  std::vector<double> one(error.count()), other(error.count());
  error.functions(a, one);
  error.functions(b, other);
  return std::inner_product(one.begin(), one.end(), other.begin(), 0.0);
}

TEST(LawError, HasTheStatedCovarianceAtThePoints) {
  const std::vector<PointConditions> points = some_points();
  const double s = 0.03;
  for (const bool by_size : {false, true}) {
    for (const double length : {0.8, 1.6}) {
      const LawError error({s, length, by_size}, points);
      EXPECT_LT(error.count(), points.size() + 4);
      for (const PointConditions& a : points) {
        for (const PointConditions& b : points) {
          const double x = std::log(a.velocity / b.velocity) / length;
          const double y = std::log(a.diameter / b.diameter) / 1.6;
          const double in_size =
              by_size ? (a.diameter == b.diameter ? 1.0 : 0.0) : std::exp(-0.5 * y * y);
          // The functions leave out a thousandth of the variance.
          EXPECT_NEAR(covariance(error, a, b), s * s * std::exp(-0.5 * x * x) * in_size,
                      1e-3 * s * s);
        }
      }
    }
  }
}

TEST(LawError, IsConstantFarBelowThePointsAndFallsFromCapture) {
  const std::vector<PointConditions> points = some_points();
  const LawError even({0.03, 1.6}, points);
  EXPECT_EQ(covariance(even, {0, 2.0 * um, 0.1}, {0, 2.0 * um, 0.2}),
            covariance(even, {0, 2.0 * um, 0.1}, {0, 2.0 * um, 0.1}));
  const LawError slow({0.03, 1.6, false, true}, points);
  const auto sd = [&](double velocity) {
    const PointConditions at{0, 2.0 * um, velocity};
    return std::sqrt(covariance(slow, at, at));
  };
  EXPECT_NEAR(sd(0.9), 0.03, 1e-4);
  EXPECT_NEAR(sd(9.0), 0.03 / 100.0, 1e-6);
}

ImpactModel bent_model(const std::vector<Dataset>& datasets, std::vector<double>& theta,
                       double coefficient = 0.7) {
  const ImpactModel plain = make_model(synthetic::spec(), datasets);
  const Observations data = gather(datasets);
  ImpactModel model = with_law_error(plain, {0.05, 0.8}, data.conditions());
  theta = model.initial();
  for (std::size_t j = model.first_law_slot(); j < theta.size(); ++j) {
    theta[j] = coefficient * std::cos(static_cast<double>(j));
  }
  return model;
}

/// @return the least g that was met
double check_loss_and_derivatives(double coefficient) {
  double least = 0.0;
  const std::vector<Dataset> datasets = {synthetic::dataset(Design{})};
  std::vector<double> theta;
  const ImpactModel model = bent_model(datasets, theta, coefficient);
  const ImpactModel plain = with_exact_laws(model);
  EXPECT_EQ(plain.slots.size(), make_model(synthetic::spec(), datasets).slots.size());
  const std::vector<double> base(theta.begin(),
                                 theta.begin() + static_cast<std::ptrdiff_t>(plain.slots.size()));
  const auto square = [&](const std::vector<double>& at, double velocity, double diameter) {
    return predict(model, at, 0, diameter, velocity, false).restitution_squared;
  };
  for (const double velocity : {3.0, 8.0, 40.0}) {
    const double diameter = 4.9 * um;
    const double g = (*model.law_error)(
        {0, diameter, velocity}, std::span<const double>(theta).subspan(model.first_law_slot()));
    const Prediction bent = predict(model, theta, 0, diameter, velocity, true);
    const double loss =
        1.0 - predict(plain, base, 0, diameter, velocity, false).restitution_squared;
    least = std::min(least, g);
    const double factor = g < -0.5 ? -1.0 / (4.0 * g) : 1.0 + g;
    EXPECT_NEAR(bent.restitution_squared, 1.0 - loss * factor, 1e-12);
    EXPECT_LT(bent.restitution_squared, 1.0);
    for (std::size_t j = 0; j < theta.size(); ++j) {
      const double step = 1e-5 * std::max(0.1 * std::abs(theta[j]), 1e-3);
      std::vector<double> more = theta, less = theta;
      more[j] += step;
      less[j] -= step;
      const double slope =
          (square(more, velocity, diameter) - square(less, velocity, diameter)) / (2.0 * step);
      EXPECT_NEAR(bent.gradient[j], slope, 1e-5 * std::max(1.0, std::abs(slope)));
    }
    PointPredictor predictor(model, {{0, diameter, velocity}});
    predictor.evaluate(theta, true);
    const double h = 1e-4;
    EXPECT_NEAR(predictor.velocity_slope(0) * velocity,
                (square(theta, velocity * (1 + h), diameter) -
                 square(theta, velocity * (1 - h), diameter)) /
                    (2.0 * h),
                1e-5);
    EXPECT_NEAR(predictor.diameter_slope(0) * diameter,
                (square(theta, velocity, diameter * (1 + h)) -
                 square(theta, velocity, diameter * (1 - h))) /
                    (2.0 * h),
                1e-5);
  }
  return least;
}

TEST(LawError, MultipliesTheLossAndItsDerivativesFollow) {
  EXPECT_GT(check_loss_and_derivatives(0.7), -0.5);
}

// However wrong the laws, an impact does not gain energy.
TEST(LawError, LeavesALossHoweverLargeItIs) {
  EXPECT_LT(check_loss_and_derivatives(-30.0), -0.5);
  check_loss_and_derivatives(30.0);
}

TEST(LawError, MovesTheCaptureVelocity) {
  const std::vector<Dataset> datasets = {synthetic::dataset(Design{})};
  std::vector<double> theta;
  const ImpactModel model = bent_model(datasets, theta);
  const CaptureVelocity found = capture_velocity(model, theta, 0, 4.9 * um);
  ASSERT_TRUE(found.found);
  EXPECT_NEAR(predict(model, theta, 0, 4.9 * um, found.value, false).restitution_squared, 0.0,
              1e-8);
}

/// The points of `design` with noise, and with the loss of every rebound times 1 + g(ln V).
template <class Bend>
FitResult fit_of(const Design& design, std::uint64_t seed, const Bend& bend) {
  std::vector<Dataset> datasets = {synthetic::dataset(design)};
  RandomStream random(seed, RandomPurpose::coverage, 0);
  for (ImpactPoint& point : datasets[0].points) {
    const double z = random.normal();
    if (point.restitution == 0.0) continue;
    const double loss = 1.0 - point.restitution * point.restitution;
    const double square = 1.0 - loss * (1.0 + bend(std::log(point.incident_velocity)));
    point.restitution = std::sqrt(square) + design.sd * z;
  }
  return fit_over_laws(make_model(synthetic::spec(), datasets), gather(datasets));
}

Design precise_design() {
  Design design;
  design.velocities = {3.0, 3.7, 4.6, 5.8, 7.5, 10.0, 14.0, 20.0, 29.0, 42.0, 62.0, 90.0};
  design.sd = 0.003;
  return design;
}

TEST(LawAverage, SeesNoErrorOfExactLaws) {
  int seen = 0;
  double upper = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const FitResult fitted = fit_of(precise_design(), seed, [](double) { return 0.0; });
    ASSERT_TRUE(fitted.usable) << fitted.failure;
    const ModelJudgement judged = judge_model(fitted);
    ASSERT_TRUE(judged.laws);
    if (judged.laws->seen()) ++seen;
    upper += 0.1 * judged.laws->upper;
    double sum = 0.0;
    for (const LawAlternative& one : fitted.laws) sum += one.weight;
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
  EXPECT_LT(upper, 0.08);  // on average; a quarter of what the prior alone says
  EXPECT_LE(seen, 1);      // of 10; each is seen with a probability of at most 5 %
}

TEST(LawAverage, MeasuresHowWrongTheLawsAre) {
  const double amplitude = 0.08;
  int contained = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const double phase = 0.6 * static_cast<double>(seed);
    const FitResult fitted = fit_of(
        precise_design(), seed, [&](double u) { return amplitude * std::sin(1.3 * u + phase); });
    ASSERT_TRUE(fitted.usable) << fitted.failure;
    const ModelJudgement judged = judge_model(fitted);
    ASSERT_TRUE(judged.laws);
    EXPECT_TRUE(judged.laws->seen()) << seed;
    EXPECT_EQ(judged.verdict, ModelVerdict::fits_within_law_error) << seed;
    const double rms = amplitude / std::sqrt(2.0);
    if (judged.laws->lower <= rms && rms <= judged.laws->upper) ++contained;
  }
  EXPECT_GE(contained, 8);
}

TEST(LawAverage, IsTheExactFitWhereTheNoiseIsUnknown) {
  Design design;
  design.velocities = {4.0, 20.0};
  design.diameters = {4.9 * um};
  std::vector<Dataset> datasets = {synthetic::dataset(design)};
  for (ImpactPoint& point : datasets[0].points) point.restitution_sd.reset();
  const ImpactModel model = make_model(synthetic::spec(), datasets);
  const FitResult fitted = fit_over_laws(model, gather(datasets));
  EXPECT_TRUE(fitted.laws.empty());
  EXPECT_EQ(fitted.theta, fit(model, gather(datasets)).theta);
}

}  // namespace
}  // namespace recoil
