#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>

#include "example_analysis.hpp"
#include "report/format.hpp"
#include "report/words_dataset.hpp"

namespace recoil {
namespace {

using testing::HasSubstr;

std::size_t longest_line(const std::string& text) {
  std::istringstream lines(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto characters = std::count_if(line.begin(), line.end(), [](char c) {
      return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
    });
    longest = std::max(longest, static_cast<std::size_t>(characters));
  }
  return longest;
}

TEST(TextReport, SaysWhereThePointsComeFrom) {
  const std::string text = text_report(example::four_diameters());
  EXPECT_THAT(text, HasSubstr("reconstruction"));
  // The sentence is wrapped, so it is looked for by its first words.
  const std::string sentence = provenance_sentence(Provenance::reconstruction);
  EXPECT_THAT(text, HasSubstr(sentence.substr(0, 20)));
}

TEST(TextReport, HasTheBlocksThatReadersOfLmfitExpect) {
  for (const Analysis& analysis : {example::four_diameters(), example::two_datasets()}) {
    const std::string text = text_report(analysis);
    for (const char* block :
         {"[[Provenance]]", "[[Model]]", "[[Fit Statistics]]", "[[Variables]]", "[[Correlations]]",
          "[[Capture Velocity]]", "[[Two Points Against All]]", "[[Bootstrap]]",
          "[[Identifiability]]", "[[Starts]]"}) {
      EXPECT_THAT(text, HasSubstr(block)) << analysis.spec.id;
    }
    EXPECT_LE(longest_line(text), 100U) << text;
    EXPECT_FALSE(std::regex_search(text, std::regex("\\b(nan|inf)\\b"))) << text;
  }
}

TEST(TextReport, GivesValueErrorPercentStartAndIntervalOfAVariable) {
  const std::string text = text_report(example::four_diameters());
  EXPECT_THAT(text, HasSubstr("0.00312 +/- 0.00021 s/m (6.73 %) (init = 0.003)"));
  EXPECT_THAT(text, HasSubstr("95 % interval [0.002731, 0.003561] (profile)"));
  EXPECT_THAT(text, HasSubstr("(fixed)"));
  EXPECT_THAT(text, HasSubstr("C(C_H, C_A) = -0.4300"));
}

TEST(TextReport, StaysNarrowWhateverTheWordsAre) {
  Analysis analysis = example::four_diameters();
  analysis.datasets[0].title = std::string(300, 'x') + " µµµ " + std::string(300, 'y');
  analysis.datasets[0].id =
      "a-dataset-with-a-name-that-is-far-too-long-to-stand-in-one-line-of-text";
  analysis.spec.file = "/a/path/" + std::string(150, 'p') + "/fit.toml";
  analysis.datasets[0].warnings = {std::string(250, 'w') + " and the reason why " +
                                   std::string(40, 'z')};
  analysis.fitted.model.slots[0].dataset = analysis.datasets[0].id;
  analysis.uncertainty.identifiability.text = std::string(500, 'i');
  EXPECT_LE(longest_line(text_report(analysis)), 100U) << text_report(analysis);
}

TEST(TextReport, SaysWhatIsMissingAndWhy) {
  Analysis analysis = example::two_datasets();
  analysis.fitted.at_bound[0] = true;
  analysis.fitted.std_error[0] = 0.0;
  const std::string text = text_report(analysis);
  EXPECT_THAT(text, HasSubstr("AT BOUND"));
  EXPECT_THAT(text, HasSubstr("no standard deviations are stated"));
  EXPECT_THAT(text, HasSubstr("contradiction: stiffness_K = 11.4 GPa"));
  EXPECT_THAT(text, HasSubstr("no adhesion damping"));
  EXPECT_THAT(text, HasSubstr("[[Warnings]]"));
}

TEST(TextReport, ReportsAnUnusableFitAsAFailure) {
  Analysis analysis = example::four_diameters();
  analysis.fitted = FitResult{};
  analysis.fitted.model = example::four_diameters().fitted.model;
  analysis.fitted.failure = "no start rebounds at point 3";
  analysis.uncertainty = UncertaintyResult{};
  const std::string text = text_report(analysis);
  EXPECT_THAT(text, HasSubstr("[[Failure]]"));
  EXPECT_THAT(text, HasSubstr("no start rebounds at point 3"));
}

TEST(TextReport, WithoutAdhesionThereIsNoCaptureVelocity) {
  Analysis analysis = example::four_diameters();
  ASSERT_FALSE(analysis.uncertainty.capture.empty());
  EXPECT_EQ(text_report(analysis).find("none (no adhesion)"), std::string::npos);
  analysis.fitted.model.contacts[0].adhesion_force = 0.0;
  analysis.fitted.model.slots[analysis.fitted.model.slot_f0[0]].free = false;
  const std::string text = text_report(analysis);
  EXPECT_NE(text.find("V* = none (no adhesion)"), std::string::npos) << text;
  EXPECT_EQ(text.find("V* =  "), std::string::npos);
  EXPECT_NE(html_report(analysis).find("none (no adhesion)"), std::string::npos);
  // A fitted f0 is an adhesion.
  analysis.fitted.model.slots[analysis.fitted.model.slot_f0[0]].free = true;
  EXPECT_EQ(text_report(analysis).find("none (no adhesion)"), std::string::npos);
}

}  // namespace
}  // namespace recoil
