// Mistakes in a recipe: one line with file, line and column, and what to do.
#include "validation/recipe/recipe.hpp"

#include <gtest/gtest.h>

#include <ostream>

#include "recipe_folder.hpp"
#include "support/mistake.hpp"
#include "validation/recipe/reconstruction.hpp"

namespace recoil {
namespace {

using recipes::CopiedDatasets;

struct Mistake {
  std::string name, id, from, to, says;
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class RecipeMistakes : public ::testing::TestWithParam<Mistake> {};

TEST_P(RecipeMistakes, AreOneLineWithItsPlace) {
  const Mistake& mistake = GetParam();
  const CopiedDatasets copies;
  copies.change(mistake.id + "/recipe.toml", mistake.from, mistake.to);
  const auto error = support::error_of([&] { load_recipe(copies.folder(mistake.id)); });
  ASSERT_TRUE(error) << "accepted";
  const std::string text = error->what();
  EXPECT_NE(text.find(mistake.says), std::string::npos) << text;
  EXPECT_TRUE(error->where().file.ends_with("recipe.toml")) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  EXPECT_GT(error->where().line, 0) << text;
  EXPECT_GT(error->where().column, 0) << text;
}

const std::string wall = "wall1990-mica";
const std::string ring_adhesion_made = "dahneke1975-quartz";
const std::string mixed = "li1999-sst65-silicon";

INSTANTIATE_TEST_SUITE_P(
    All, RecipeMistakes,
    ::testing::Values(
        Mistake{"unknown_key", wall, "C_A_exponent", "C_A_exponnent", "'C_A_exponent'"},
        Mistake{"extra_key", wall, "decimals = 3", "decimals = 3\nbias = 1", "unknown key 'bias'"},
        Mistake{"no_toml", wall, "seed = ", "seed = = ", "not valid TOML"},
        Mistake{"negative_seed", wall, "seed = ", "seed = -", "whole number"},
        Mistake{"text_for_number", wall, "floor = 0.01", "floor = \"0.01\"", "not a number"},
        Mistake{"nan", wall, "floor = 0.01", "floor = nan", "not a finite number"},
        Mistake{"negative", wall, "density = 1350", "density = -1350", "has to be positive"},
        Mistake{"no_noise", ring_adhesion_made, "relative = 0.02", "relative = 0",
                "standard deviation"},
        Mistake{"poisson", wall, "poisson_ratio = 0.33", "poisson_ratio = 0.8", "isotropic"},
        Mistake{"no_such_truth", wall, "\"ring-adhesion\"", "\"magic\"", "unknown truth"},
        Mistake{"no_such_phase", ring_adhesion_made, "\"rebound\"", "\"never\"", "rebound"},
        Mistake{"unknown_fact", wall, "\"capture-slope\"", "\"capture-slop\"",
                "did you mean 'capture-slope'"},
        Mistake{"repeated_fact", wall, "\"near-capture\"", "\"capture-slope\"", "twice"},
        Mistake{"fact_without_limit", wall, "velocity = 20.0, most = 0.05", "velocity = 20.0",
                "lacks the limit 'most'"},
        Mistake{"fact_with_other_limit", wall, "most = 0.05", "most = 0.05, more = 1",
                "takes no limit 'more'"},
        Mistake{"backwards", ring_adhesion_made, "from = 2.5", "from = 250.0", "above 'from'"},
        Mistake{"two_designs", ring_adhesion_made, "diameter = 1.27e-6\nvelocity",
                "diameter = 1.27e-6\ndrop_heights = [1.0]\nvelocity", "one of the two"},
        Mistake{"comma_in_name", ring_adhesion_made, "\"1.27 um\"", "\"1,27 um\"", "cell"},
        Mistake{"sizes_upside_down", mixed, "upper = 110e-6", "upper = 10e-6", "whole micrometres"},
        Mistake{"bad_angle", mixed, "angle = 0.13962634", "angle = -8", "has to be positive"},
        Mistake{"pairing_without_passages", ring_adhesion_made, "[[series]]",
                "[pairing]\nheight = 1e-3\nangle = 0.1\nper_bin = 40\n[[series]]", "passages"},
        Mistake{"bad_height", mixed, "[0.01, ", "[-0.01, ", "has to be positive"}),
    [](const auto& instance) { return instance.param.name; });

TEST(Recipe, MissingOnesAreSaid) {
  const CopiedDatasets copies;
  EXPECT_THROW(load_recipe(copies.folder("nothing")), InputError);
  std::filesystem::remove(copies.folder(wall) / "points.csv");
  EXPECT_THROW(reconstruct(copies.folder(wall), true), InputError);
  std::filesystem::remove_all(copies.folder("wall1990-silicon"));
  EXPECT_THROW(reconstruct(copies.folder(wall), false), InputError);  // a sibling of it
}

TEST(Recipe, ImpactsThatAreHardlyEverSeenAreRefused) {
  const CopiedDatasets copies;
  copies.change(mixed + "/recipe.toml", "probe_height = 1e-3", "probe_height = 1e-1");
  EXPECT_THROW(load_recipe(copies.folder(mixed)), InputError);
}

TEST(Recipe, TheFolderMayBeNamedInAnyWay) {
  const CopiedDatasets copies;
  EXPECT_EQ(load_recipe(copies.folder(wall) / "").id, wall);
  EXPECT_EQ(load_recipe(copies.folder(wall) / "." / "").id, wall);
}

}  // namespace
}  // namespace recoil
