// The events behind a reconstruction: what is in them, and that the pairing finds it.
#include "reconstruction/passages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/error.hpp"
#include "experiment/averages.hpp"
#include "experiment/pairing.hpp"
#include "experiment/passages.hpp"

namespace {

using namespace recoil;

Recipe steel(const std::string& id) {
  return load_recipe(std::filesystem::path(RECOIL_SOURCE_DIR) / "datasets" / id);
}

PassageTable read(const std::string& csv) {
  PassageFormat format;
  format.units = {
      {"time", "s"}, {"velocity", "m/s"}, {"tangential_velocity", "m/s"}, {"diameter", "um"}};
  return parse_passages(csv, "events.csv", "", format);
}

TEST(Passages, TheSeedFixesEveryDigit) {
  const Recipe recipe = steel("li1999-sst125-silicon");
  const std::string first = draw_passages(recipe, 5);
  EXPECT_EQ(first, draw_passages(recipe, 5));
  EXPECT_NE(first, draw_passages(recipe, 6));
}

TEST(Passages, AsManyReboundsAsTheRecipeAsksFor) {
  const Recipe recipe = steel("li1999-sst125-silicon");
  const PassageTable table = read(draw_passages(recipe, recipe.seed, 4));
  EXPECT_EQ(table.damaged + table.duplicated + table.unsorted, 0U);
  PairingOptions options;
  options.height = 1.2e-3;
  const PairingResult pairs = pair_passages(table.passages, options);
  std::size_t first = 0;
  for (const Impact& impact : pairs.impacts) first += impact.used ? 1 : 0;
  const double expected = 4.0 * 40.0 * 14.0;
  EXPECT_NEAR(static_cast<double>(first), expected, 5.0 * std::sqrt(expected));
  EXPECT_NEAR(pairs.height, recipe.sizes->probe_height, 5.0 * pairs.height_sd);
  EXPECT_GT(pairs.returns, 100U) << "some come back for a second impact";
}

TEST(Passages, PointsFromThemAreTheTruth) {
  const Recipe recipe = steel("li1999-sst125-silicon");
  const PassageTable table = read(draw_passages(recipe, recipe.seed, 10));
  AverageOptions by;
  by.size_edges = {60e-6, 70e-6, 80e-6, 90e-6};
  by.per_bin = 130;
  const Averages averages =
      average(table.passages, table.series, pair_passages(table.passages, {}), by);
  double squares = 0.0;
  for (const PointMean& point : averages.points) {
    const double truth = true_restitution(recipe.truth, point.diameter, point.velocity);
    squares += std::pow((point.restitution - truth) / point.restitution_sd, 2);
  }
  const auto n = static_cast<double>(averages.points.size());
  EXPECT_GT(n, 30.0);
  EXPECT_NEAR(squares / n, 1.0, 5.0 * std::sqrt(2.0 / n));
}

TEST(Passages, ARecipeWithoutThemSaysSo) {
  EXPECT_THROW(draw_passages(steel("dahneke1975-quartz"), 1), InputError);
}

}  // namespace
