#include "core/error.hpp"

#include <gtest/gtest.h>

namespace recoil {
namespace {

std::string message(const Location& where, const std::string& problem, const std::string& why,
                    const std::string& suggestion) {
  return InputError(where, problem, why, suggestion).what();
}

TEST(InputError, FollowsTheGrammar) {
  EXPECT_EQ(message({"a.csv", 3, 7}, "problem", "why", "do this"),
            "a.csv:3:7: problem (why); do this");
}

TEST(InputError, LeavesOutWhatIsNotKnown) {
  EXPECT_EQ(message({"a.csv", 3, 0}, "problem", "why", ""), "a.csv:3: problem (why)");
  EXPECT_EQ(message({"a.csv"}, "problem", "", "do this"), "a.csv: problem; do this");
  EXPECT_EQ(message({}, "problem", "why", "do this"), "problem (why); do this");
  EXPECT_EQ(message({"a.csv", 0, 7}, "problem", "", ""), "a.csv: problem");
}

TEST(InputError, IsOneLineWhateverTheFileContains) {
  const std::string text = message({"a\nb.csv", 1, 1}, "x\r\ny\x1b[31m", "\t\x7f", "\v");
  for (const char c : text) {
    EXPECT_GE(static_cast<unsigned char>(c), 0x20) << text;
    EXPECT_NE(c, '\x7f') << text;
  }
}

TEST(InputError, KeepsItsParts) {
  const InputError error({"a.csv", 3, 7}, "a (b); c", "d (e)", "f; g");
  EXPECT_EQ(error.problem(), "a (b); c");
  EXPECT_EQ(error.why(), "d (e)");
  EXPECT_EQ(error.suggestion(), "f; g");
  EXPECT_EQ(error.where().file, "a.csv");
  EXPECT_EQ(error.where().line, 3);
  EXPECT_EQ(error.where().column, 7);
}

TEST(NearestWord, FindsTypingMistakes) {
  const std::vector<std::string> known = {"dataset", "model", "parameters", "uncertainty"};
  EXPECT_EQ(nearest_word("datset", known), "dataset");
  EXPECT_EQ(nearest_word("modle", known), "model");
  EXPECT_EQ(nearest_word("parameter", known), "parameters");
  EXPECT_EQ(nearest_word("model", known), "model");
}

TEST(NearestWord, CaseBlanksAndHyphensDoNotCount) {
  EXPECT_EQ(nearest_word("Fused Silica", {"fused-silica"}), "fused-silica");
  EXPECT_EQ(nearest_word("v", {"d", "V"}), "V");
  EXPECT_EQ(nearest_word("--perbin", {"--per-bin"}), "--per-bin");
}

TEST(NearestWord, StaysSilentWhenNothingIsNear) {
  EXPECT_EQ(nearest_word("xyz", {"dataset", "uncertainty"}), "");
  // Similar letters, another meaning.
  EXPECT_EQ(nearest_word("--threads", {"--spread"}), "");
  EXPECT_EQ(nearest_word("--level", {"--seed"}), "");
  EXPECT_EQ(nearest_word("silica", {"silicon"}), "");
  EXPECT_EQ(nearest_word("D", {"V", "e"}), "");
  EXPECT_EQ(nearest_word("anything", {}), "");
}

}  // namespace
}  // namespace recoil
