#include "document/sentence.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace recoil {
namespace {

TEST(Sentence, IsFilledLikeAFormatAndKnowsItsSymbols) {
  const Sentence words = say("{} points give {C_H} = {:.2f} s/m at {} {um}", 12, 0.0312, "4.90");
  const std::vector<recoil::Run> expected = {{RunKind::text, "12 points give "},
                                             {RunKind::symbol, "C_H"},
                                             {RunKind::text, " = 0.03 s/m at 4.90 "},
                                             {RunKind::unit, "um"}};
  EXPECT_EQ(words.runs(), expected);
  EXPECT_EQ(plain_text(words), "12 points give C_H = 0.03 s/m at 4.90 um");
}

TEST(Sentence, NeverLooksIntoWhatItIsFilledWith) {
  EXPECT_EQ(say("{}", "{C_H} um").runs(), Sentence("{C_H} um").runs());
  EXPECT_EQ(plain_text(say("{{{}}} {+/-} {V*}", 1)), "{1} +/- V*");
}

TEST(Sentence, AMistakeInAPatternIsTheProgrammers) {
  EXPECT_THROW(say("{} and {}", 1), std::logic_error);
  EXPECT_THROW(say("{}", 1, 2), std::logic_error);
  EXPECT_THROW(say("{a b}"), std::logic_error);
  EXPECT_THROW(say("{"), std::logic_error);
  EXPECT_THROW(say("}"), std::logic_error);
}

TEST(Sentence, ASymbolKeepsWhatItBelongsTo) {
  const Sentence of_mica = symbol("C_A[mica]");
  ASSERT_EQ(of_mica.runs().size(), 2U);
  EXPECT_EQ(of_mica.runs()[1], (recoil::Run{RunKind::qualifier, "mica"}));
  EXPECT_EQ(plain_text(of_mica), "C_A[mica]");
}

TEST(Sentence, BeginsWithACapitalAndEndsWithAFullStop) {
  EXPECT_EQ(plain_text(as_sentence("a word")), "A word.");
  EXPECT_EQ(plain_text(as_sentence("Done?")), "Done?");
  EXPECT_EQ(plain_text(as_sentence(say("{f0} grows"))), "f0 grows.");
  EXPECT_EQ(plain_text(as_sentence(say("as does {f0}"))), "As does f0.");
  EXPECT_TRUE(as_sentence(Sentence()).empty());
}

TEST(Sentence, JoinsAndSaysUnits) {
  EXPECT_EQ(plain_text(join({symbol("C_H"), "b", "c"}, ", ")), "C_H, b, c");
  EXPECT_TRUE(unit_after_number("1").empty());
  EXPECT_TRUE(unit_after_number("").empty());
  EXPECT_EQ(plain_text(unit_after_number("m/s")), " m/s");
  EXPECT_EQ(words_of("no_adhesion_damping"), "no adhesion damping");
  EXPECT_EQ(plain_text(say("{V*} ~ {d}{}", exponent("-0.83"))), "V* ~ d^-0.83");
}

}  // namespace
}  // namespace recoil
