// The two sentences and the keys about pairs of points, against numbers worked out by hand.
#include "report/pair_words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "example_analysis.hpp"
#include "report/json_report.hpp"

namespace recoil {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<std::string> sentences(const Analysis& analysis, const PairStudy& study) {
  return plain_texts(pair_words(analysis, study));
}

TEST(PairWords, SayWhatThePapersPairCosts) {
  const Analysis analysis = sample::four_diameters();
  PairStudy study = analysis.uncertainty.pairs[0];
  PairQuality& paper = study.pairs[study.paper];
  paper.C_H = {1.25 * study.truth_C_H, 3e-4};  // the full fit's spread is 2e-4
  paper.C_A = {0.8 * study.truth_C_A, 9e-3};   // and 2e-3
  paper.ended = {150, 25, 25, 0, 0};
  paper.held_out = {0.041, 0.052};
  const std::vector<std::string> words = sentences(analysis, study);
  ASSERT_EQ(words.size(), 2U);
  EXPECT_THAT(words[0], HasSubstr("C_H off by +25 % with 1.5 times the spread of the full fit"));
  EXPECT_THAT(words[0], HasSubstr("C_A off by -20 % with 4.5 times the spread of the full fit"));
  EXPECT_THAT(words[0], HasSubstr("no answer in 25 %"));
  EXPECT_THAT(words[0],
              HasSubstr("by 0.041 at the other points of this diameter (full fit: 0.031)"));
  EXPECT_THAT(words[0], HasSubstr("0.052 at the other diameters (full fit: 0.033)"));
  paper.C_A.median = study.truth_C_A * 0.996;
  EXPECT_THAT(sentences(analysis, study)[0], HasSubstr("C_A off by less than 1 %"));
}

TEST(PairWords, CountThePairsAndNameTheBest) {
  const Analysis analysis = sample::four_diameters();
  const PairStudy& study = analysis.uncertainty.pairs[0];
  // Without an answer: int(16 w) of 199 with w = 1, 1.5, 2, ...: only w = 1 stays below a tenth.
  const std::string words = sentences(analysis, study)[1];
  EXPECT_THAT(words, HasSubstr("Of the 12 choices of two points"));
  EXPECT_THAT(words, HasSubstr("11 leave more than a tenth"));
  EXPECT_THAT(words, HasSubstr("C_A scatters 2.5 to 2.5 times as much"));
  EXPECT_THAT(words, Not(HasSubstr("were tried")));
  PairStudy thinned = study;
  thinned.points = 40;
  EXPECT_THAT(sentences(analysis, thinned)[1], HasSubstr("8 of the 40 points were tried"));
}

TEST(PairWords, SurviveAPairWithoutAnyAnswerAndAFitAtItsBound) {
  const Analysis analysis = sample::four_diameters();
  PairStudy study = analysis.uncertainty.pairs[0];
  study.truth_C_H = 0.0;
  study.C_H.spread = 0.0;
  const PairFigures figures = figures_of(study, study.pairs[0]);
  EXPECT_FALSE(figures.bias_C_H.has_value());
  EXPECT_FALSE(figures.spread_C_H.has_value());
  EXPECT_TRUE(figures.bias_C_A.has_value());
  EXPECT_THAT(sentences(analysis, study)[0], HasSubstr("unknown bias"));
  for (PairQuality& pair : study.pairs) {
    pair.C_H = pair.C_A = {};
    pair.held_out = {};
    pair.ended = {0, 100, 99, 0, 0};
  }
  const std::vector<std::string> words = sentences(analysis, study);
  EXPECT_THAT(words[0], HasSubstr("give no answer in 100 %"));
  EXPECT_THAT(words[1], HasSubstr("12 leave"));
  for (const std::string& sentence : words) EXPECT_THAT(sentence, Not(HasSubstr("nan")));
}

TEST(PairKeys, StandBesideTheTwoPointComparison) {
  const Analysis analysis = sample::two_datasets();
  const auto fit = nlohmann::json::parse(json_report(analysis));
  for (const char* id : {"example-molybdenum", "example-silicon"}) {
    const auto& two = fit["two_point_by_dataset"][id];
    ASSERT_EQ(two["pairs"].size(), 12U);
    EXPECT_EQ(two["pairs_study"]["simulations"], 199);
    EXPECT_EQ(two["pairs_study"]["text"].size(), 2U);
    EXPECT_EQ(two["pairs_study"]["full"]["held_out_rmse"]["series"], 0.031);
  }
  const auto& pair = fit["two_point"]["pairs"][2];  // worse = 1
  EXPECT_EQ(pair["low_velocity"], analysis.fitted.data.points[16].velocity);
  EXPECT_EQ(pair["high_velocity"], analysis.fitted.data.points[23].velocity);
  EXPECT_NEAR(pair["bias_C_H"].get<double>(), 0.0, 1e-12);
  EXPECT_NEAR(pair["bias_C_A"].get<double>(), -0.04, 1e-12);
  EXPECT_EQ(pair["spread_C_A"], 5e-3);
  EXPECT_NEAR(pair["without_answer"].get<double>(), 16.0 / 199.0, 1e-12);
  EXPECT_EQ(pair["ended"]["converged"], 183);
  EXPECT_EQ(pair["ended"]["no_hertz_damping"], 16);
  EXPECT_EQ(pair["held_out_rmse"]["diameters"], 0.036);
  EXPECT_TRUE(pair["measured"]["held_out_rmse"]["diameters"].is_null());
  EXPECT_TRUE(fit["two_point"]["pairs"][9]["bias_C_A"].is_null());
}

TEST(PairKeys, AreEmptyWithAReasonWhenThereWasNoStudy) {
  Analysis analysis = sample::four_diameters();
  analysis.uncertainty.pairs.clear();
  const auto fit = nlohmann::json::parse(json_report(analysis));
  EXPECT_TRUE(fit["two_point"]["pairs"].empty());
  EXPECT_TRUE(fit["two_point"]["pairs_study"].is_null());
  EXPECT_FALSE(fit["two_point"]["pairs_why"].get<std::string>().empty());
}

}  // namespace
}  // namespace recoil
