// Every source of error alone, and every two together: what simulates data sets must scatter as the
// stated errors say. The covariance is computed here, from the curve of the truths' simulator.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "coverage/coverage_truth.hpp"
#include "diagnosis/search.hpp"
#include "support/synthetic.hpp"
#include "uncertainty/resample.hpp"

namespace recoil {
namespace {

using Sources = std::set<std::string>;

constexpr double sd = 0.004;                   // of e [1]
constexpr double relative_sd = 0.03;           // of velocities and diameters [1]
constexpr double setting_relative_sd = 0.005;  // of the velocities of a setting [1]
constexpr double setting_sd = 0.006;           // of e [1]
constexpr double diameter = 4.9e-6;            // [m]
constexpr Eigen::Index bounces = 4;            // of each of two launches
constexpr Eigen::Index points = 2 * bounces;

/// Two launches, each a series of its own, whose bounces with the same number share a setting.
Eigen::Index launch_of(Eigen::Index i) { return i / bounces; }
Eigen::Index bounce_of(Eigen::Index i) { return i % bounces; }

double true_e(double velocity, double size = diameter) {
  return true_restitution(synthetic::truth_of({}), size, velocity);
}

Dataset dataset_with(const Sources& sources) {
  synthetic::Design none;
  none.velocities.clear();
  Dataset data = synthetic::dataset(none);
  double velocity = 4.0 * true_capture_velocity(synthetic::truth_of({}), diameter);
  std::vector<ImpactPoint> launch;
  for (Eigen::Index k = 0; k < bounces; ++k) {
    ImpactPoint point;
    point.diameter = diameter;
    point.incident_velocity = velocity;
    point.restitution = true_e(velocity);
    point.restitution_sd = sd;
    point.setting = fmt::format("bounce {}", k);
    if (sources.contains("velocity_sd")) point.velocity_sd = relative_sd * velocity;
    if (sources.contains("setting_velocity_sd"))
      point.setting_velocity_sd = setting_relative_sd * velocity;
    if (sources.contains("diameter_sd")) point.diameter_sd = relative_sd * diameter;
    if (sources.contains("series_diameter_sd")) point.series_diameter_sd = relative_sd * diameter;
    launch.push_back(point);
    velocity *= point.restitution;
  }
  for (std::size_t l = 0; l < 2; ++l) {
    for (ImpactPoint point : launch) {
      point.series = l;
      if (sources.contains("launch")) point.launch = fmt::format("launch {}", l);
      data.points.push_back(point);
    }
  }
  return data;
}

FitSpec spec_with(const Sources& sources) {
  FitSpec spec = synthetic::spec();
  spec.law_error = 0.0;
  spec.noise.setting_sd = sources.contains("setting_sd") ? setting_sd : 0.0;
  return spec;
}

/// Covariance of the measured e to first order in the errors, as docs/noise.md states them.
Eigen::MatrixXd stated_covariance(const Sources& sources, const Dataset& data) {
  Eigen::VectorXd e(points), by_velocity(points), by_diameter(points);  // relative errors
  for (Eigen::Index i = 0; i < points; ++i) {
    const double v = data.points[static_cast<std::size_t>(i)].incident_velocity;
    constexpr double step = 0.01;
    e(i) = true_e(v);
    by_velocity(i) = relative_sd * (true_e(v * (1 + step)) - true_e(v * (1 - step))) / (2.0 * step);
    by_diameter(i) = relative_sd *
                     (true_e(v, diameter * (1 + step)) - true_e(v, diameter * (1 - step))) /
                     (2.0 * step);
  }
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(points, points);
  for (Eigen::Index i = 0; i < points; ++i) {
    for (Eigen::Index j = 0; j < points; ++j) {
      double& entry = covariance(i, j);
      const bool one_setting = bounce_of(i) == bounce_of(j);
      const bool one_launch = launch_of(i) == launch_of(j);
      if (i == j) {
        entry += sd * sd;
        if (sources.contains("velocity_sd")) entry += by_velocity(i) * by_velocity(i);
        if (sources.contains("diameter_sd") && sources.contains("series_diameter_sd")) {
          entry += by_diameter(i) * by_diameter(i);
        }
      } else if (sources.contains("launch") && one_launch) {
        // e_k is made of the instants k, k + 1 and k + 2, in these parts
        const auto parts = [&](Eigen::Index k) {
          Eigen::VectorXd of_instants = Eigen::VectorXd::Zero(bounces + 2);
          of_instants.segment(bounce_of(k), 3) << 1.0, -(1.0 + 1.0 / e(k)), 1.0 / e(k);
          return of_instants.normalized().eval();
        };
        entry += sd * sd * parts(i).dot(parts(j));
      }
      if (one_setting && sources.contains("setting_sd")) entry += setting_sd * setting_sd;
      if (one_setting && sources.contains("setting_velocity_sd")) {
        const double times = setting_relative_sd / relative_sd;
        entry += times * times * (relative_sd * e(i) + by_velocity(i)) *
                 (relative_sd * e(j) + by_velocity(j));
      }
      // One diameter and one error of it in all rows: a batch.
      if (sources.contains("diameter_sd") && !sources.contains("series_diameter_sd")) {
        entry += by_diameter(i) * by_diameter(j);
      }
      if (one_launch && sources.contains("series_diameter_sd")) {
        entry += by_diameter(i) * by_diameter(j);
      }
    }
  }
  return covariance;
}

/// e of every point in simulated data set `index`.
using Simulate = std::function<Eigen::VectorXd(std::uint64_t index)>;

void expect_covariance(const Simulate& simulate, const Eigen::MatrixXd& stated,
                       const std::string& who) {
  constexpr std::uint64_t sets = 3000;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(points);
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(points, points);
  for (std::uint64_t index = 0; index < sets; ++index) {
    const Eigen::VectorXd e = simulate(index);
    sum += e;
    products += e * e.transpose();
  }
  const Eigen::MatrixXd found = (products - sum * sum.transpose() / sets) / (sets - 1.0);
  for (Eigen::Index i = 0; i < points; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      const double scale = std::sqrt(stated(i, i) * stated(j, j));
      // of a covariance of normal numbers; and the curvature over 3 % of V, to second order
      const double error = std::hypot(scale, stated(i, j)) / std::sqrt(static_cast<double>(sets));
      EXPECT_NEAR(found(i, j), stated(i, j), 5.0 * error + 0.03 * scale)
          << who << ": points " << i << " and " << j;
    }
  }
}

class ErrorSources : public testing::TestWithParam<Sources> {
 protected:
  ErrorSources() : data_{dataset_with(GetParam())}, spec_(spec_with(GetParam())) {
    FitOptions one_start;
    one_start.several_starts = false;
    fitted_ = fit(make_model(spec_, data_), gather(data_, spec_), one_start);
  }

  const std::vector<Dataset> data_;
  const FitSpec spec_;
  FitResult fitted_;
};

TEST_P(ErrorSources, SimulatedSetsScatterAsTheyState) {
  ASSERT_TRUE(fitted_.usable) << fitted_.failure;
  ASSERT_EQ(fitted_.noise_scale, 1.0);
  const Eigen::MatrixXd stated = stated_covariance(GetParam(), data_.front());
  const auto vector_of = [](const auto& of_points) {
    Eigen::VectorXd e(points);
    for (Eigen::Index i = 0; i < points; ++i) {
      e(i) = of_points[static_cast<std::size_t>(i)].restitution;
    }
    return e;
  };

  const ResamplingPlan plan = plan_resampling(fitted_, Scheme::parametric);
  Observations sample = fitted_.data;
  expect_covariance(
      [&](std::uint64_t index) {
        resample(plan, 1, index, sample);
        return vector_of(sample.points);
      },
      stated, "bootstrap");

  const CoverageTruth truth = coverage_truth(fitted_, data_, 1);
  expect_covariance(
      [&](std::uint64_t index) { return vector_of(truth.simulate(index).front().points); }, stated,
      "coverage");

  const DiagnosisOptions options;
  const SearchBase base = search_base(spec_, data_, fitted_, options);
  expect_covariance(
      [&](std::uint64_t index) { return vector_of(simulate_base(base, index).data.points); },
      stated, "diagnosis");
}

std::vector<Sources> alone_and_in_pairs() {
  const std::vector<std::string> names = {"velocity_sd",         "diameter_sd",
                                          "setting_velocity_sd", "series_diameter_sd",
                                          "setting_sd",          "launch"};
  std::vector<Sources> all = {{}};
  for (const std::string& name : names) all.push_back({name});
  for (const std::string& one : names) {
    for (const std::string& other : names) {
      if (one < other) all.push_back({one, other});
    }
  }
  return all;
}

std::string name_of(const testing::TestParamInfo<Sources>& info) {
  std::string name;
  for (const std::string& source : info.param) name += (name.empty() ? "" : "_and_") + source;
  return name.empty() ? "none" : name;
}

INSTANTIATE_TEST_SUITE_P(AloneAndInPairs, ErrorSources, testing::ValuesIn(alone_and_in_pairs()),
                         name_of);

}  // namespace
}  // namespace recoil
