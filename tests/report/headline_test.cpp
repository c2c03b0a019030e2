#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "diagnosis/diagnosis_result.hpp"
#include "report/words_diagnosis.hpp"

namespace recoil {
namespace {

using testing::HasSubstr;

Diagnosis answered(Verdict verdict, std::vector<std::string> rivals = {}) {
  Diagnosis d;
  d.verdict = verdict;
  d.rivals = std::move(rivals);
  d.structure.tests = {{StructureQuestion::scatter, 1.0, 0.5},
                       {StructureQuestion::trend, 1.0, 0.5}};
  return d;
}

TEST(Headline, SaysWhatIsNamed) {
  Diagnosis d = answered(Verdict::cause_named);
  d.named = {"plastic_yield", "gas_film"};
  EXPECT_EQ(headline(d), "Cause of the misfit: plastic yield, gas film");
  EXPECT_EQ(headline(answered(Verdict::adequate)), "The model describes these points");
}

TEST(Headline, PraisesNoModelThatWasNotTested) {
  Diagnosis d = answered(Verdict::adequate);
  d.structure.tests.pop_back();  // the scatter alone was asked
  EXPECT_EQ(headline(d), "These points cannot test the model");
}

TEST(Headline, TellsTheCertainFromTheDoubtful) {
  Diagnosis d = answered(Verdict::not_separable, {"crack_rate", "plastic_yield", "capillary"});
  EXPECT_EQ(headline(d),
            "The model does not describe these points, for one of several possible causes: crack "
            "rate, plastic yield, capillary");
  EXPECT_EQ(headline(answered(Verdict::not_separable, {"height_origin"})),
            "The cause of the misfit may be height origin, but these data cannot decide");
  d.common = {"plastic_yield"};
  EXPECT_EQ(headline(d),
            "Cause of the misfit: plastic yield, together with crack rate or capillary");
  d.common.clear();
  d.shared_cause = "adhesion hysteresis";
  EXPECT_EQ(headline(d),
            "Cause of the misfit: adhesion hysteresis, by one of several laws (crack rate, "
            "plastic yield, capillary)");
}

TEST(Headline, StaysShortWithManyRivals) {
  const std::string text =
      headline(answered(Verdict::not_separable, {"a", "b", "c_d", "d", "e", "f", "g"}));
  EXPECT_THAT(text, HasSubstr("a, b, c d, d, e and 2 more"));
}

TEST(Headline, DoubtsTheStatedErrorsWhereTheyMayBeTheReason) {
  Diagnosis d = answered(Verdict::unexplained);
  EXPECT_EQ(headline(d), "The model has a misfit that no cause in the catalogue explains");
  d.unstated.push_back({ErrorSource::velocity_errors, 0.03, -40.0, 0.001});
  EXPECT_EQ(headline(d), "The model has a misfit that no cause in the catalogue explains");
  d.unstated.push_back({ErrorSource::larger_deviations, 1.4, -20.0, 0.4});
  EXPECT_THAT(headline(d), HasSubstr("Either the errors are larger than stated, or"));
}

TEST(RivalErrors, CountBesideACauseOnlyWhereTheyFitAsWell) {
  Diagnosis d = answered(Verdict::cause_named);
  d.unstated.push_back({ErrorSource::velocity_errors, 0.03, -40.0, 0.4});
  d.extended.emplace();
  d.extended->candidate.added = {"gas_film"};
  d.extended->delta_aicc = -50.0;
  EXPECT_TRUE(rival_errors(d).empty());
  d.extended->delta_aicc = -42.0;
  EXPECT_EQ(rival_errors(d).size(), 1U);
  d.extended->delta_aicc = -50.0;
  d.extended->candidate.added = {"gas_film", "plastic_yield"};
  EXPECT_EQ(rival_errors(d).size(), 1U) << "two causes against one number";
}

}  // namespace
}  // namespace recoil
