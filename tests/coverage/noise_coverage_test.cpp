// Errors that a table states in another way than they are: one error of the size of a batch in
// every row, and standard deviations computed from a handful of impacts. The truth comes from the
// simulator of the reconstructions.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "coverage/coverage.hpp"
#include "support/synthetic.hpp"

namespace recoil {
namespace {

constexpr double nominal = 4.9e-6;
constexpr double C_H = 2.5e-3, C_A = 0.05;

Truth truth() {
  synthetic::Design design;
  design.C_H = C_H;
  design.C_A = C_A;
  return synthetic::truth_of(design);
}

double curve(double diameter, double velocity) {
  return true_restitution(truth(), diameter, velocity);
}

using Measure = std::function<Dataset(double capture, std::mt19937& random)>;

CoverageResult coverage_of(const Measure& measure, int datasets) {
  CoverageTruth known;
  known.theta = {C_H, C_A, 8.9};
  known.capture = {{nominal, true_capture_velocity(truth(), nominal)}};
  const double capture = known.capture.front().velocity;
  known.simulate = [&measure, capture](std::uint64_t index) {
    std::mt19937 random(static_cast<unsigned>(index) + 1);
    return std::vector<Dataset>{measure(capture, random)};
  };
  CoverageOptions options;
  options.datasets = datasets;
  options.uncertainty.replicates = 0;
  return measure_coverage(synthetic::spec(), known, options);
}

void expect_held(const CoverageResult& result, std::size_t row, double least) {
  for (const CoverageCell& cell : result.rows.at(row).cells) {
    if (cell.interval != "recommended") continue;
    std::printf("%s: %d of %d\n", result.rows[row].parameter.c_str(), cell.held, cell.offered);
    EXPECT_GE(cell.held, least * cell.offered) << result.rows[row].parameter;
  }
}

Dataset empty_table() {
  Dataset data = synthetic::dataset({});
  data.points.clear();
  data.series = {"a"};
  return data;
}

ImpactPoint point_at(double velocity) {
  ImpactPoint point;
  point.diameter = nominal;
  point.incident_velocity = velocity;
  return point;
}

/// The mean diameter of a batch is wrong by 3 %, which every row states: 90 % of 60 intervals have
/// a binomial standard deviation of 4 % if 95 % hold; taken as independent, 57 % of those of V*
/// held.
TEST(NoiseCoverage, ABatchHasOneErrorOfItsSize) {
  const CoverageResult result = coverage_of(
      [](double capture, std::mt19937& random) {
        std::normal_distribution<double> normal;
        std::uniform_real_distribution<double> jitter(0.95, 1.05);
        const double diameter = nominal * std::exp(0.03 * normal(random));
        Dataset data = empty_table();
        for (int k = 0; k < 15; ++k) {
          ImpactPoint point = point_at(1.15 * capture * std::pow(25.0, k / 14.0) * jitter(random));
          point.restitution = curve(diameter, point.incident_velocity) + 0.01 * normal(random);
          point.restitution_sd = 0.01;
          point.diameter_sd = 0.03 * nominal;
          data.points.push_back(point);
        }
        return data;
      },
      60);
  for (std::size_t row = 0; row < 3; ++row) expect_held(result, row, 0.9);
}

/// Means of 3 to 6 impacts, whose scatter and mean give `restitution_sd`. The capture velocity
/// differs by 3 % from impact to impact, so that e scatters more close to capture.
TEST(NoiseCoverage, DeviationsOfFewImpactsAreUncertain) {
  const CoverageResult result = coverage_of(
      [](double capture, std::mt19937& random) {
        std::normal_distribution<double> normal;
        std::uniform_int_distribution<int> impacts(3, 6);
        Dataset data = empty_table();
        for (int k = 0; k < 16; ++k) {
          ImpactPoint point = point_at(1.2 * capture * std::pow(24.0, k / 15.0));
          point.events = impacts(random);
          double sum = 0.0, square = 0.0;
          for (int i = 0; i < point.events; ++i) {
            const double v = point.incident_velocity * std::exp(0.03 * normal(random));
            const double e = curve(nominal, v) + 0.02 * normal(random);
            sum += e;
            square += e * e;
          }
          const double n = point.events;
          point.restitution = sum / n;
          point.restitution_sd = std::sqrt((square - sum * sum / n) / (n - 1.0) / n);
          data.points.push_back(point);
        }
        return data;
      },
      60);
  for (std::size_t row = 0; row < 3; ++row) expect_held(result, row, 0.9);
}

}  // namespace
}  // namespace recoil
