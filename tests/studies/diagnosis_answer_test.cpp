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

TEST(NearestRival, IsSoughtForOneVisibleEffectOfTheCatalogueInSeveralSizes) {
  const ScratchFolder scratch;
  const fs::path program = stand_in(scratch);
  const Answered visible_one = ask({"wall", {"gas_film"}, 10.0, 0}, program, {});
  ASSERT_TRUE(visible_one.reached);
  EXPECT_EQ(visible_one.status, 3);
  EXPECT_NE(visible_one.nearest_rival.id, "");
  EXPECT_NE(visible_one.nearest_rival.id, "gas_film");
  // The base model leaves 10, and a rival has its parameters and more.
  EXPECT_GT(visible_one.nearest_rival.misfit, 0.0);
  EXPECT_LT(visible_one.nearest_rival.misfit, 10.0);
  for (const CaseOrder& other :
       std::vector<CaseOrder>{{"wall", {"gas_film"}, 5.0, 0},
                              {"wall", {"dip"}, 20.0, 0},
                              {"wall", {"gas_film", "plastic_yield"}, 20.0},
                              {"wall-one", {"jkr_hysteresis"}, 10.0, 0}}) {
    const Answered answered = ask(other, program, {});
    EXPECT_TRUE(answered.reached) << other.key();
    EXPECT_EQ(answered.nearest_rival.id, "") << other.key();
  }
}

// Lambda is 9: the normal distribution at 5/6 and, with a parameter more, at 7/6 (tables).
TEST(NearestRival, IsToldApartAsOftenAsTheNormalDistributionSays) {
  EXPECT_NEAR((NearestRival{"plate_flexure", 3.0, 0}).nameable(), 0.7977, 1e-4);
  EXPECT_NEAR((NearestRival{"electrostatic_image", 3.0, 1}).nameable(), 0.8783, 1e-4);
  EXPECT_EQ((NearestRival{"", 0.0, 0}).nameable(), 0.0);
  EXPECT_EQ((NearestRival{"", std::numeric_limits<double>::infinity(), 0}).nameable(), 1.0);
}

// The energy that crushes asperities falls with the size as the field of a charge that grows with
// another power of it does.
TEST(NearestRival, OfAsperitiesIsAChargeWithAFreeExponent) {
  const Case made = make_case({"wall", {"asperity_loss"}, 20.0, 0});
  ASSERT_TRUE(made.reached);
  const NearestRival rival = nearest_rival(made);
  EXPECT_EQ(rival.id, "electrostatic_image");
  EXPECT_EQ(rival.freed, 1);
  const ScratchFolder scratch;
  const std::filesystem::path fit = write_case(without_noise(made), scratch.path());
  EXPECT_GT(misfit_left(fit, rival.id), 2.0 * rival.misfit);
}

TEST(KeptAnswer, IsFoundByItsOrderOnly) {
  const ScratchFolder scratch;
  Answered made;
  made.order = {"wall", {"gas_film"}, 10.0, 3};
  made.verdict = "not_separable";
  made.rivals = {"gas_film", "probe_plane"};
  made.taken = {{4.9e-6, 10.0, 40, {"ambient_pressure", 1.0}}};
  made.nearest_rival = {"crack_rate", std::numeric_limits<double>::infinity(), 1};
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

}  // namespace
