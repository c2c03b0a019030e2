// What is taken as noise: estimated variance functions, effective variances, Student's t, on data
// whose noise is known. The truth comes from the simulator of the reconstructions.
#include "estimate/noise.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"
#include "estimate/fit.hpp"
#include "estimate/noise_words.hpp"
#include "synthetic.hpp"

namespace recoil {
namespace {

constexpr double diameter = 4.9e-6;

RingAdhesionTruth truth() {
  RingAdhesionTruth truth;
  truth.density = 1350.0;
  truth.stiffness = 1.789e9;
  truth.adhesion_force = 8.9;
  truth.reference_diameter = diameter;
  truth.C_H = 3e-3;
  truth.C_A = 0.03;
  return truth;
}

/// `count` velocities from 1.15 to 57 times the capture velocity, without noise or stated sd.
Dataset design(int count) {
  const double capture = true_capture_velocity(truth(), diameter);
  synthetic::Design design;
  design.diameters = {diameter};
  design.velocities.clear();
  for (int i = 0; i < count; ++i) {
    design.velocities.push_back(1.15 * capture * std::pow(50.0, i / (count - 1.0)));
  }
  Dataset data = synthetic::dataset(design);
  for (ImpactPoint& point : data.points) point.restitution_sd.reset();
  return data;
}

FitResult fit_to(const Dataset& data, const NoiseSpec& spec = {}) {
  FitOptions options;
  options.several_starts = false;
  const std::vector<Dataset> datasets = {data};
  return fit(make_model(synthetic::spec(), datasets), gather(datasets, spec), options);
}

/// sd of a single impact at e, written down a second time.
double event_sd(VarianceFunction function, double s, double e) {
  if (function == VarianceFunction::proportional) return s * std::hypot(e, 0.1);
  if (function == VarianceFunction::capture) return s / (2.0 * e);
  return s;
}

class EstimatedVariance : public testing::TestWithParam<VarianceFunction> {};

TEST_P(EstimatedVariance, ScaleAndParametersAreUnbiased) {
  constexpr int sets = 120;
  constexpr double s = 0.04;
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
      const double sd = event_sd(GetParam(), s, point.restitution) / std::sqrt(point.events);
      point.restitution += sd * random.normal();
    }
    const FitResult result = fit_to(data, spec);
    ASSERT_TRUE(result.usable) << result.failure;
    EXPECT_EQ(result.data.noise.variance, GetParam());
    EXPECT_NEAR(result.noise_scale, 1.0, 1e-3);
    EXPECT_NEAR(result.chi2, result.dof, 1e-2 * result.dof);
    scale_squared += std::pow(result.data.noise.scale / s, 2) / sets;
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
    EXPECT_NEAR(squares[j] / claimed[j], 1.0, 0.45) << j;  // 3.5 times sqrt(2 / 120)
  }
}

INSTANTIATE_TEST_SUITE_P(Noise, EstimatedVariance,
                         testing::Values(VarianceFunction::constant, VarianceFunction::proportional,
                                         VarianceFunction::capture),
                         [](const auto& at) { return to_string(at.param); });

TEST(Noise, SixtyPointsTellTheVarianceFunction) {
  const Dataset clean = design(60);
  for (const VarianceFunction function :
       {VarianceFunction::proportional, VarianceFunction::capture}) {
    int right = 0;
    for (std::uint64_t k = 0; k < 10; ++k) {
      Dataset data = clean;
      RandomStream random(22, RandomPurpose::coverage, k);
      for (ImpactPoint& point : data.points) {
        // Relative noise counts for the choice where e varies most.
        point.restitution += event_sd(function, 0.05, point.restitution) * random.normal();
      }
      const FitResult result = fit_to(data);
      ASSERT_TRUE(result.usable);
      ASSERT_EQ(result.data.noise.candidates.size(), 3U);
      right += result.data.noise.variance == function ? 1 : 0;
      const bool opposite = function == VarianceFunction::proportional
                                ? result.data.noise.variance == VarianceFunction::capture
                                : result.data.noise.variance == VarianceFunction::proportional;
      EXPECT_FALSE(opposite && choice_margin(result.data.noise) > 4.0);
      EXPECT_GE(choice_margin(result.data.noise), 0.0);
    }
    EXPECT_GE(right, function == VarianceFunction::capture ? 7 : 2) << to_string(function);
  }
}

TEST(Noise, TheChoiceIsReportedWithItsMargin) {
  Dataset data = design(12);
  RandomStream random(23, RandomPurpose::coverage, 0);
  for (ImpactPoint& point : data.points) point.restitution += 0.02 * random.normal();
  const FitResult result = fit_to(data);
  ASSERT_TRUE(result.usable);
  EXPECT_NE(result.noise_text.find("chosen before"), std::string::npos) << result.noise_text;
  EXPECT_NE(result.noise_text.find("for every impact"), std::string::npos);
  NoiseSpec asked;
  asked.variance = VarianceFunction::constant;
  EXPECT_NE(fit_to(data, asked).noise_text.find("(constant, as asked for)"), std::string::npos);
}

TEST(Noise, StatedDeviationsAreUsedOnlyWhenAllStateThem) {
  Dataset data = design(6);
  for (ImpactPoint& point : data.points) point.restitution_sd = 0.01;
  EXPECT_TRUE(gather({data}).sd_stated);
  NoiseSpec constant;
  constant.variance = VarianceFunction::constant;
  EXPECT_FALSE(gather({data}, constant).sd_stated);
  data.points[2].restitution_sd.reset();
  const Observations mixed = gather({data});
  EXPECT_FALSE(mixed.sd_stated);
  EXPECT_NE(mixed.warnings.front().find("5 points state"), std::string::npos);
  NoiseSpec stated;
  stated.variance = VarianceFunction::stated;
  EXPECT_THROW(gather({data}, stated), InputError);
}

/// Mean relative errors of C_H and C_A and of chi2 / dof over data sets with errors in velocity.
struct Summary {
  double theta[2] = {0.0, 0.0};
  double scatter[2] = {0.0, 0.0};
  double reduced = 0.0;
};

Summary with_velocity_errors(bool accounted_for, bool rebound_measured) {
  constexpr int sets = 80;
  constexpr double relative = 0.03;
  const Dataset clean = design(20);
  Summary summary;
  for (std::uint64_t k = 0; k < sets; ++k) {
    Dataset data = clean;
    if (rebound_measured) data.columns.push_back({"rebound_velocity", "m/s"});
    RandomStream random(24, RandomPurpose::coverage, k);
    for (ImpactPoint& point : data.points) {
      const double actual = point.incident_velocity;
      point.velocity_sd = relative * actual;
      point.incident_velocity += *point.velocity_sd * random.normal();
      if (rebound_measured) point.restitution *= actual / point.incident_velocity;
      point.restitution += 0.01 * random.normal();
      point.restitution_sd = 0.01;
    }
    NoiseSpec spec;
    spec.velocity_errors = accounted_for;
    const FitResult result = fit_to(data, spec);
    if (!result.usable) {
      ADD_FAILURE() << result.failure;
      continue;
    }
    const double expected[2] = {3e-3, 0.03};
    for (std::size_t j = 0; j < 2; ++j) {
      const double error = result.theta[j] / expected[j] - 1.0;
      summary.theta[j] += error / sets;
      summary.scatter[j] += error * error / sets;
    }
    summary.reduced += result.chi2 / result.dof / sets;
  }
  for (std::size_t j = 0; j < 2; ++j) {
    summary.scatter[j] = std::sqrt(summary.scatter[j] - std::pow(summary.theta[j], 2));
  }
  return summary;
}

TEST(Noise, EffectiveVarianceExplainsErrorsOfVelocity) {
  for (const bool rebound_measured : {false, true}) {
    const Summary with = with_velocity_errors(true, rebound_measured);
    const Summary without = with_velocity_errors(false, rebound_measured);
    EXPECT_NEAR(with.reduced, 1.0, 0.12) << rebound_measured;  // 3 sqrt(2 / 18 / 80)
    EXPECT_GT(without.reduced, 1.35) << rebound_measured;
    // First order: what is left over is below a third of the scatter of one data set.
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_LT(std::abs(with.theta[j]), 0.33 * with.scatter[j]) << rebound_measured << j;
      EXPECT_LT(with.scatter[j], 1.02 * without.scatter[j]) << rebound_measured << j;
    }
  }
}

TEST(Noise, EffectiveVarianceIsTheSlopeTimesTheError) {
  // Far from capture sd(e) = |de/dV| sd_V, from the reconstruction's simulator.
  Dataset data = design(8);
  for (ImpactPoint& point : data.points) {
    point.restitution_sd = 0.01;
    point.velocity_sd = 0.02 * point.incident_velocity;
    point.diameter_sd = 0.04 * point.diameter;
  }
  const FitResult result = fit_to(data);
  ASSERT_TRUE(result.usable);
  for (const std::size_t i : {std::size_t{1}, std::size_t{4}, std::size_t{7}}) {
    const Observation& point = result.data.points[i];
    const auto square = [&](double v, double d) {
      const double e = true_restitution(truth(), d * point.diameter, v * point.velocity);
      return e * e;
    };
    const double in_velocity = 0.5 * (square(1.02, 1.0) - square(0.98, 1.0));
    const double in_diameter = 0.5 * (square(1.0, 1.04) - square(1.0, 0.96));
    EXPECT_NEAR(point.input_sd / std::hypot(in_velocity, in_diameter), 1.0, 2e-2) << i;
  }
}

TEST(Noise, ErrorsTooLargeForAFirstOrderAreWarnedOf) {
  Dataset data = design(10);
  for (ImpactPoint& point : data.points) {
    point.restitution_sd = 1e-4;
    point.velocity_sd = 0.12 * point.incident_velocity;
  }
  const FitResult result = fit_to(data);
  ASSERT_TRUE(result.usable);
  bool warned = false;
  for (const std::string& line : result.warnings) {
    warned = warned || line.find("effective variance") != std::string::npos;
  }
  EXPECT_TRUE(warned);
  EXPECT_FALSE(std::isnan(result.chi2));
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
    EXPECT_NE(b.noise_text.find("Student's t with 4"), std::string::npos);
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
    log_scale += std::log(estimated.data.noise.scale / 0.02) / sets;
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
  point.restitution = 0.7;
  point.sd = 0.02;
  point.input_sd = 0.03;
  double mean = 0.0;
  double square = 0.0;
  constexpr int draws = 4000;
  for (int i = 0; i < draws; ++i) {
    RandomStream random(27, RandomPurpose::bootstrap, static_cast<std::uint64_t>(i));
    const double e = simulate_observation(point, 0.64, 1.0, random).restitution;
    mean += (e - 0.8) / draws;
    square += (e - 0.8) * (e - 0.8) / draws;
  }
  const double sd = std::hypot(0.02, 0.03 / 1.6);  // sd(e) = sd(e^2) / 2 e
  EXPECT_NEAR(mean, 0.0, 4.0 * sd / std::sqrt(draws) + 0.03 * 0.03 / (8.0 * 0.512));
  EXPECT_NEAR(std::sqrt(square) / sd, 1.0, 0.05);
  point.censored = true;
  RandomStream random(27, RandomPurpose::bootstrap, 0);
  EXPECT_TRUE(simulate_observation(point, -0.1, 1.0, random).censored);
}

TEST(Noise, SettlingASecondTimeChangesNothing) {
  Dataset data = design(14);
  RandomStream random(28, RandomPurpose::coverage, 0);
  for (ImpactPoint& point : data.points) {
    point.restitution += 0.03 * random.normal();
    point.velocity_sd = 0.02 * point.incident_velocity;
  }
  const FitResult first = fit_to(data);
  ASSERT_TRUE(first.usable);
  const Settled again = settle(first.model, first.data, first.theta, {});
  ASSERT_TRUE(again.run.converged);
  EXPECT_EQ(again.data.noise.variance, first.data.noise.variance);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_NEAR(again.run.theta[j], first.theta[j], 5e-3 * first.std_error[j]);
  }
}

}  // namespace
}  // namespace recoil
