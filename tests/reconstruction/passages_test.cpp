// The events behind a reconstruction: what is in them, and that the pairing finds it.
#include "experiment/passages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/error.hpp"
#include "experiment/averages.hpp"
#include "experiment/pairing.hpp"
#include "validation/recipe/recipe.hpp"

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
  double n = 0.0;
  for (const PointMean& point : averages.points) {
    if (!(point.restitution_sd > 0.0)) continue;  // a single impact
    ++n;
    const double truth = true_restitution(recipe.truth, point.diameter, point.velocity);
    squares += std::pow((point.restitution - truth) / point.restitution_sd, 2);
  }
  EXPECT_GT(n, 30.0);
  EXPECT_NEAR(squares / n, 1.0, 5.0 * std::sqrt(2.0 / n));
}

TEST(Passages, TheAngleSelectsByRestitution) {
  // A sphere without spin leaves rolling: v_t' = (5/7) v_t, so that tan(out) = (5/7) tan(in) / e.
  // From 0.05 rad it is beyond 8 degrees where e < (5/7) 0.0500417 / 0.1405408 = 0.254330.
  Recipe recipe = steel("li1999-sst65-silicon");
  recipe.noise.relative = 0.0;
  PassageDesign& design = *recipe.passages;
  design.velocity_sd = design.diameter_sd = design.volume_sd = 0.0;
  design.seen = 1.0;
  design.return_time = 1e-9;  // nothing comes back
  design.rate = 0.01;         // and no two are in the air
  const PassageTable table = read(draw_passages(recipe, 3, 20));
  const double fall = 2.0 * 9.80665 * recipe.sizes->probe_height;
  const double limit = std::tan(8.0 * M_PI / 180.0);
  std::size_t rebounds = 0;
  std::size_t beyond = 0;
  double square = 0.0;
  for (std::size_t i = 0; i + 1 < table.passages.size(); ++i) {
    const Passage& down = table.passages[i];
    const Passage& up = table.passages[i + 1];
    if (!(down.velocity > 0.0 && up.velocity < 0.0)) continue;
    const double in = std::sqrt(down.velocity * down.velocity + fall);
    const double out = std::sqrt(up.velocity * up.velocity + fall);
    EXPECT_NEAR(up.tangential, 5.0 / 7.0 * down.tangential, 1e-5);
    const double e = out / in;
    const bool left_out = std::abs(up.tangential) / out > limit;
    const double tan_in = std::abs(down.tangential) / in;
    const double margin = 0.254330 * tan_in / 0.0500417 / e;  // above 1: beyond 8 degrees
    if (std::abs(margin - 1.0) > 1e-3) {
      EXPECT_EQ(left_out, margin > 1.0) << e << " " << tan_in;
    }
    ++rebounds;
    beyond += left_out ? 1 : 0;
    square += std::pow(std::atan(tan_in) / 0.05, 2);
  }
  EXPECT_GT(rebounds, 10000U);
  EXPECT_GT(beyond, 20U);
  EXPECT_NEAR(square / static_cast<double>(rebounds), 1.0, 0.06);
}

TEST(Passages, ARecipeWithoutThemSaysSo) {
  EXPECT_THROW(draw_passages(steel("dahneke1975-quartz"), 1), InputError);
}

}  // namespace
