// What the verdict on the model does where the laws are exact and the material constants are drawn
// from their stated errors, in data sets of the independent simulator.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "estimate/law_average.hpp"
#include "estimate/model_verdict.hpp"
#include "validation/studies/bent_truth.hpp"

namespace recoil {
namespace {

constexpr std::uint64_t seed = 4711;

std::vector<LawDesign> designs() {
  std::vector<LawDesign> all = law_designs(std::filesystem::path(RECOIL_SOURCE_DIR) / "fits");
  std::erase_if(all, [](const LawDesign& design) {
    return design.name != "wall1990-molybdenum" && design.name != "dahneke1975-quartz" &&
           design.name != "polystyrene-silica";
  });
  return all;
}

CoverageTruth exact_truth(const LawDesign& design) {
  BentTruth bent;
  bent.C_H = design.C_H;
  bent.C_A = design.C_A;
  return bent_truth(design.spec, design.datasets, bent, seed);
}

/// The fit to simulated data set `index`, with the errors of the materials as `materials` says. It
/// starts at the values of the fit file alone: other starts could only find a smaller sum of
/// squares.
FitResult fit_of(const LawDesign& design, const CoverageTruth& truth, std::uint64_t index,
                 Materials materials) {
  FitSpec spec = design.spec;
  spec.uncertainty.materials = materials;
  const std::vector<Dataset> datasets = truth.simulate(index);
  FitOptions options;
  options.several_starts = false;
  return fit_as_stated(spec, make_model(spec, datasets), gather(datasets, spec), options);
}

/// The largest distance between the distribution of `values` and the uniform one.
double distance_from_uniform(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double most = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto rank = static_cast<double>(k);
    most = std::max({most, values[k] - rank / n, (rank + 1.0) / n - values[k]});
  }
  return most;
}

TEST(VerdictRates, PIsUniformWhereTheModelIsTrue) {
  constexpr std::uint64_t sets = 100;  // 500 pass, too, in five minutes
  // Kolmogorov's distribution: exceeded by chance in 1 % (Massey 1951, J. Am. Stat. Assoc. 46, 68).
  const double critical = 1.628 / std::sqrt(static_cast<double>(sets));
  ASSERT_EQ(designs().size(), 3U);
  for (const LawDesign& design : designs()) {
    const CoverageTruth truth = exact_truth(design);
    std::vector<double> values;
    for (std::uint64_t index = 0; index < sets; ++index) {
      const FitResult fitted = fit_of(design, truth, index, Materials::adjusted);
      ASSERT_TRUE(fitted.usable);
      values.push_back(judge_model(fitted).p_value.value());
    }
    EXPECT_LT(distance_from_uniform(values), critical) << design.name;
  }
}

// At most one in twenty by the rule of `seen`; 14 of 120 have a probability of 0.2 %.
TEST(VerdictRates, NoErrorOfExactLawsIsSeen) {
  int seen = 0;
  for (const LawDesign& design : designs()) {
    const CoverageTruth truth = exact_truth(design);
    for (std::uint64_t index = 0; index < 40; ++index) {
      const FitResult fitted = fit_of(design, truth, index, Materials::averaged);
      const std::optional<LawErrorEstimate> laws = law_error_of(fitted, 0.95);
      ASSERT_TRUE(laws) << design.name;
      if (laws->seen()) ++seen;
    }
  }
  RecordProperty("seen", seen);
  EXPECT_LT(seen, 14);
}

}  // namespace
}  // namespace recoil
