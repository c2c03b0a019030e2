// The ends of a profile from evaluations that fail, or end in a worse minimum. The profiles are
// parabolas around 1 with a standard error of 0.1.
#include "uncertainty/profile_end.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "uncertainty/interval.hpp"

namespace recoil::profile_end {
namespace {

constexpr double estimate = 1.0;
constexpr double error = 0.1;
constexpr double rise_at_end = 3.841458821;  // chi-squared, 1 degree of freedom, 95 %
constexpr double arm = 0.1959963985;

/// What an evaluation at `value` gives from the kept place.
using Evaluation =
    std::function<std::optional<double>(double value, double kept, bool kept_is_bad, bool& is_bad)>;

std::optional<double> parabola(double value) { return std::pow((value - estimate) / error, 2); }

struct Found {
  std::optional<ProfileEnd> end;
  int evaluations = 0;
};

Found find(const Evaluation& evaluate, double bound, double stride) {
  Found found;
  double last = estimate, kept = estimate;
  bool last_is_bad = false, kept_is_bad = false;
  const ProfileWalk walk = {[&](double value) {
                              ++found.evaluations;
                              last = value;
                              last_is_bad = kept_is_bad;
                              return evaluate(value, kept, kept_is_bad, last_is_bad);
                            },
                            [&] {
                              kept = last;
                              kept_is_bad = last_is_bad;
                            }};
  found.end = find_profile_end(walk, estimate, bound, stride, [](double) { return rise_at_end; });
  return found;
}

const Evaluation sound = [](double value, double, bool, bool&) { return parabola(value); };

/// Ends in another minimum, 400 above, after a step longer than `reach`, and stays in it.
Evaluation leaves_after(double reach) {
  return [reach](double value, double kept, bool kept_is_bad, bool& is_bad) {
    is_bad = kept_is_bad || std::abs(value - kept) > reach;
    return *parabola(value) + (is_bad ? 400.0 : 0.0);
  };
}

Evaluation fails_after(double reach) {
  return [reach](double value, double kept, bool, bool&) {
    return std::abs(value - kept) > reach ? std::nullopt : parabola(value);
  };
}

Evaluation fails_below(double least) {
  return [least](double value, double, bool, bool&) {
    return value < least ? std::nullopt : parabola(value);
  };
}

Evaluation jumps_below(double least) {
  return [least](double value, double, bool, bool&) {
    return *parabola(value) + (value < least ? 50.0 : 0.0);
  };
}

TEST(ProfileEnd, IsFoundPastFailuresAndWorseMinima) {
  for (const double stride : {0.02, 0.206, 1.5}) {
    for (const double bound : {-10.0, 10.0}) {
      const Evaluation all[] = {sound, leaves_after(0.15), leaves_after(0.03), fails_after(0.15),
                                fails_after(0.03)};
      for (const Evaluation& evaluate : all) {
        const Found found = find(evaluate, bound, stride);
        ASSERT_TRUE(found.end) << stride << " " << bound << " " << &evaluate - all;
        EXPECT_NEAR(found.end->value, estimate + std::copysign(arm, bound), 1e-6);
        EXPECT_FALSE(found.end->at_bound);
        EXPECT_LT(found.evaluations, 100);
      }
    }
  }
  EXPECT_LT(find(sound, -10.0, 1.05 * arm).evaluations, 6);
}

TEST(ProfileEnd, IsNotWhereEvaluationsFail) {
  for (const double least : {1.0, 0.9, 0.81}) {
    EXPECT_FALSE(find(fails_below(least), -10.0, 0.206).end) << least;
    EXPECT_TRUE(find(fails_below(least), 10.0, 0.206).end) << least;
  }
  EXPECT_NEAR(find(fails_below(0.8), -10.0, 0.206).end.value().value, estimate - arm, 1e-6);
}

TEST(ProfileEnd, IsAJumpOnlyAwayFromTheEstimate) {
  const Found found = find(jumps_below(0.9), -10.0, 0.206);
  ASSERT_TRUE(found.end);
  EXPECT_NEAR(found.end->value, 0.9, 1e-6);
  EXPECT_GE(found.end->value, 0.9);  // not excluded
  EXPECT_FALSE(find(jumps_below(1.0), -10.0, 0.206).end);
  EXPECT_FALSE(find(jumps_below(1.0 - 1e-9), -10.0, 0.206).end);
}

TEST(ProfileEnd, IsTheBoundOnlyIfItIsNotExcluded) {
  for (const double stride : {0.02, 0.206, 1.5}) {
    const Found at = find(sound, 0.9, stride);
    ASSERT_TRUE(at.end);
    EXPECT_TRUE(at.end->at_bound);
    EXPECT_EQ(at.end->value, 0.9);
    EXPECT_FALSE(find(fails_below(0.9001), 0.9, stride).end);
    EXPECT_FALSE(find(sound, 0.8, stride).end.value().at_bound);
  }
  EXPECT_TRUE(find(fails_below(2.0), estimate, 0.206).end.value().at_bound);
}

TEST(Arms, AnEndIsNeverAnEstimateBetweenTheBounds) {
  const auto drawn = [](double lower, double upper, double at, double bound) {
    Interval interval;
    interval.lower = lower;
    interval.upper = upper;
    return with_both_arms(interval, at, bound, 10.0);
  };
  EXPECT_TRUE(drawn(0.9, 1.1, 1.0, 0.0).available());
  EXPECT_EQ(drawn(1.0, 1.1, 1.0, 0.0).missing, NoInterval::end_at_estimate);
  EXPECT_EQ(drawn(0.9, 1.0, 1.0, 0.0).missing, NoInterval::end_at_estimate);
  EXPECT_TRUE(drawn(1.0, 1.1, 1.0, 1.0).available());
  EXPECT_EQ(with_both_arms(no_interval(NoInterval::fixed), 1.0, 0.0, 2.0).missing,
            NoInterval::fixed);
}

}  // namespace
}  // namespace recoil::profile_end
