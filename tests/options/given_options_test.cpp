// What was given to a command or to a function of Python, by the names of the table.
#include "options/given_options.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/error.hpp"
#include "options/option_requests.hpp"

namespace recoil {
namespace {

TEST(GivenOptions, HaveTheDefaultsOfTheTable) {
  const GivenOptions pair("pair");
  EXPECT_DOUBLE_EQ(pair.number("--height"), 1e-3);  // 1 mm
  EXPECT_EQ(pair.whole("--per-bin"), 40);
  EXPECT_EQ(pair.text("--positive"), "towards");
  EXPECT_EQ(pair.number_if_any("--angle"), std::nullopt);
  EXPECT_FALSE(pair.has("--height"));
  EXPECT_FALSE(pair.has("--keep-later"));
  EXPECT_THROW(pair.text("--colour"), std::logic_error);
  EXPECT_FALSE(pair.takes("--colour"));
}

TEST(GivenOptions, AreReadInSi) {
  GivenOptions pair("pair");
  pair.set("--height", {"0.12 cm"});
  pair.set("--angle", {"90"});
  pair.set("--size-edges", {"20", "0.04mm"});
  EXPECT_DOUBLE_EQ(pair.number("--height"), 1.2e-3);
  EXPECT_DOUBLE_EQ(*pair.number_if_any("--angle"), 1.5707963267948966);
  ASSERT_EQ(pair.numbers("--size-edges").size(), 2U);
  EXPECT_DOUBLE_EQ(pair.numbers("--size-edges")[1], 4e-5);
}

TEST(GivenOptions, AreTheWordsThatStateThem) {
  GivenOptions fit("fit");
  fit.set("FIT", {"my.toml"});
  fit.set("--seed", {"010"});
  fit.set("--json", {});
  fit.set("--out", {"there"});
  EXPECT_EQ(fit.words({"--out"}),
            (std::vector<std::string>{"fit", "my.toml", "--seed", "010", "--json"}));
  EXPECT_EQ(seed_of(fit, FitSpec()), 10U);
}

TEST(GivenOptions, OfPythonHaveItsNames) {
  const auto pair = GivenOptions::of_python(
      "pair", {{"height", {"2"}}, {"keep_later", {"True"}}, {"mean_diameter", {"False"}}});
  EXPECT_DOUBLE_EQ(pair.number("--height"), 2e-3);
  EXPECT_TRUE(pair.has("--keep-later"));
  EXPECT_FALSE(pair.has("--mean-diameter"));
  for (const auto& [name, value] : std::vector<std::pair<std::string, std::string>>{
           {"height", "0"}, {"keep_later", "1"}, {"positive", "up"}, {"per_bin", "2.5"}}) {
    try {
      GivenOptions::of_python("pair", {{name, {value}}});
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      EXPECT_EQ(error.problem(), name + " is '" + value + "'");
    }
  }
}

TEST(GivenOptions, ARangeOfOneKeepsTheHeight) {
  GivenOptions pair("pair");
  EXPECT_TRUE(pair_request("e.csv", pair).pairing.refine);
  pair.set("--height-range", {"1"});
  EXPECT_FALSE(pair_request("e.csv", pair).pairing.refine);
}

}  // namespace
}  // namespace recoil
