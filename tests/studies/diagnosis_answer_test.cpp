// What is asked of the command besides a diagnosis, with a stand-in for it.
#include "validation/studies/diagnosis_answer.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/files.hpp"
#include "validation/synthetic/case.hpp"

namespace {

using namespace recoil::hidden;
namespace fs = std::filesystem;

/// Diagnoses nothing.
fs::path stand_in(const ScratchFolder& scratch) {
  const fs::path program = scratch.path() / "stand-in";
  recoil::write_whole_file(program, "#!/bin/sh\nexit 3\n");
  fs::permissions(program, fs::perms::owner_all);
  return program;
}

TEST(IdealJudge, IsAskedForRivalsOfOneVisibleEffectOfTheCatalogueInSeveralSizes) {
  const ScratchFolder scratch;
  const fs::path program = stand_in(scratch);
  const Answered visible_one = ask({"wall", {"gas_film"}, 10.0, 0}, program, {});
  ASSERT_TRUE(visible_one.reached);
  EXPECT_EQ(visible_one.status, 3);
  ASSERT_TRUE(visible_one.ideal);
  EXPECT_NE(visible_one.ideal->rival.id, "");
  EXPECT_NE(visible_one.ideal->rival.id, "gas_film");
  EXPECT_EQ(visible_one.ideal->other.id, visible_one.ideal->rival.id);
  // The base model leaves 10, and a rival has its parameters and more.
  EXPECT_GT(visible_one.ideal->rival.misfit, 0.0);
  EXPECT_LT(visible_one.ideal->rival.misfit, 10.0);
  for (const CaseOrder& other :
       std::vector<CaseOrder>{{"wall", {"gas_film"}, 5.0, 0},
                              {"wall", {"dip"}, 20.0, 0},
                              {"wall", {"gas_film", "plastic_yield"}, 20.0}}) {
    const Answered answered = ask(other, program, {});
    EXPECT_TRUE(answered.reached) << other.key();
    EXPECT_FALSE(answered.ideal) << other.key();
  }
  const Answered one_size = ask({"wall-one", {"jkr_hysteresis"}, 10.0, 0}, program, {});
  ASSERT_TRUE(one_size.ideal);
  EXPECT_EQ(one_size.ideal->rival.id, "");
  EXPECT_GT(one_size.ideal->sees, 0.0);
}

TEST(KeptAnswer, IsFoundByItsOrderOnly) {
  const ScratchFolder scratch;
  Answered made;
  made.order = {"wall", {"gas_film"}, 10.0, 3};
  made.verdict = "not_separable";
  made.rivals = {"gas_film", "probe_plane"};
  made.taken = {{4.9e-6, 10.0, 40, {"ambient_pressure", 1.0}}};
  made.ideal.emplace(
      IdealJudge{{"crack_rate", std::numeric_limits<double>::infinity(), 1}, {}, 0.5});
  const std::string text = recoil::json_text(recoil::as_json(made, recoil::NonFinite::word));
  recoil::write_whole_file(scratch.path() / (neutral_name(made.order) + ".json"), text,
                           recoil::Replacing::data);
  const std::optional<Answered> found = kept_answer(made.order, scratch.path());
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(recoil::json_text(recoil::as_json(*found, recoil::NonFinite::word)), text);
  CaseOrder other = made.order;
  other.seed = 7;
  EXPECT_FALSE(kept_answer(other, scratch.path()).has_value());
}

TEST(KeptAnswer, OfWhichNoJudgeWasAskedIsJudgedAndKept) {
  const ScratchFolder scratch;
  const fs::path program = stand_in(scratch);
  const CaseOrder order{"wall-one", {"jkr_hysteresis"}, 10.0, 0};
  const double sees = ask(order, program, scratch.path()).ideal->sees;
  Answered kept = *kept_answer(order, scratch.path());
  kept.complaint = "of before";
  kept.ideal.reset();
  recoil::write_whole_file(scratch.path() / (neutral_name(order) + ".json"),
                           recoil::json_text(recoil::as_json(kept, recoil::NonFinite::word)),
                           recoil::Replacing::data);
  const Answered again = ask(order, program, scratch.path());
  EXPECT_EQ(again.complaint, "of before");
  EXPECT_EQ(again.ideal->sees, sees);
  EXPECT_EQ(kept_answer(order, scratch.path())->ideal->sees, sees);
}

}  // namespace
