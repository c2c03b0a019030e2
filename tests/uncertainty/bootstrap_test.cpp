// The bootstrap as a run: extended, stopped and continued, counting and locating what fails.
#include "uncertainty/bootstrap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "analysis/analysis.hpp"
#include "core/resumable.hpp"
#include "estimate/impact_problem.hpp"
#include "support/noisy_case.hpp"
#include "uncertainty/capture_interval.hpp"
#include "uncertainty/fit_alternatives.hpp"
#include "uncertainty/resample.hpp"

namespace recoil {
namespace {

using synthetic::Case;
using synthetic::noisy_case;
using synthetic::small;

TEST(Jackknife, LeavesOutAPointOrAWholeSeries) {
  const Case made = noisy_case();
  const auto without = [&](const auto& is_left_out) {
    Dataset rest = made.datasets.front();
    std::erase_if(rest.points, is_left_out);
    return fit(make_model(synthetic::spec(), {rest}), gather({rest})).theta;
  };
  const auto expect_near = [&](const std::vector<double>& found, const std::vector<double>& right) {
    ASSERT_EQ(found.size(), right.size());
    for (std::size_t j = 0; j < right.size(); ++j) {
      EXPECT_NEAR(found[j], right[j], 1e-4 * made.fitted.std_error[j] + 1e-15) << j;
    }
  };
  const auto by_series = jackknife(plan_resampling(made.fitted, Scheme::cluster), 1);
  ASSERT_EQ(by_series.size(), 2U);
  for (std::size_t s = 0; s < by_series.size(); ++s) {
    expect_near(by_series[s], without([s](const ImpactPoint& point) { return point.series == s; }));
  }
  const auto by_point = jackknife(plan_resampling(made.fitted, Scheme::parametric), 1);
  ASSERT_EQ(by_point.size(), made.data.points.size());
  const Observation& last = made.data.points.back();
  expect_near(by_point.back(), without([&](const ImpactPoint& point) {
                return point.series == last.series && point.incident_velocity == last.velocity;
              }));
}

TEST(Bootstrap, RefitsEndAtTheirMinimum) {
  const Case made = noisy_case();
  const ResamplingPlan plan = plan_resampling(made.fitted, Scheme::parametric);
  UncertaintyOptions options = small(2);
  options.scheme = Scheme::parametric;
  const BootstrapResult run = bootstrap(made.fitted, {}, options);
  ASSERT_EQ(run.failed, 0);
  Observations sample = made.fitted.data;
  for (std::size_t b = 0; b < run.theta.size(); ++b) {
    resample(plan, options.seed, b, sample);
    const Weights weights = first_weights(sample);
    const LeastSquaresResult exact =
        minimise(impact_problem(made.fitted.model, sample, weights), made.fitted.model.initial());
    ASSERT_TRUE(exact.converged);
    for (std::size_t j = 0; j < exact.theta.size(); ++j) {
      // Their impacts are integrated to a hundred times the tolerance, which tells first.
      const double error = std::sqrt(exact.covariance[j * exact.theta.size() + j]);
      EXPECT_NEAR(run.theta[b][j], exact.theta[j], 1e-6 * error) << b << " " << j;
    }
  }
}

TEST(Bootstrap, ExtendingIsTheSameAsOneRun) {
  const Case c = noisy_case();
  for (const Scheme scheme : {Scheme::parametric, Scheme::residual, Scheme::wild, Scheme::cases}) {
    UncertaintyOptions options = small(1);
    options.scheme = scheme;
    Bootstrap whole(c.fitted, {}, options);
    whole.extend(30);
    UncertaintyOptions threads = options;
    threads.threads = 3;
    Bootstrap parts(c.fitted, {}, threads);
    parts.extend(7);
    parts.extend(30);
    EXPECT_EQ(whole.result().theta, parts.result().theta) << to_string(scheme);
    EXPECT_EQ(whole.result().std_error, parts.result().std_error) << to_string(scheme);
    EXPECT_EQ(whole.result().scheme, scheme);
  }
}

TEST(Bootstrap, TakesOverKeptReplicatesAndRunsTheOthers) {
  const Case c = noisy_case();
  UncertaintyOptions options = small(0);
  Bootstrap whole(c.fitted, {}, options);
  whole.extend(12);
  options.kept = std::make_shared<KeptRows>();
  Bootstrap first(c.fitted, {}, options);
  first.extend(12);
  EXPECT_EQ(options.kept->size(), 12U);
  // A mark in a row shows that it is taken over; a row of another length is not.
  std::vector<double> marked = row_numbers(*options.kept->find(4));
  EXPECT_EQ(first.row(4), *options.kept->find(4));
  marked[0] = 0.125;
  options.kept->put(4, row_json(marked));
  options.kept->put(5, row_json({0.125}));
  Bootstrap second(c.fitted, {}, options);
  second.extend(6);
  second.extend(12);
  EXPECT_EQ(second.result().theta[4][0], 0.125);
  EXPECT_EQ(second.result().std_error, whole.result().std_error);
  for (const std::size_t i : {3U, 5U, 11U}) {
    EXPECT_EQ(second.result().theta[i], whole.result().theta[i]);
  }
}

TEST(Bootstrap, ReplicatesAsPiecesGiveTheSameResult) {
  const Case c = noisy_case();
  UncertaintyOptions options = small(9);
  const UncertaintyResult whole = assess_uncertainty(c.fitted, c.datasets, options);
  UncertaintyOptions shared = options;
  shared.kept = std::make_shared<KeptRows>();
  resumable(bootstrap_pieces(
                c.fitted, capture_estimates(fit_alternatives(c.fitted), options.level, c.datasets),
                options),
            *shared.kept);
  ASSERT_EQ(shared.kept->size(), static_cast<std::size_t>(options.replicates));
  const UncertaintyResult merged = assess_uncertainty(c.fitted, c.datasets, shared);
  EXPECT_EQ(merged.bootstrap.theta, whole.bootstrap.theta);
  EXPECT_EQ(merged.bootstrap.std_error, whole.bootstrap.std_error);
  EXPECT_EQ(merged.bootstrap.capture_velocity, whole.bootstrap.capture_velocity);
  EXPECT_EQ(merged.bootstrap.capture_error, whole.bootstrap.capture_error);
}

TEST(Bootstrap, DigitsOfAFitDifferWithItsLastDigit) {
  Case c = noisy_case();
  const std::string digits = digits_of(c.fitted);
  EXPECT_EQ(digits_of(c.fitted), digits);
  c.fitted.theta[0] = std::nextafter(c.fitted.theta[0], INFINITY);
  EXPECT_NE(digits_of(c.fitted), digits);
}

TEST(Failures, TheDisturbedPointIsFound) {
  // Claim that the replicates in which point 5 was drawn far up failed: it has to stand out.
  const Case c = noisy_case();
  const ResamplingPlan plan = plan_resampling(c.fitted, Scheme::parametric);
  std::vector<std::uint64_t> claimed;
  for (std::uint64_t r = 0; r < 999; ++r) {
    if (perturbation(plan, 3, r)[5] > 1.8) claimed.push_back(r);
  }
  ASSERT_GT(claimed.size(), 10U);
  const FailedReplicates found = locate_failures(plan, 3, 999, claimed);
  ASSERT_FALSE(found.suspects.empty());
  EXPECT_EQ(found.suspects.front().point, 5U);
  EXPECT_GT(found.suspects.front().failed, 1.8);
  EXPECT_NEAR(found.suspects.front().usual, 0.0, 0.2);
  EXPECT_TRUE(found.suspects.front().clearly_unlike);
  EXPECT_EQ(found.index, claimed);
  EXPECT_TRUE(locate_failures(plan, 3, 999, {}).suspects.empty());
}

TEST(Failures, TenPercentWithholdOnePercentWarns) {
  // Two points, two parameters: half of the samples of cases hold one of the points twice, and
  // cannot determine both.
  Case c = noisy_case();
  synthetic::Design design;
  design.diameters = {4.9e-6};
  design.velocities = {2.5, 25.0};
  c.datasets = {synthetic::dataset(design)};
  c.data = gather(c.datasets);
  c.fitted = fit(make_model(synthetic::spec(), c.datasets), c.data);
  UncertaintyOptions options = small(0);
  options.scheme = Scheme::cases;
  options.replicates = 99;
  const UncertaintyResult result = assess_uncertainty(c.fitted, c.datasets, options);
  EXPECT_NEAR(result.bootstrap.failed, 49.5, 20.0);  // four standard errors of a fair coin
  EXPECT_TRUE(result.bootstrap.failures.undetermined);
  EXPECT_TRUE(result.bootstrap.failed_often());
  EXPECT_TRUE(result.bootstrap.withheld());
  for (const IntervalKind kind :
       {IntervalKind::percentile, IntervalKind::bca, IntervalKind::studentized}) {
    EXPECT_EQ(result.intervals[0][kind].missing, NoInterval::refits_failed);
  }
  EXPECT_FALSE(result.capture[0][CaptureIntervalKind::percentile].available());
}

TEST(Automatic, AddsBatchesUntilTheErrorIsSmall) {
  const Case c = noisy_case();
  UncertaintyOptions options = small(0);
  options.replicates_auto = true;
  options.wanted_error = 0.04;
  const BootstrapResult loose = bootstrap(c.fitted, {}, options);
  ASSERT_TRUE(loose.relative_error);
  EXPECT_LE(*loose.relative_error, 0.04);
  EXPECT_EQ(loose.replicates, 999);  // 2.7 / sqrt(999) / 3.9 = 2.2 % for a normal one
  options.wanted_error = 0.02;
  const BootstrapResult tight = bootstrap(c.fitted, {}, options);
  EXPECT_LE(*tight.relative_error, 0.02);
  EXPECT_GT(tight.replicates, 999);
  EXPECT_EQ((tight.replicates + 1) % 1000, 0);
  // What was there stays: the first replicates are those of the smaller run.
  EXPECT_TRUE(std::equal(loose.theta.begin(), loose.theta.end(), tight.theta.begin()));
}

}  // namespace
}  // namespace recoil
