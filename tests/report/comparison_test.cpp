// Comparison of fits by their fit.json.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "report/comparison_report.hpp"
#include "report/result_json.hpp"

namespace recoil {
namespace {

using testing::ElementsAre;

/// A fit.json with the keys that a comparison reads.
std::string fit_json(const std::string& id, const std::string& adhesion, double chi2,
                     const std::string& C_A, const std::string& capture,
                     const std::string& sha = "abc") {
  return R"({"format_version": 2, "fit": {"id": ")" + id + R"("}, "options": {"adhesion": ")" +
         adhesion + R"(", "mechanisms": []}, "datasets": [{"id": "d", "sha256": ")" + sha +
         R"(", "points": 20}], "goodness": {"chi2": )" + std::to_string(chi2) +
         R"(, "minus_two_log_likelihood": )" + std::to_string(chi2) +
         R"(, "rmse": 0.02}, "full": {"held_out_rmse": 0.03}, "parameters": {
           "C_H": {"unit": "s/m", "free": true, "value": 0.003, "intervals": {"wald": [0.002, 0.004]},
                   "recommended": {"interval": "wald"}},
           "C_A": {"unit": "s/m", "free": true, "value": 0.05, "intervals": {"wald": )" +
         C_A + R"(}, "recommended": {"interval": "wald"}}},
           "derived": {"capture_velocity": [{"dataset": "d", "diameter_um": 4.9, "value": 1.0,
                                             "interval": )" +
         capture + "}]}}";
}

TEST(Comparison, SaysWhatDependsOnTheChoice) {
  const std::vector<ComparedFit> fits = {
      compared_fit("a", fit_json("a", "ring", 18.0, "[0.04, 0.06]", "[0.9, 1.1]")),
      compared_fit("b", fit_json("b", "jkr", 25.0, "[0.07, 0.08]", "[1.0, 1.3]"))};
  const ChoiceDependence found = choice_dependence(fits);
  EXPECT_THAT(found.depends, ElementsAre("C_A"));
  EXPECT_THAT(found.holds, ElementsAre("C_H", "V* at 4.9 um"));
  // k = 2, n = 20: 18 + 4 + 12 / 17.
  EXPECT_NEAR(fits[0].aicc().value(), 22.0 + 12.0 / 17.0, 1e-9);
  EXPECT_EQ(fits[1].adhesion, "jkr");
  EXPECT_EQ(comparison_sections(fits).size(), 2U);
}

TEST(Comparison, ThreeFitsDependWhereAnyTwoAreApart) {
  const std::vector<ComparedFit> fits = {
      compared_fit("a", fit_json("a", "ring", 18.0, "[0.04, 0.06]", "[0.9, 1.1]")),
      compared_fit("b", fit_json("b", "jkr", 25.0, "[0.05, 0.08]", "[1.0, 1.3]")),
      compared_fit("c", fit_json("c", "dmt", 25.0, "[0.07, 0.09]", "null"))};
  EXPECT_THAT(choice_dependence(fits).depends, ElementsAre("C_A"));
  EXPECT_THAT(choice_dependence(fits).holds, ElementsAre("C_H", "V* at 4.9 um"));
}

TEST(Comparison, FitsOfOneNameAreNumbered) {
  const std::string text = fit_json("fit", "ring", 18.0, "[0.04, 0.06]", "[0.9, 1.1]");
  const std::string other = fit_json("other", "ring", 18.0, "[0.04, 0.06]", "[0.9, 1.1]");
  const auto fits =
      told_apart({compared_fit("a", text), compared_fit("b", other), compared_fit("c", text)});
  EXPECT_EQ(fits[0].id, "fit (1)");
  EXPECT_EQ(fits[1].id, "other");
  EXPECT_EQ(fits[2].id, "fit (2)");
}

TEST(Comparison, RefusesOtherDataAndWhatIsNoFit) {
  const std::vector<ComparedFit> fits = {
      compared_fit("a", fit_json("a", "ring", 18.0, "[0.04, 0.06]", "[0.9, 1.1]")),
      compared_fit("b", fit_json("b", "jkr", 25.0, "[0.07, 0.08]", "[1.0, 1.3]", "other"))};
  EXPECT_THROW(comparison_sections(fits), InputError);
  EXPECT_THROW(compared_fit("x.json", "{"), InputError);
  EXPECT_THROW(compared_fit("x.json", R"({"verdict": "adequate"})"), InputError);
  EXPECT_THROW(compared_fit("x.json", R"({"format_version": 2, "parameters": {}})"), InputError);
}

TEST(Comparison, ShowsTheErrorOfTheLaws) {
  std::string text = fit_json("a", "ring", 18.0, "[0.04, 0.06]", "[0.9, 1.1]");
  std::string seen = text;
  seen.insert(1,
              R"("model_verdict": {"law_error": {"seen": true, "probability_of_exact_laws": 0.001,
      "median": 0.021, "lower": 0.012, "upper": 0.038}}, )");
  const std::vector<ComparedFit> fits = {compared_fit("a", text), compared_fit("b", seen)};
  const std::vector<Section> sections = comparison_sections(fits);
  const auto& table = std::get<Table>(sections.front().blocks.front().content());
  EXPECT_EQ(plain_text(table.columns.back().heading), "error of the laws");
  EXPECT_EQ(plain_text(std::get<Sentence>(table.rows[0].back())), "taken as exact");
  EXPECT_EQ(plain_text(std::get<Sentence>(table.rows[1].back())), "2.1 [1.2, 3.8] %");
  EXPECT_THAT(comparison_json(fits), testing::HasSubstr("0.038"));
}

TEST(Comparison, HasNoAiccWithoutALikelihood) {
  std::string text = fit_json("a", "ring", 18.0, "[0.04, 0.06]", "[0.9, 1.1]");
  const std::string key = "\"minus_two_log_likelihood\": ";
  const auto value = text.find(key) + key.size();
  text.replace(value, text.find(',', value) - value, "null");
  EXPECT_FALSE(compared_fit("a", text).aicc());
}

}  // namespace
}  // namespace recoil
