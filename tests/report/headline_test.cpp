#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "diagnosis/diagnosis_result.hpp"
#include "document/document.hpp"
#include "report/diagnosis_report.hpp"
#include "report/words_diagnosis.hpp"

namespace recoil {
namespace {

using testing::HasSubstr;

Diagnosis answered(DiagnosisAnswer answer) {
  Diagnosis d;
  d.answer = std::move(answer);
  d.structure.tests = {{StructureQuestion::scatter, 1.0, 0.5},
                       {StructureQuestion::trend, 1.0, 0.5}};
  d.base.data.points.resize(1);
  return d;
}

NotSeparable between(std::vector<std::string> rivals) {
  NotSeparable several;
  several.rivals = std::move(rivals);
  return several;
}

CauseNamed names(std::vector<std::string> causes) {
  CauseNamed one;
  one.extended.cause.candidate.added = std::move(causes);
  return one;
}

TEST(CauseHeadline, SaysWhatIsNamed) {
  EXPECT_EQ(cause_headline(answered(names({"plastic_yield", "gas_film"}))),
            "Cause of the misfit: plastic yield, gas film");
  EXPECT_EQ(cause_headline(answered(Adequate{})), "");
}

TEST(CauseHeadline, TellsTheCertainFromTheDoubtful) {
  NotSeparable several = between({"crack_rate", "plastic_yield", "capillary"});
  EXPECT_EQ(cause_headline(answered(several)),
            "Cause of the misfit, one of several that these data cannot separate: crack rate or "
            "plastic yield or capillary");
  EXPECT_EQ(cause_headline(answered(between({"height_origin"}))),
            "Cause of the misfit may be height origin, but these data cannot decide");
  several.common = {"plastic_yield"};
  EXPECT_EQ(cause_headline(answered(several)),
            "Cause of the misfit: plastic yield, together with crack rate or capillary");
  several.common.clear();
  several.shared_cause = "adhesion hysteresis";
  EXPECT_EQ(cause_headline(answered(several)),
            "Cause of the misfit: adhesion hysteresis, by one of several laws (crack rate, "
            "plastic yield, capillary)");
}

TEST(CauseHeadline, NamesAnErrorOfTheLawsBesideItsRivals) {
  NotSeparable several = between({"crack_rate", "gas_film"});
  several.law_error = true;
  EXPECT_EQ(cause_headline(answered(several)),
            "An error of the laws, or a cause that these data cannot tell from it: crack rate or "
            "gas film");
}

TEST(CauseHeadline, StaysShortWithManyRivals) {
  const std::string text = cause_headline(answered(between({"a", "b", "c_d", "d", "e", "f", "g"})));
  EXPECT_THAT(text, HasSubstr("a or b or c d or d or e and 2 more"));
}

TEST(CauseHeadline, DoubtsTheStatedErrorsWhereTheyMayBeTheReason) {
  Diagnosis d = answered(Unexplained{});
  d.base.data.noise.sd_stated = true;
  EXPECT_EQ(cause_headline(d), "No cause in the catalogue explains the residuals");
  d.unstated.push_back({UnstatedSource::velocity_errors, 0.03, -40.0, 0.001});
  EXPECT_EQ(cause_headline(d), "No cause in the catalogue explains the residuals");
  d.unstated.push_back({UnstatedSource::larger_deviations, 1.4, -20.0, 0.4});
  EXPECT_THAT(cause_headline(d), HasSubstr("Either the errors are larger than stated, or"));
  d.base.data.noise.sd_stated = false;
  EXPECT_THAT(cause_headline(d), HasSubstr("Either points share errors, or"));
}

TEST(AnswerSentences, SpeakOfStatedErrorsOnlyWhereSomeAreStated) {
  Diagnosis d = answered(Unexplained{});
  d.structure.smooth = false;
  const auto text = [&] {
    std::string all;
    for (const std::string& sentence : answer_sentences(d)) all += sentence + " ";
    return all;
  };
  d.base.data.noise.sd_stated = true;
  EXPECT_THAT(text(), HasSubstr("scatter more than their stated standard deviations"));
  d.base.data.noise.sd_stated = false;
  EXPECT_THAT(text(), HasSubstr("No standard deviations are stated"));
  EXPECT_THAT(text(), testing::Not(HasSubstr("their stated")));
}

/// A charge that leaves no structure (p = 0.97); chance gains as much in 7 % of data sets.
CandidateResult image_charge() {
  CandidateResult charge;
  charge.candidate.added = {"electrostatic_image"};
  charge.delta_aicc = -6.0;
  charge.p_value = 0.07;
  charge.remaining_p = 0.97;
  charge.remaining_part = 0.02;
  charge.set_aside = SetAside::chance;
  return charge;
}

TEST(AnswerSentences, NeverSayNoCauseBesideOneThatLeavesNoStructure) {
  Diagnosis d = answered(Unexplained{});
  d.base.residuals = {1.0, -1.0, 1.0};  // no single point dominates
  d.base.chi2 = 3.0;
  d.structure.smooth = true;
  const auto text = [&] {
    std::string all = cause_headline(d) + ". ";
    for (const std::string& sentence : answer_sentences(d)) all += sentence + " ";
    return all;
  };
  EXPECT_THAT(text(), HasSubstr("No cause in the catalogue explains it, alone or in pairs."));
  d.candidates = {image_charge()};
  EXPECT_THAT(text(), testing::Not(HasSubstr("No cause")));
  EXPECT_THAT(text(), HasSubstr("may be electrostatic image, but chance gains as much in 7 % of"));
  EXPECT_THAT(text(), HasSubstr("leaves no structure in the residuals (p = 0.97), but is set "
                                "aside: by chance alone"));
  d.candidates.front().set_aside = SetAside::predicts_no_better;
  EXPECT_THAT(text(), testing::Not(HasSubstr("No cause in the catalogue")));
  EXPECT_THAT(text(), HasSubstr("No cause is accepted: electrostatic image"));
  // One that leaves structure is no explanation.
  d.candidates.front().remaining_p = 0.001;
  EXPECT_THAT(text(), HasSubstr("No cause in the catalogue explains it."));
}

TEST(CauseHeadline, NamesTheCauseThatUnstatedErrorsRival) {
  Diagnosis d = answered(ErrorsTooSmall{"gas_film"});
  d.unstated.push_back({UnstatedSource::larger_deviations, 1.4, -20.0, 0.4});
  EXPECT_THAT(cause_headline(d), HasSubstr(", or the cause may be gas film"));
  d.answer = Unexplained{};
  EXPECT_THAT(cause_headline(d), HasSubstr(", or the cause is not in the catalogue"));
  d.candidates = {image_charge()};
  EXPECT_THAT(cause_headline(d), HasSubstr(", or the cause may be electrostatic image"));
}

TEST(RivalErrors, CountBesideACauseOnlyWhereTheyFitAsWell) {
  Diagnosis d = answered(names({"gas_film"}));
  CandidateResult& cause = std::get<CauseNamed>(d.answer).extended.cause;
  d.unstated.push_back({UnstatedSource::velocity_errors, 0.03, -40.0, 0.4});
  cause.delta_aicc = -50.0;
  EXPECT_TRUE(rival_errors(d).empty());
  cause.delta_aicc = -42.0;
  EXPECT_EQ(rival_errors(d).size(), 1U);
  cause.delta_aicc = -50.0;
  cause.candidate.added = {"gas_film", "plastic_yield"};
  EXPECT_EQ(rival_errors(d).size(), 1U) << "two causes against one number";
}

// Two are shown; the last rows count the others, those that gain and those that do not.
TEST(ClosestCauses, CountAllThatWereTried) {
  Diagnosis d = answered(Adequate{});
  for (const double change : {3.0, -1.0, -8.0, 2.0, -4.0, -2.0, 5.0}) {
    CandidateResult tried;
    tried.candidate.added = {change == -8.0 ? "gas_film" : "plastic_yield"};
    tried.delta_aicc = change;
    tried.set_aside = SetAside::predicts_no_better;
    d.candidates.push_back(tried);
  }
  const Section shown = closest_causes(d);
  const auto& table = std::get<Table>(shown.blocks.at(0).content());
  ASSERT_EQ(table.rows.size(), 4U);
  EXPECT_EQ(plain_text(words_of_cell(table.rows[0][0])), "gas film");
  EXPECT_EQ(plain_text(words_of_cell(table.rows[2][0])), "2 more");
  EXPECT_EQ(plain_text(words_of_cell(table.rows[3][0])), "3 others");
}

}  // namespace
}  // namespace recoil
