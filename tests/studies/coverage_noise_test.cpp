// A small version of the study of noise that is hard to know.
#include "validation/studies/coverage_noise.hpp"

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

namespace recoil {
namespace {

TEST(CoverageNoise, IntervalsHoldOrAWarningSaysWhyNot) {
  CoverageOptions options;
  options.datasets = 40;
  options.uncertainty.replicates = 0;
  options.uncertainty.seed = 11;
  // One of some fifty rows of intervals that hold in 95 % fails once in 200 runs.
  constexpr double chance = 1e-4;
  for (const NoiseDesign& design : noise_designs()) {
    for (const CoverageRow& row : measure_noise(design, options).rows) {
      const CoverageCell& recommended = row.cells.front();
      if (row.identifiable <= options.datasets / 10) continue;
      const auto missed = static_cast<unsigned>(recommended.offered - recommended.held);
      const auto offered = static_cast<unsigned>(recommended.offered);
      EXPECT_GT(missed == 0 ? 1.0 : gsl_cdf_binomial_Q(missed - 1, 0.05, offered), chance)
          << design.name << ", " << row.parameter << ": " << recommended.held << " of " << offered;
    }
  }
}

}  // namespace
}  // namespace recoil
