#include "diagnosis/held_out.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/law_errors.hpp"
#include "support/synthetic.hpp"

namespace recoil {
namespace {

TEST(HeldOut, HoldsOutEverySizeAndThirdsOfTheVelocity) {
  const std::vector<Dataset> data = {synthetic::dataset({})};
  const std::vector<Fold> folds = held_out_folds(gather(data), data.size(), 3);
  ASSERT_EQ(folds.size(), 5U);
  EXPECT_EQ(folds[0].kind, FoldKind::size);
  EXPECT_EQ(folds[0].lower, 2.58e-6);
  EXPECT_EQ(folds[0].upper, 2.58e-6);
  EXPECT_EQ(folds[0].points.size(), 7U);
  EXPECT_EQ(folds[2].kind, FoldKind::velocity);
  std::size_t points = 0;
  for (std::size_t f = 2; f < 5; ++f) points += folds[f].points.size();
  EXPECT_EQ(points, 14U);
}

TEST(HeldOut, LeavesNoFoldThatTakesTooMuch) {
  synthetic::Design design;
  design.diameters = {4.9e-6};
  const std::vector<Dataset> data = {synthetic::dataset(design)};
  for (const Fold& fold : held_out_folds(gather(data), data.size(), 3)) {
    EXPECT_EQ(fold.kind, FoldKind::velocity);
    EXPECT_GE(7U - fold.points.size(), 5U);
  }
}

Fold fold(FoldKind kind) { return {kind, 0.0, 0.0, 0, {0, 1}}; }

TEST(HeldOut, GainIsWorkedByHand) {
  // rms 0.05 against 0.025: half; ln likelihood (40 - 10) / 2.
  const std::vector<FoldPrediction> base = {{true, 0.0, 40.0, {0.05, -0.05}}};
  const std::vector<FoldPrediction> extended = {{true, 0.0, 10.0, {0.025, -0.025}}};
  const HeldOutGain gain = held_out_gain({fold(FoldKind::size)}, base, extended, 1);
  EXPECT_NEAR(gain.rmse_base, 0.05, 1e-15);
  EXPECT_NEAR(gain.rmse_extended, 0.025, 1e-15);
  EXPECT_NEAR(gain.relative, 0.5, 1e-12);
  EXPECT_NEAR(gain.log_score, 15.0, 1e-12);
  ASSERT_TRUE(gain.lower && gain.upper);
  EXPECT_NEAR(*gain.lower, 0.5, 1e-12);  // every resample has the same quotient
}

TEST(HeldOut, VelocitiesDecideOnlyWhereThereAreNoSizes) {
  const std::vector<FoldPrediction> base = {{true, 0.0, 40.0, {0.1}}, {true, 0.0, 4.0, {0.01}}};
  const std::vector<FoldPrediction> extended = {{true, 0.0, 10.0, {0.05}},
                                                {true, 0.0, 400.0, {0.1}}};
  const HeldOutGain both =
      held_out_gain({fold(FoldKind::size), fold(FoldKind::velocity)}, base, extended, 1);
  EXPECT_TRUE(both.decisive);
  EXPECT_NEAR(both.log_score, 15.0, 1e-12);
  EXPECT_FALSE(both.folds[1].counted);
  const HeldOutGain one =
      held_out_gain({fold(FoldKind::velocity), fold(FoldKind::velocity)}, base, extended, 1);
  EXPECT_FALSE(one.decisive);
  EXPECT_NEAR(one.log_score, 15.0 - 198.0, 1e-12);
}

TEST(HeldOut, WhatTheOtherPointsDoNotShowIsPredictedByTheBase) {
  // The second fold would be far off, but without it the criterion is for the base: 3 against 5.
  const std::vector<FoldPrediction> base = {{true, 9.0, 40.0, {0.1}}, {true, 3.0, 4.0, {0.01}}};
  const std::vector<FoldPrediction> extended = {{true, 2.0, 10.0, {0.05}},
                                                {true, 5.0, 400.0, {0.1}}};
  const HeldOutGain gain =
      held_out_gain({fold(FoldKind::size), fold(FoldKind::size)}, base, extended, 1);
  EXPECT_NEAR(gain.log_score, 15.0, 1e-12);
  EXPECT_EQ(gain.folds[1].rmse_extended, gain.folds[1].rmse_base);
}

TEST(HeldOut, FoldsWithoutAnAnswerAreLeftOut) {
  const std::vector<FoldPrediction> base = {{true, 0.0, 40.0, {0.1}}, {false, 0.0, 0.0, {}}};
  const std::vector<FoldPrediction> extended = {{true, 0.0, 10.0, {0.05}}, {true, 0.0, 1.0, {0.1}}};
  EXPECT_EQ(
      held_out_gain({fold(FoldKind::size), fold(FoldKind::size)}, base, extended, 1).folds.size(),
      1U);
}

TEST(HeldOut, AFoldIsPredictedByTheOtherPoints) {
  // Without noise the points that are left determine the model that made the others.
  const std::vector<Dataset> data = {synthetic::dataset({})};
  const Candidate base = make_candidate(synthetic::spec(), data, {});
  const Observations points = gather(data);
  const std::vector<Fold> folds = held_out_folds(points, data.size(), 2);
  Refit start;
  start.theta = {4e-3, 0.04, 8.9};
  for (const FoldPrediction& fold :
       predict_folds(base, points, first_weights(points), {}, folds, start, 1)) {
    ASSERT_TRUE(fold.usable);
    for (const double error : fold.error) EXPECT_NEAR(error, 0.0, 2e-3);
  }
}

}  // namespace
}  // namespace recoil
