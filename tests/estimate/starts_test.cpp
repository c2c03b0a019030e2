// How the ends of several starts are compared.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "estimate/fit.hpp"
#include "support/synthetic.hpp"

namespace recoil {
namespace {

/// Four impacts at one velocity: C_H and C_A can replace each other.
FitResult fit_of_a_valley() {
  Dataset data = synthetic::dataset({.diameters = {4.9e-6}, .velocities = {3.0, 3.0, 3.0, 3.0}});
  constexpr std::array measured = {0.600, 0.610, 0.590, 0.605};
  for (std::size_t i = 0; i < measured.size(); ++i) data.points[i].restitution = measured[i];
  return fit(make_model(synthetic::spec(), {data}), gather({data}));
}

TEST(Starts, InAValleyReachTheSameChiSquareButNotTheSameParameters) {
  const FitResult fitted = fit_of_a_valley();
  ASSERT_TRUE(fitted.usable);
  const StartSummary& best = fitted.best_start();
  int elsewhere = 0;
  for (const StartSummary& start : fitted.starts) {
    const bool apart = std::abs(start.end[0] / best.end[0] - 1.0) > 0.01;
    if (!start.converged() || !apart) continue;
    ++elsewhere;
    EXPECT_NEAR(start.chi2, best.chi2, 1e-3 * best.chi2);
    EXPECT_EQ(start.outcome, StartOutcome::tie);
    EXPECT_EQ(start.differing, (std::vector<std::size_t>{0, 1}));
  }
  EXPECT_GE(elsewhere, 3);
}

TEST(Starts, OfADeterminedFitReachTheSameParameters) {
  const Dataset data = synthetic::dataset({});
  const FitResult fitted = fit(make_model(synthetic::spec(), {data}), gather({data}));
  ASSERT_TRUE(fitted.usable);
  const auto same =
      std::count_if(fitted.starts.begin(), fitted.starts.end(), [&](const StartSummary& start) {
        return start.outcome == StartOutcome::best || start.outcome == StartOutcome::same;
      });
  EXPECT_EQ(same, static_cast<std::ptrdiff_t>(fitted.starts.size()));
}

StartSummary ended_at(double chi2, std::vector<double> end) {
  StartSummary start;
  start.start = {1.0, 1.0};
  start.end = std::move(end);
  start.chi2 = chi2;
  start.ending = DescentEnd::minimum;
  return start;
}

TEST(Starts, AreComparedByChiSquareThenByParameters) {
  using enum StartOutcome;
  std::vector<StartSummary> starts = {
      ended_at(10.0, {2.0, 3.0}),     // the best
      ended_at(10.001, {2.05, 3.0}),  // within a tenth of the standard error
      ended_at(10.001, {2.2, 3.0}),   // apart
      ended_at(10.001, {2.0, 3.01}),  // the second has no standard error
      ended_at(10.1, {2.0, 3.0}),     // another chi2
  };
  compare_starts(starts, 0, {1.0, 0.0});
  EXPECT_EQ(starts[0].outcome, best);
  EXPECT_EQ(starts[1].outcome, same);
  EXPECT_EQ(starts[2].outcome, tie);
  EXPECT_EQ(starts[2].differing, (std::vector<std::size_t>{0}));
  EXPECT_EQ(starts[3].differing, (std::vector<std::size_t>{1}));
  EXPECT_EQ(starts[4].outcome, worse);
}

}  // namespace
}  // namespace recoil
