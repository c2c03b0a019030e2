// What is counted of answers to hidden effects, from answers made up by hand.
#include "validation/studies/hidden_effects_tally.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "core/files.hpp"

namespace {

using namespace recoil::hidden;

Answered answer(const std::string& design, const std::vector<std::string>& effects, double strength,
                const std::string& verdict, const std::vector<std::string>& named,
                const std::vector<std::string>& rivals = {}) {
  Answered made;
  made.order = {design, effects, strength, 0, 1};
  made.reached = true;
  made.verdict = verdict;
  made.named = named;
  made.rivals = rivals;
  made.seconds = 1.0;
  return made;
}

std::vector<Answered> answers() {
  std::vector<Answered> all;
  all.push_back(answer("wall", {"plastic_yield"}, 20.0, "cause_named", {"plastic_yield"}));
  all.back().ideal.emplace(IdealJudge{{"elastic_waves", 8.0, 0}, {"elastic_waves", 8.0, 0}, 0.9});
  all.push_back(answer("wall", {"plastic_yield"}, 5.0, "adequate", {}));
  all.push_back(answer("li", {"jkr_hysteresis"}, 20.0, "not_separable", {},
                       {"jkr_hysteresis", "adhesion_hysteresis"}));
  all.back().shared_cause = "adhesion hysteresis";
  all.back().ideal.emplace(
      IdealJudge{{"adhesion_hysteresis", 1.5, 0}, {"adhesion_hysteresis", 1.5, 0}, 0.9});
  all.push_back(answer("li", {"gas_film"}, 10.0, "cause_named", {"probe_plane"}));
  all.back().ideal.emplace(IdealJudge{{"plate_flexure", 5.0, 0}, {"plate_flexure", 5.0, 0}, 0.9});
  all.push_back(answer("wall", {}, 0.0, "adequate", {}));
  all.push_back(answer("wall", {}, 0.0, "unexplained", {}));
  all.back().p_value = 0.01;
  all.push_back(answer("wall", {"dip"}, 20.0, "unexplained", {}));
  all.push_back(answer("wall", {"velocities"}, 0.0, "unexplained", {}));
  all.back().errors_told = true;
  all.push_back(answer("wall-one", {"plastic_yield"}, 20.0, "not_separable", {}, {"gas_film"}));
  all.push_back(answer("li", {"capillary"}, 40.0, "", {}));
  all.back().reached = false;
  all.back().signal_to_noise = 7.5;
  return all;
}

void expect(const StudyTally& tally, const char* bar, int k, int n) {
  const Count count = tally.bar(bar);
  EXPECT_EQ(count.k, k) << bar;
  EXPECT_EQ(count.n, n) << bar;
}

TEST(HiddenEffectsTally, CountsEveryBarOverItsOwnDataSets) {
  const StudyTally tally = tally_of(answers(), 12, {});
  EXPECT_EQ(tally.planned, 12);
  EXPECT_EQ(tally.tried, 10);
  EXPECT_EQ(tally.made, 9);
  expect(tally, "named", 1, 3);
  expect(tally, "separable_named", 1, 2);
  expect(tally, "nameable_named", 1, 2);
  expect(tally, "nameable_if_exact", 1, 2);
  expect(tally, "if_exact_wrong", 0, 3);
  expect(tally, "named_or_law", 2, 3);
  expect(tally, "listed", 2, 3);
  expect(tally, "wrong", 1, 3);
  expect(tally, "false_alarm", 1, 2);
  expect(tally, "outside_unexplained", 1, 1);
  expect(tally, "unstated_named", 0, 1);
  expect(tally, "unstated_told", 1, 1);
  expect(tally, "single_diameter", 1, 1);
  EXPECT_EQ(tally.not_named.n, 2);
  EXPECT_EQ(tally.not_named.alike, 1);
  EXPECT_EQ(tally.not_named.told_by_cause, 1);
  EXPECT_EQ(tally.errors_told_astray.k, 0);
  EXPECT_EQ(tally.errors_told_astray.n, 3);
}

double ideal(const StudyTally& tally, std::string_view bar) {
  for (const auto& [id, number] : *tally.ideal) {
    if (id == bar) return number;
  }
  return -1.0;
}

// Lambda is 64, 2.25 and 25: the normal distribution at 60/16, -1.75/3 and 21/10 (tables).
TEST(HiddenEffectsTally, AddsWhatAnIdealJudgeWouldReach) {
  const StudyTally tally = tally_of(answers(), 12, {});
  ASSERT_TRUE(tally.ideal);
  EXPECT_NEAR(ideal(tally, "named"), 0.9999 + 0.2798 + 0.9821, 2e-4);
  EXPECT_NEAR(ideal(tally, "listed"), 3 * 0.9, 1e-12);
  EXPECT_NEAR(ideal(tally, "unseen"), 3 * 0.1, 1e-12);
  EXPECT_EQ(ideal(tally, "wrong"), -1.0);            // nobody has to be wrong
  EXPECT_EQ(ideal(tally, "single_diameter"), -1.0);  // he was not asked
}

TEST(HiddenEffectsTally, KeepsWhatWasHiddenApartByStrengthAndDesign) {
  const StudyTally tally = tally_of(answers(), 10, {});
  int of_yield = 0;
  for (const PowerRow& row : tally.powers) {
    if (row.hidden != "plastic_yield" || row.arm != Arm::effect) continue;
    ++of_yield;
    EXPECT_EQ(row.n, 1);
    EXPECT_EQ(row.marked(row.signal_to_noise == 5.0 ? Mark::nothing : Mark::named), 1);
  }
  EXPECT_EQ(of_yield, 2);
  ASSERT_EQ(tally.unreached.size(), 1U);
  ASSERT_EQ(tally.unreached[0].not_made.size(), 1U);
  EXPECT_EQ(tally.unreached[0].not_made[0].signal_to_noise, 40.0);
  EXPECT_EQ(tally.unreached[0].not_made[0].n, 1);
  EXPECT_DOUBLE_EQ(tally.unreached[0].largest, 7.5);
  ASSERT_FALSE(tally.alarms.empty());
  EXPECT_EQ(tally.alarms[0].design, "wall");
  EXPECT_EQ(tally.alarms[0].alarms.k, 1);
  EXPECT_EQ(tally.alarms[0].low_p.k, 1);
}

TEST(HiddenEffectsTally, AsksWhatTheManualSays) {
  const auto wanted = [](std::string_view id) {
    const auto bar = std::find_if(study_bars().begin(), study_bars().end(),
                                  [&](const Bar& one) { return one.id == id; });
    return std::pair(bar->share, bar->at_least);
  };
  EXPECT_EQ(wanted("named"), std::pair(0.8, true));
  EXPECT_EQ(wanted("listed"), std::pair(0.95, true));
  EXPECT_EQ(wanted("false_alarm"), std::pair(0.05, false));
  EXPECT_EQ(wanted("wrong"), std::pair(0.02, false));
}

TEST(HiddenEffectsTally, ComesBackFromItsJson) {
  StudyTally tally = tally_of(answers(), 10, {});
  tally.stamp = {"hidden-effects", "recoil_study hidden-effects", "0123"};
  const std::filesystem::path file =
      testing::TempDir() + "recoil-tally-" + std::to_string(getpid()) + ".json";
  recoil::write_whole_file(file, recoil::study_json(tally), recoil::Replacing::data);
  const auto read = [&] {
    return recoil::read_study<StudyTally>(file, "study of hidden effects", "bars");
  };
  EXPECT_EQ(recoil::study_json(read()), recoil::study_json(tally));
  recoil::write_whole_file(file, R"({"study": "hidden-effects"})", recoil::Replacing::data);
  EXPECT_THROW(read(), recoil::InputError);
  std::filesystem::remove(file);
}

}  // namespace
