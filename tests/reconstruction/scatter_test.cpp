// The noise of drawn points is the noise that they state.
#include <gtest/gtest.h>

#include <cmath>

#include "recipe_folder.hpp"
#include "validation/recipe/recipe.hpp"
#include "validation/recipe/reconstruction.hpp"

namespace recoil {
namespace {

using recipes::dataset_folder;

class Scatter : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Datasets, Scatter,
                         ::testing::Values("wall1990-mica", "dahneke1975-quartz",
                                           "li1999-sst65-silicon", "li1999-sst125-silicon"),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           for (char& c : name) c = c == '-' ? '_' : c;
                           return name;
                         });

TEST_P(Scatter, RegenerationsScatterAboutTheTruthAsStated) {
  const Recipe recipe = load_recipe(dataset_folder(GetParam()));
  constexpr int replicates = 500;
  double sum = 0.0;
  double chi2 = 0.0;
  for (int k = 0; k < replicates; ++k) {
    const auto fresh = draw_points(recipe, 1000 + static_cast<std::uint64_t>(k));
    for (std::size_t i = 0; i < fresh.size(); ++i) {
      const double z =
          (fresh[i].restitution - recipe.plan[i].restitution) / fresh[i].restitution_sd;
      sum += z;
      chi2 += z * z;
    }
  }
  const double n = static_cast<double>(replicates) * static_cast<double>(recipe.plan.size());
  EXPECT_NEAR(sum / n, 0.0, 4.5 / std::sqrt(n));
  // The sampling error of chi2 / n, and 1.5 % for the rounding of e and of its standard deviation.
  EXPECT_NEAR(chi2 / n, 1.0, 4.5 * std::sqrt(2.0 / n) + 0.015);
}

TEST(Scatter, SurvivorsOfMixedSizesAverageByTheirNumber) {
  // The mean over the sizes that come back, by hand.
  const Recipe recipe = load_recipe(dataset_folder("li1999-sst65-silicon"));
  const SizeDistribution& sizes = recipe.sizes.value();
  const PlannedPoint& lowest = recipe.plan.front();
  double weight = 0.0;
  double mean = 0.0;
  for (std::size_t i = 0; i < sizes.diameters.size(); ++i) {
    const double e = true_restitution(recipe.truth, sizes.diameters[i], lowest.velocity);
    if (e * lowest.velocity <= std::sqrt(2.0 * 9.80665 * 1e-3)) continue;
    weight += sizes.weights[i];
    mean += sizes.weights[i] * e;
  }
  EXPECT_LT(weight, 0.9);
  EXPECT_NEAR(lowest.seen, weight, 1e-12);
  EXPECT_NEAR(lowest.restitution, mean / weight, 1e-12);
}

}  // namespace
}  // namespace recoil
