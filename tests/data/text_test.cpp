#include "data/text.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace recoil {
namespace {

TEST(Text, UnitsFollowNumbersButForPureNumbers) {
  EXPECT_EQ(unit_suffix("m/s"), " m/s");
  EXPECT_EQ(unit_suffix("1"), "");
  EXPECT_EQ(unit_suffix(""), "");
}

TEST(Text, OneIsSingular) {
  EXPECT_EQ(counted(0, "point"), "0 points");
  EXPECT_EQ(counted(1, "point"), "1 point");
  EXPECT_EQ(counted(2, "point"), "2 points");
  EXPECT_EQ(counted(1, "point averages", "points average"), "1 point averages");
  EXPECT_EQ(counted(2, "point averages", "points average"), "2 points average");
}

TEST(Text, NoBreakSpacesAreBlanks) {
  EXPECT_EQ(trimmed("\u00A0\t a\u00A0b \u202F\u2007\r"), "a\u00A0b");
  EXPECT_EQ(trimmed(" \u00A0 "), "");
  EXPECT_EQ(with_plain_blanks("a\u00A0b\u202Fc"), "a b c");
}

TEST(Text, ListsFewWordsWhole) {
  EXPECT_EQ(listed({}), "");
  EXPECT_EQ(listed({"V"}), "V");
  EXPECT_EQ(listed({"V", "e", "d"}), "V, e, d");
}

TEST(Text, ListsManyWordsInAReadableLength) {
  const std::vector<std::string> words(500, "velocity");
  const std::string text = listed(words);
  EXPECT_LT(text.size(), 450U);
  EXPECT_TRUE(text.starts_with("velocity, velocity, "));
  EXPECT_TRUE(text.ends_with(" more")) << text;
}

TEST(Text, ListsLongAndUnprintableWordsCut) {
  EXPECT_EQ(listed({std::string(100, 'x'), "a\tb"}), std::string(40, 'x') + "..., a b");
}

TEST(Text, DidYouMeanNamesTheNearestOrWhatThereIs) {
  EXPECT_EQ(did_you_mean("velocty", {"velocity", "diameter"}), "did you mean 'velocity'?");
  EXPECT_EQ(did_you_mean("zzzzzzzz", {"velocity", "diameter"}), "known: velocity, diameter");
  EXPECT_LT(did_you_mean("zzzzzzzz", std::vector<std::string>(9999, "aaaa")).size(), 450U);
}

}  // namespace
}  // namespace recoil
