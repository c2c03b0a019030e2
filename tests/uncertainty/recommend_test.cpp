// The rule and the reasons of a disagreement, decided from numbers.
#include <gtest/gtest.h>

#include "uncertainty/parameter_intervals.hpp"

namespace recoil {
namespace {

Interval between(double lower, double upper) {
  Interval interval;
  interval.lower = lower;
  interval.upper = upper;
  interval.shape = ProfileShape::bounded;
  return interval;
}

struct Example {
  FitResult fitted;
  std::vector<IntervalSet> sets;
};

/// Two free parameters at 1 and 2 with errors 0.1, and intervals that agree.
Example agreeing() {
  Example made;
  for (const std::size_t k : {0U, 1U}) {
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
    for (const IntervalKind kind : values_of<IntervalKind>()) {
      set[kind] = between(at - 0.2, at + 0.2);
    }
    set.bca_constants = BcaConstants{};
    set.bound_share = 0.0;
    recommend(set, true);
    made.sets.push_back(set);
  }
  return made;
}

std::optional<Disagreement> disagreement(const Example& example) {
  return explain_disagreement(example.fitted, 0, example.sets, 0.95);
}

TEST(Recommend, ProfileThenPercentileThenWald) {
  IntervalSet set = agreeing().sets[0];
  EXPECT_EQ(set.recommended, IntervalKind::profile);
  EXPECT_FALSE(set.student);
  recommend(set, false);
  EXPECT_TRUE(set.student);
  set[IntervalKind::profile] = no_interval(NoInterval::no_lower_end);
  recommend(set, true);
  EXPECT_EQ(set.recommended, IntervalKind::percentile);
  set[IntervalKind::percentile] = Interval{};
  recommend(set, true);
  EXPECT_EQ(set.recommended, IntervalKind::wald);
}

TEST(Disagreement, AgreementIsSilent) { EXPECT_FALSE(disagreement(agreeing())); }

TEST(Disagreement, ChanceIsNoDisagreement) {
  Example e = agreeing();
  e.sets[0][IntervalKind::percentile] = between(0.88, 1.2);  // 0.08 of 0.4: 20 %
  const auto found = disagreement(e);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->differing.size(), 1U);
  EXPECT_EQ(found->differing[0].kind, IntervalKind::percentile);
  EXPECT_NEAR(found->differing[0].by, 0.2, 1e-12);
  e.sets[0][IntervalKind::percentile].lower_error = 0.03;
  EXPECT_FALSE(disagreement(e));
}

TEST(Disagreement, NamesTheCauseThatTheNumbersShow) {
  Example e = agreeing();
  e.sets[0][IntervalKind::bca] = between(0.9, 1.3);
  ASSERT_TRUE(disagreement(e));
  EXPECT_EQ(disagreement(e)->differing[0].kind, IntervalKind::bca);
  EXPECT_NEAR(disagreement(e)->differing[0].by, 0.25, 1e-12);
  EXPECT_FALSE(disagreement(e)->explained());

  Example skew = e;
  skew.sets[0].bca_constants = BcaConstants{0.0, 0.12};
  EXPECT_EQ(disagreement(skew)->acceleration, 0.12);
  EXPECT_FALSE(disagreement(skew)->bias);
  EXPECT_TRUE(disagreement(skew)->explained());
  skew = e;
  skew.sets[0][IntervalKind::profile] = between(0.9, 1.3);
  ASSERT_TRUE(disagreement(skew)->arms);
  EXPECT_NEAR(*disagreement(skew)->arms, 3.0, 1e-12);

  Example bound = e;
  bound.sets[0].bound_share = 0.31;
  ASSERT_TRUE(disagreement(bound)->on_bound);
  EXPECT_EQ(disagreement(bound)->on_bound->slot, 0U);
  EXPECT_EQ(disagreement(bound)->on_bound->share, 0.31);
  bound = e;
  bound.fitted.at_bound[0] = true;
  EXPECT_TRUE(disagreement(bound)->estimate_at_bound);

  Example partner = e;
  partner.sets[1].bound_share = 0.2;
  EXPECT_FALSE(disagreement(partner)->on_bound) << "it is not correlated";
  partner.fitted.covariance = {0.01, -0.008, -0.008, 0.01};
  ASSERT_TRUE(disagreement(partner)->on_bound);
  EXPECT_EQ(disagreement(partner)->on_bound->slot, 1U);
  EXPECT_EQ(disagreement(partner)->on_bound->share, 0.2);
  EXPECT_NEAR(disagreement(partner)->on_bound->correlation, -0.8, 1e-12);

  Example ridge = e;
  ridge.fitted.covariance = {0.01, 0.0099, 0.0099, 0.01};
  ASSERT_TRUE(disagreement(ridge)->ridge);
  EXPECT_EQ(disagreement(ridge)->ridge->partner, 1U);
  EXPECT_NEAR(disagreement(ridge)->ridge->correlation, 0.99, 1e-12);

  Example few = e;
  few.fitted.dof = 8;
  EXPECT_FALSE(disagreement(few)->few_points) << "the deviations are stated";
  few.fitted.quantile_dof = 8;
  const auto found = explain_disagreement(few.fitted, 0, few.sets, 0.95);
  ASSERT_TRUE(found->few_points);
  EXPECT_EQ(found->few_points->dof, 8);
  EXPECT_NEAR(found->few_points->factor, 2.306 / 1.960, 1e-3);
}

TEST(Bounds, AreNoted) {
  ParameterSlot slot;
  slot.upper = 1.0;
  const auto noted = [&](double lower, double upper) {
    Interval interval = between(lower, upper);
    note_bounds(interval, slot);
    return interval.note;
  };
  EXPECT_EQ(noted(0.0, 0.5)->caution, Caution::begins_at_bound);
  EXPECT_EQ(noted(0.2, 1.0)->caution, Caution::ends_at_bound);
  EXPECT_EQ(noted(0.2, 1.0)->value, 1.0);
  EXPECT_EQ(noted(0.0, 1.0)->caution, Caution::spans_both_bounds);
  EXPECT_FALSE(noted(0.1, 0.2));
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
