// The rule and the sentence on disagreement, decided from numbers.
#include "uncertainty/recommend.hpp"

#include <gtest/gtest.h>

namespace recoil {
namespace {

Interval between(double lower, double upper) {
  Interval interval;
  interval.lower = lower;
  interval.upper = upper;
  interval.shape = "bounded";
  return interval;
}

struct Example {
  FitResult fitted;
  std::vector<IntervalSet> sets;
};

/// Two free parameters at 1 and 2 with errors 0.1, and intervals that agree.
Example agreeing() {
  Example made;
  for (const std::size_t k : {0, 1}) {
    ParameterSlot slot;
    slot.parameter = &base_parameters()[k];
    slot.upper = 10.0;
    made.fitted.model.slots.push_back(slot);
  }
  made.fitted.theta = {1.0, 2.0};
  made.fitted.std_error = {0.1, 0.1};
  made.fitted.at_bound = {false, false};
  made.fitted.covariance = {0.01, 0.0, 0.0, 0.01};
  made.fitted.dof = 30;
  for (const double at : made.fitted.theta) {
    IntervalSet set;
    set.wald = set.profile = set.percentile = set.bca = set.studentized =
        between(at - 0.2, at + 0.2);
    set.bca_constants = BcaConstants{};
    set.bound_share = 0.0;
    recommend(set, true);
    made.sets.push_back(set);
  }
  return made;
}

std::string sentence(const Example& example) {
  return explain_disagreement(example.fitted, 0, example.sets, true, 0.95);
}

bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

TEST(Recommend, ProfileThenPercentileThenWald) {
  IntervalSet set = agreeing().sets[0];
  EXPECT_EQ(set.recommended, "profile");
  set.profile = Interval{};
  set.profile.why = "a refit failed";
  recommend(set, true);
  EXPECT_EQ(set.recommended, "percentile");
  EXPECT_TRUE(says(set.recommended_why, "a refit failed"));
  set.percentile = Interval{};
  recommend(set, true);
  EXPECT_EQ(set.recommended, "wald");
}

TEST(Disagreement, AgreementIsSilent) { EXPECT_EQ(sentence(agreeing()), ""); }

TEST(Disagreement, ChanceIsNoDisagreement) {
  Example e = agreeing();
  e.sets[0].percentile = between(0.88, 1.2);  // 0.08 of 0.4: 20 %
  EXPECT_TRUE(says(sentence(e), "percentile by 20 %")) << sentence(e);
  e.sets[0].percentile.lower_error = 0.03;
  EXPECT_EQ(sentence(e), "");
}

TEST(Disagreement, NamesTheCauseThatTheNumbersShow) {
  Example e = agreeing();
  e.sets[0].bca = between(0.9, 1.3);
  EXPECT_TRUE(says(sentence(e), "BCa by 25 %")) << sentence(e);
  EXPECT_TRUE(says(sentence(e), "no bound, ridge, skew or lack of points")) << sentence(e);

  Example skew = e;
  skew.sets[0].bca_constants = BcaConstants{0.0, 0.12};
  EXPECT_TRUE(says(sentence(skew), "skewed (acceleration +0.12)")) << sentence(skew);
  skew = e;
  skew.sets[0].profile = between(0.9, 1.3);
  EXPECT_TRUE(says(sentence(skew), "profile reaches 3 times as far up as down")) << sentence(skew);

  Example bound = e;
  bound.sets[0].bound_share = 0.31;
  EXPECT_TRUE(says(sentence(bound), "31 % of the replicates rest on a bound")) << sentence(bound);
  bound = e;
  bound.fitted.at_bound[0] = true;
  EXPECT_TRUE(says(sentence(bound), "the estimate rests on its bound")) << sentence(bound);

  Example partner = e;
  partner.sets[1].bound_share = 0.2;
  EXPECT_FALSE(says(sentence(partner), "bound,  with")) << sentence(partner);
  partner.fitted.covariance = {0.01, -0.008, -0.008, 0.01};
  EXPECT_TRUE(says(sentence(partner), "20 % of the replicates have C_A on its bound"))
      << sentence(partner);

  Example ridge = e;
  ridge.fitted.covariance = {0.01, 0.0099, 0.0099, 0.01};
  EXPECT_TRUE(says(sentence(ridge), "ridge against C_A (correlation 0.990)")) << sentence(ridge);

  Example few = e;
  few.fitted.dof = 8;  // Student 2.306 over 1.960: 1.18
  const std::string words = explain_disagreement(few.fitted, 0, few.sets, false, 0.95);
  EXPECT_TRUE(says(words, "8 degrees of freedom")) << words;
  EXPECT_TRUE(says(words, "factor of 1.18")) << words;
}

TEST(Bounds, AreNoted) {
  ParameterSlot slot;
  slot.upper = 1.0;
  Interval low = between(0.0, 0.5);
  note_bounds(low, slot);
  EXPECT_TRUE(says(low.note, "upper limit"));
  Interval high = between(0.2, 1.0);
  note_bounds(high, slot);
  EXPECT_TRUE(says(high.note, "lower limit"));
  Interval both = between(0.0, 1.0);
  note_bounds(both, slot);
  EXPECT_TRUE(says(both.note, "do not limit"));
  Interval inside = between(0.1, 0.2);
  note_bounds(inside, slot);
  EXPECT_TRUE(inside.note.empty());
}

TEST(Bounds, ShareOfTheReplicates) {
  BootstrapResult boot;
  ParameterSlot slot;
  slot.upper = 1.0;
  EXPECT_FALSE(bound_share(boot, slot, 0));
  boot.theta = {{0.0}, {0.2}, {1.0}, {0.3}};
  EXPECT_DOUBLE_EQ(*bound_share(boot, slot, 0), 0.5);
}

}  // namespace
}  // namespace recoil
