// What is taken as noise: estimated variance functions and Student's t on data whose noise is
// known. The truth comes from the simulator of the reconstructions.

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"
#include "estimate/fit.hpp"
#include "estimate/residual.hpp"
#include "estimate/reweighting.hpp"
#include "support/one_size.hpp"

namespace recoil {
namespace {

using one_size::design;
using one_size::fit_to;

/// sd of a single impact of a point without noise, written down a second time.
double event_sd(VarianceFunction function, double s, const ImpactPoint& point) {
  const double e = point.restitution;
  if (function == VarianceFunction::proportional) return s * std::hypot(e, 0.1);
  if (function == VarianceFunction::capture) return s / (2.0 * e);
  if (function == VarianceFunction::steep) {
    static const double capture = true_capture_velocity(one_size::truth(), one_size::diameter);
    return s * std::exp(2.0 * std::pow(capture / point.incident_velocity, 2));
  }
  return s;
}

class EstimatedVariance : public testing::TestWithParam<VarianceFunction> {};

TEST_P(EstimatedVariance, ScaleAndParametersAreUnbiased) {
  constexpr int sets = 120;
  // Small enough for first-order errors where steep makes it sevenfold.
  const double s = GetParam() == VarianceFunction::steep ? 0.01 : 0.04;
  const Dataset clean = design(16);
  NoiseSpec spec;
  spec.variance = GetParam();
  double scale_squared = 0.0;
  double theta[2] = {0.0, 0.0};
  double squares[2] = {0.0, 0.0};
  double claimed[2] = {0.0, 0.0};
  for (std::uint64_t k = 0; k < sets; ++k) {
    Dataset data = clean;
    RandomStream random(21, RandomPurpose::coverage, k);
    for (std::size_t i = 0; i < data.points.size(); ++i) {
      ImpactPoint& point = data.points[i];
      point.events = i % 3 == 0 ? 16 : 4;  // means of n weigh as such
      const double sd = event_sd(GetParam(), s, point) / std::sqrt(point.events);
      point.restitution += sd * random.normal();
    }
    const FitResult result = fit_to(data, spec);
    ASSERT_TRUE(result.usable) << result.failure;
    EXPECT_EQ(result.weights.noise.variance, GetParam());
    EXPECT_NEAR(result.noise_scale, 1.0, 1e-3);
    EXPECT_NEAR(result.chi2, result.dof, 1e-2 * result.dof);
    scale_squared += std::pow(result.weights.noise.scale / s, 2) / sets;
    const double expected[2] = {3e-3, 0.03};
    for (std::size_t j = 0; j < 2; ++j) {
      const double error = result.theta[j] / expected[j] - 1.0;
      theta[j] += error / sets;
      squares[j] += error * error / sets;
      claimed[j] += std::pow(result.std_error[j] / expected[j], 2) / sets;
    }
  }
  // s^2 of 14 degrees of freedom scatters by 38 %, its mean over 120 sets by 3.5 %.
  EXPECT_NEAR(scale_squared, 1.0, 0.1);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_NEAR(theta[j], 0.0, 3.5 * std::sqrt(squares[j] / sets)) << j;
    // 3.5 times sqrt(2 / 120); steep knows V* only to the first order in the damping.
    EXPECT_NEAR(squares[j] / claimed[j], 1.0, GetParam() == VarianceFunction::steep ? 0.7 : 0.45)
        << j;
  }
}

INSTANTIATE_TEST_SUITE_P(Noise, EstimatedVariance,
                         testing::Values(VarianceFunction::constant, VarianceFunction::proportional,
                                         VarianceFunction::capture, VarianceFunction::steep),
                         [](const auto& at) { return to_string(at.param); });

TEST(Noise, SixtyPointsTellTheVarianceFunction) {
  const Dataset clean = design(60);
  for (const VarianceFunction function :
       {VarianceFunction::proportional, VarianceFunction::capture, VarianceFunction::steep}) {
    int right = 0;
    for (std::uint64_t k = 0; k < 10; ++k) {
      Dataset data = clean;
      RandomStream random(22, RandomPurpose::coverage, k);
      for (ImpactPoint& point : data.points) {
        // Relative noise counts for the choice where e varies most.
        point.restitution += event_sd(function, 0.05, point) * random.normal();
      }
      const FitResult result = fit_to(data);
      ASSERT_TRUE(result.usable);
      ASSERT_EQ(result.weights.noise.candidates.size(), 4U);
      const VarianceFunction chosen = result.weights.noise.variance;
      // Capture and steep differ over a few points only: either stands for a growth to capture.
      const bool grows = chosen == VarianceFunction::capture || chosen == VarianceFunction::steep;
      right += function == VarianceFunction::capture ? grows : chosen == function;
      const bool opposite = function == VarianceFunction::proportional
                                ? result.weights.noise.variance == VarianceFunction::capture
                                : result.weights.noise.variance == VarianceFunction::proportional;
      EXPECT_FALSE(opposite && choice_margin(result.weights.noise) > 4.0);
      EXPECT_GE(choice_margin(result.weights.noise), 0.0);
    }
    const int least = function == VarianceFunction::steep     ? 8
                      : function == VarianceFunction::capture ? 5
                                                              : 2;
    EXPECT_GE(right, least) << to_string(function);
  }
}

TEST(Noise, TheChoiceIsReportedWithItsMargin) {
  Dataset data = design(12);
  RandomStream random(23, RandomPurpose::coverage, 0);
  for (ImpactPoint& point : data.points) point.restitution += 0.02 * random.normal();
  const FitResult result = fit_to(data);
  ASSERT_TRUE(result.usable);
  EXPECT_EQ(result.noise_verdict, NoiseVerdict::estimated);
  EXPECT_EQ(result.weights.noise.candidates.size(), 4U);
  EXPECT_GT(choice_margin(result.weights.noise), 0.0);
  NoiseSpec asked;
  asked.variance = VarianceFunction::constant;
  const FitResult constant = fit_to(data, asked);
  EXPECT_EQ(constant.weights.noise.variance, VarianceFunction::constant);
  EXPECT_TRUE(constant.weights.noise.candidates.empty());
}

TEST(Noise, StatedDeviationsAreUsedAndTheMissingOnesCompleted) {
  Dataset data = design(6);
  for (ImpactPoint& point : data.points) point.restitution_sd = 0.01;
  EXPECT_TRUE(gather({data}).noise.sd_stated);
  NoiseSpec constant;
  constant.variance = VarianceFunction::constant;
  EXPECT_FALSE(gather({data}, constant).noise.sd_stated);
  data.points[2].restitution_sd.reset();
  const Observations mixed = gather({data});
  EXPECT_TRUE(mixed.noise.sd_stated);
  EXPECT_EQ(mixed.noise.sd_set_aside, 0);
  EXPECT_EQ(mixed.noise.sd_missing, 1);
  EXPECT_EQ(mixed.points[2].sd, 0.01) << "the median of the others";
  NoiseSpec stated;
  stated.variance = VarianceFunction::stated;
  EXPECT_THROW(gather({data}, stated), InputError);
}

TEST(Noise, StudentHoldsAgainstOutliers) {
  constexpr int sets = 100;
  const Dataset clean = design(16);
  double square_normal = 0.0;
  double square_student = 0.0;
  for (std::uint64_t k = 0; k < sets; ++k) {
    Dataset data = clean;
    RandomStream random(25, RandomPurpose::coverage, k);
    for (ImpactPoint& point : data.points) {
      const double factor = random.uniform() < 0.1 ? 6.0 : 1.0;
      point.restitution_sd = 0.01;
      point.restitution += factor * 0.01 * random.normal();
    }
    NoiseSpec student;
    student.student = true;
    const FitResult a = fit_to(data);
    const FitResult b = fit_to(data, student);
    ASSERT_TRUE(a.usable && b.usable);
    square_normal += std::pow(a.theta[1] / 0.03 - 1.0, 2);
    square_student += std::pow(b.theta[1] / 0.03 - 1.0, 2);
    ASSERT_TRUE(b.data.noise.student);
    EXPECT_EQ(b.data.noise.student->dof, 4.0);
  }
  EXPECT_GT(square_normal / square_student, 1.5);
}

TEST(Noise, StudentScaleMeansTheNormalCore) {
  // With normal noise the estimated scale and the misfit are those of least squares, on average;
  // with 14 degrees of freedom the scale comes out a little large.
  constexpr int sets = 80;
  const Dataset clean = design(16);
  double log_scale = 0.0;
  double ratio = 0.0;
  int small = 0;
  for (std::uint64_t k = 0; k < sets; ++k) {
    Dataset data = clean;
    RandomStream random(26, RandomPurpose::coverage, k);
    for (ImpactPoint& point : data.points) point.restitution += 0.02 * random.normal();
    NoiseSpec spec;
    spec.student = true;
    spec.variance = VarianceFunction::constant;
    const FitResult estimated = fit_to(data, spec);
    ASSERT_TRUE(estimated.usable);
    log_scale += std::log(estimated.weights.noise.scale / 0.02) / sets;
    ratio += std::pow((estimated.theta[1] - 0.03) / estimated.std_error[1], 2) / sets;
    for (ImpactPoint& point : data.points) point.restitution_sd = 0.02;
    spec.variance.reset();
    small += fit_to(data, spec).p_value < 0.05 ? 1 : 0;
  }
  EXPECT_NEAR(log_scale, 0.05, 0.1);
  EXPECT_NEAR(ratio, 1.1, 0.5);
  EXPECT_LE(small, 10);  // 4 expected
}

TEST(Noise, SimulatedPointsHaveTheNoiseThatWeightsThem) {
  Observation point;
  PointWeights weights;
  point.restitution = 0.7;
  weights.sd = 0.02;
  weights.input_sd = 0.03;
  double mean = 0.0;
  double square = 0.0;
  constexpr int draws = 4000;
  for (int i = 0; i < draws; ++i) {
    RandomStream random(27, RandomPurpose::bootstrap, static_cast<std::uint64_t>(i));
    const double e =
        simulate_observation(point, weights, 0.64, 1.0, std::nullopt, random).point.restitution;
    mean += (e - 0.8) / draws;
    square += (e - 0.8) * (e - 0.8) / draws;
  }
  const double sd = std::hypot(0.02, 0.03 / 1.6);  // sd(e) = sd(e^2) / 2 e
  EXPECT_NEAR(mean, 0.0, 4.0 * sd / std::sqrt(draws) + 0.03 * 0.03 / (8.0 * 0.512));
  EXPECT_NEAR(std::sqrt(square) / sd, 1.0, 0.05);
  point.censored = true;
  point.captured = 1;
  RandomStream random(27, RandomPurpose::bootstrap, 0);
  EXPECT_TRUE(simulate_observation(point, weights, -0.1, 1.0, std::nullopt, random).point.censored);
}

TEST(Noise, ReweightingASecondTimeChangesNothing) {
  Dataset data = design(14);
  RandomStream random(28, RandomPurpose::coverage, 0);
  for (ImpactPoint& point : data.points) {
    point.restitution += 0.03 * random.normal();
    point.velocity_sd = 0.02 * point.incident_velocity;
  }
  const FitResult first = fit_to(data);
  ASSERT_TRUE(first.usable);
  const ReweightedFit again =
      reweighted_fit(first.model, first.data, first.weights.noise, first.theta);
  ASSERT_TRUE(again.run.converged);
  EXPECT_EQ(again.weights.noise.variance, first.weights.noise.variance);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_NEAR(again.run.theta[j], first.theta[j], 5e-3 * first.std_error[j]);
  }
}

/// Neither stated nor to be seen: as many points as parameters, or readings that do not scatter.
TEST(Noise, IsUnknownWhereNothingScatters) {
  Dataset two = design(2);
  for (ImpactPoint& point : two.points) point.restitution_sd.reset();
  Dataset equal = two;
  for (int k = 0; k < 8; ++k) equal.points.push_back(equal.points.front());
  equal.points.erase(equal.points.begin() + 1);
  for (const Dataset& data : {two, equal}) {
    const FitResult result = fit_to(data);
    ASSERT_TRUE(result.usable) << result.failure;
    EXPECT_FALSE(result.weights.noise.known);
    EXPECT_EQ(result.noise_verdict, NoiseVerdict::unchecked);
    EXPECT_TRUE(result.covariance.empty());
    for (const double error : result.std_error) EXPECT_EQ(error, 0.0);
  }
}

// Rounding to 0.01 has the standard deviation of a uniform number, 0.01 / sqrt(12). Readings that
// by chance lie within 0.0005 of the curve do not know it better than that.
TEST(Noise, IsNotSmallerThanTheRoundingOfTheReadings) {
  Dataset data = design(300);
  std::erase_if(data.points, [](const ImpactPoint& point) {
    const double steps = 100.0 * point.restitution;
    return std::abs(steps - std::round(steps)) > 0.05;
  });
  ASSERT_GT(data.points.size(), 10U);
  for (ImpactPoint& point : data.points) {
    point.restitution = std::round(100.0 * point.restitution) / 100.0;
  }
  NoiseSpec spec;
  spec.variance = VarianceFunction::constant;
  const FitResult result = fit_to(data, spec);
  ASSERT_TRUE(result.usable) << result.failure;
  EXPECT_TRUE(result.weights.noise.known);
  for (const PointWeights& own : result.weights.points) {
    EXPECT_NEAR(own.sd * result.noise_scale, 0.01 / std::sqrt(12.0), 1e-9);
  }
}

TEST(Noise, StatedErrorsNeedNoScatter) {
  Dataset two = design(2);
  for (ImpactPoint& point : two.points) point.restitution_sd = 0.01;
  const FitResult result = fit_to(two);
  ASSERT_TRUE(result.usable) << result.failure;
  EXPECT_TRUE(result.weights.noise.known);
  EXPECT_GT(result.std_error[0], 0.0);
}

// Rounded to 0.01, e has an error of 0.0029 that a stated 0.002 does not include.
TEST(Noise, RoundingAddsToSmallerStatedErrors) {
  const double sd = 0.002;
  int rejected = 0;
  for (std::uint64_t k = 0; k < 40; ++k) {
    Dataset data = design(24);
    RandomStream random(5, RandomPurpose::coverage, k);
    for (ImpactPoint& point : data.points) {
      point.restitution = std::round(100.0 * (point.restitution + sd * random.normal())) / 100.0;
      point.restitution_sd = sd;
    }
    const FitResult result = fit_to(data);
    ASSERT_TRUE(result.usable) << result.failure;
    EXPECT_EQ(result.data.noise.sd_rounded, 24);
    EXPECT_NEAR(result.weights.points.front().sd, std::hypot(sd, 0.01 / std::sqrt(12.0)), 1e-12);
    if (result.p_value < 0.05) ++rejected;
  }
  EXPECT_LE(rejected, 6);  // 2 of 40 expected; more than 6 have a probability of 0.3 %
}

TEST(Noise, CoarserStatedErrorsIncludeTheRounding) {
  Dataset data = design(24);
  for (ImpactPoint& point : data.points) {
    point.restitution = std::round(100.0 * point.restitution) / 100.0;
    point.restitution_sd = 0.005;
  }
  const FitResult result = fit_to(data);
  EXPECT_EQ(result.data.noise.sd_rounded, 0);
  EXPECT_EQ(result.weights.points.front().sd, 0.005);
}

}  // namespace
}  // namespace recoil
