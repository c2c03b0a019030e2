// Do intervals contain truths whose materials are not quite what is stated? Every data set has a
// truth of its own, drawn from the stated errors, and is simulated by the reconstructions' code.
#include <gtest/gtest.h>

#include <cmath>

#include "coverage/coverage.hpp"
#include "support/synthetic.hpp"
#include "validation/studies/independent_coverage.hpp"

namespace recoil {
namespace {

/// Two sizes, 14 points; the modulus of the sphere to 15 %, the surface energies to 20 % each, the
/// density to 3 %: f0, which is not fitted, is uncertain by about 11 %.
Dataset uncertain_materials() {
  Dataset data = synthetic::dataset(synthetic::Design{});
  data.system.stiffness_K.reset();
  data.system.adhesion_force_f0.reset();
  data.system.particle.surface_energy = 0.0103;
  data.system.surface.surface_energy = 2.74;
  data.system.errors = {{Body::particle, Constant::density, 40.0},
                        {Body::particle, Constant::youngs_modulus, 0.18e9},
                        {Body::particle, Constant::surface_energy, 0.00206},
                        {Body::surface, Constant::surface_energy, 0.548}};
  return data;
}

/// Wilson's interval of a share (Wilson 1927, J. Am. Stat. Assoc. 22, 209-212), at 99.9 %.
struct Wilson {
  double lower, upper;
};
Wilson wilson(int held, int of) {
  const double z = 3.290527;
  const double n = of;
  const double p = held / n;
  const double middle = (p + z * z / (2.0 * n)) / (1.0 + z * z / n);
  const double half = z / (1.0 + z * z / n) * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
  return {middle - half, middle + half};
}

const CoverageCell& cell_of(const CoverageRow& row, const std::string& interval) {
  for (const CoverageCell& cell : row.cells) {
    if (cell.interval == interval) return cell;
  }
  ADD_FAILURE() << "no interval " << interval;
  return row.cells.front();
}

CoverageResult coverage_of(bool fit_knows, int datasets, int replicates) {
  const std::vector<Dataset> data = {uncertain_materials()};
  FitSpec spec = synthetic::spec();
  spec.uncertainty.materials = Materials::propagated;
  const CoverageTruth truth = independent_truth(spec, data, 20260101);
  CoverageOptions options;
  options.datasets = datasets;
  options.uncertainty.replicates = replicates;
  if (fit_knows) return measure_coverage(spec, truth, options);
  spec.uncertainty.materials = Materials::exact;
  return measure_coverage(spec, truth, options);
}

void expect_level(const CoverageRow& row, const std::string& interval, int least_offered) {
  const CoverageCell& cell = cell_of(row, interval);
  ASSERT_GE(cell.offered, least_offered) << row.parameter << ", " << interval;
  const Wilson share = wilson(cell.held, cell.offered);
  EXPECT_LE(share.lower, 0.97) << row.parameter << ", " << interval << ": " << cell.held;
  EXPECT_GE(share.upper, 0.93) << row.parameter << ", " << interval << ": " << cell.held;
  std::printf("%s, %s: %d of %d, median width %.3g %s\n", row.parameter.c_str(), interval.c_str(),
              cell.held, cell.offered, cell.median_width, row.unit.c_str());
}

TEST(MaterialsCoverage, IntervalsContainTruthsWithOtherMaterials) {
  const CoverageResult result = coverage_of(true, 400, 0);
  EXPECT_EQ(result.failed, 0);
  ASSERT_EQ(result.rows.size(), 4U);  // C_H, C_A and V* of two sizes
  for (std::size_t k = 0; k < 2; ++k) expect_level(result.rows[k], "profile", 390);
  expect_level(result.rows[0], "wald", 390);
  for (std::size_t k = 2; k < 4; ++k) expect_level(result.rows[k], "delta", 390);
}

TEST(MaterialsCoverage, TakenAsExactTheyDoNot) {
  // What the intervals were without the errors: of C_A, which takes up the error of f0, hardly half
  // of the truths.
  const CoverageResult result = coverage_of(false, 200, 0);
  const CoverageCell& C_A = cell_of(result.rows[1], "profile");
  EXPECT_LT(wilson(C_A.held, C_A.offered).upper, 0.85) << C_A.held;
  std::printf("materials exact, C_A, profile: %d of %d\n", C_A.held, C_A.offered);
}

TEST(MaterialsCoverage, TheBootstrapDrawsTheConstantsToo) {
  const CoverageResult result = coverage_of(true, 120, 99);
  EXPECT_EQ(result.failed, 0);
  for (std::size_t k = 0; k < 2; ++k) {
    const CoverageCell& cell = cell_of(result.rows[k], "percentile");
    // 99 replicates and 14 points: a little less than 95 % is what a percentile interval has.
    EXPECT_GE(wilson(cell.held, cell.offered).upper, 0.93)
        << result.rows[k].parameter << ": " << cell.held;
    std::printf("%s, percentile: %d of %d\n", result.rows[k].parameter.c_str(), cell.held,
                cell.offered);
  }
}

}  // namespace
}  // namespace recoil
