// The bootstrap as a run: extended, stopped and continued, counting and locating what fails.
#include "uncertainty/bootstrap.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "analysis/analysis.hpp"
#include "core/files.hpp"
#include "estimate/impact_problem.hpp"
#include "support/noisy_case.hpp"
#include "support/temporary_folder.hpp"
#include "uncertainty/locate_failures.hpp"
#include "uncertainty/resample.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;
using synthetic::Case;
using synthetic::noisy_case;
using synthetic::small;

/// A folder for kept replicates.
struct Folder : support::TemporaryFolder {
  fs::path file() const { return path() / "replicates.json"; }
};

/// What a file of replicates gives to an empty table.
ReplicateTable loaded(const fs::path& file, const std::string& key, std::size_t slots,
                      std::size_t derived = 0) {
  ReplicateTable table;
  table.slots = slots;
  table.derived = derived;
  load_replicates(file, key, table);
  return table;
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
    const LeastSquaresResult exact =
        minimise(impact_problem(made.fitted.model, sample), made.fitted.model.initial());
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

TEST(ReplicateTable, EveryDigitComesBackUnderItsKeyOnly) {
  const Folder folder;
  ReplicateTable table;
  table.slots = 2;
  table.grow(4);
  table.state = {ReplicateTable::State::usable, ReplicateTable::State::not_run,
                 ReplicateTable::State::failed, ReplicateTable::State::usable};
  table.theta = {1.0 / 3.0, 1e-300, 0, 0, 0, 0, M_PI, 0.1};
  table.std_error = {0.1 + 0.2, 0, 0, 0, 0, 0, 1e17 + 1, 5e-324};
  save_replicates(folder.file(), "key", table);
  const ReplicateTable back = loaded(folder.file(), "key", 2);
  EXPECT_EQ(back.state, table.state);
  EXPECT_EQ(back.theta, table.theta);
  EXPECT_EQ(back.std_error, table.std_error);
  EXPECT_EQ(back.finished(), 3U);
  EXPECT_EQ(loaded(folder.file(), "other", 2).finished(), 0U);
  EXPECT_EQ(loaded(folder.file(), "key", 3).finished(), 0U);
  // Errors of what is derived come back beside them, and only together.
  table.derived = 1;
  table.std_error = {1, 2, 3, 0, 0, 0, 0, 0, 0, 4, 5, 6.5};
  save_replicates(folder.file(), "key", table);
  EXPECT_EQ(loaded(folder.file(), "key", 2, 1).std_error, table.std_error);
  EXPECT_EQ(loaded(folder.file(), "key", 2).finished(), 0U);
}

TEST(ReplicateTable, DamagedFilesAreNotTrusted) {
  const Folder folder;
  // One row is promised, and the bytes and their sum are right.
  const auto holding = [](const std::string& rows) {
    return fmt::format(R"({{"key": "key", "rows": 1, "bytes": {}, "sha256": "{}"}})"
                       "\n{}",
                       rows.size(), sha256_hex(rows), rows);
  };
  folder.write("replicates.json", holding("[0, [1], [1]]\n"));
  ASSERT_EQ(loaded(folder.file(), "key", 1).finished(), 1U);
  for (const std::string& text :
       {std::string(), std::string("{"), std::string("[1]"), std::string(R"({"key": "key"})"),
        std::string(R"({"key": "key", "rows": 1})"
                    "\n[0, [1], [1]]\n"),
        holding(""), holding("[0, [1], []]"), holding("[-1]"), holding("7"),
        holding("[99999999999]"), holding(R"([0, ["a"], [1]])"), holding("[0]\n[1]"),
        holding("[0, [1], [1]]\n[0, [1]"), holding("[0, [1], [1]]\n") + "\n",
        holding("[0, [1], [1]]\n").replace(holding("[0, [1], [1]]\n").size() - 4, 1, "2")}) {
    folder.write("replicates.json", text);
    EXPECT_EQ(loaded(folder.file(), "key", 1).finished(), 0U) << text;
  }
}

TEST(ReplicateTable, FilesAddUp) {
  const Folder folder;
  ReplicateTable table;
  table.slots = 1;
  table.grow(2);
  table.state[1] = ReplicateTable::State::usable;
  table.theta = {0, 4};
  table.std_error = {0, 5};
  ReplicateTable other;
  other.slots = 1;
  other.grow(3);
  other.state = {ReplicateTable::State::failed, ReplicateTable::State::not_run,
                 ReplicateTable::State::usable};
  other.theta = {0, 0, 6};
  other.std_error = {0, 0, 7};
  save_replicates(folder.file(), "key", other);
  load_replicates(folder.file(), "key", table);
  EXPECT_EQ(table.state, (std::vector<ReplicateTable::State>{ReplicateTable::State::failed,
                                                             ReplicateTable::State::usable,
                                                             ReplicateTable::State::usable}));
  EXPECT_EQ(table.theta, (std::vector<double>{0, 4, 6}));
  EXPECT_EQ(table.std_error, (std::vector<double>{0, 5, 7}));
}

TEST(Bootstrap, ShardsRunTheirOwnReplicatesAndNoOther) {
  const Case c = noisy_case();
  const Folder folder;
  UncertaintyOptions options = small(1);
  Bootstrap whole(c.fitted, {}, options);
  whole.extend(20);
  options.keep = folder.path() / "unfinished.jsonl";
  std::vector<fs::path> parts;
  for (std::size_t number = 1; number <= 3; ++number) {
    options.shard = {number, 3};
    Bootstrap own(c.fitted, {}, options);
    own.extend(20);
    EXPECT_EQ(own.table().finished(), number == 3 ? 6U : 7U);
    for (std::size_t i = 0; i < 20; ++i) {
      EXPECT_EQ(own.table().state[i] != ReplicateTable::State::not_run, i % 3 == number - 1) << i;
    }
    parts.push_back(folder.path() / std::to_string(number));
    save_replicates(parts.back(), own.key(), own.table());
  }
  UncertaintyOptions all = small(1);
  all.parts = parts;
  // A mark in one part shows that its replicates are taken over, not made anew.
  ReplicateTable marked = loaded(parts[1], key_of_bootstrap(c.fitted, options), 3);
  marked.theta[3 * 4] = 0.125;
  Bootstrap merged(c.fitted, {}, all);
  merged.extend(20);
  EXPECT_EQ(merged.result().theta, whole.result().theta);
  EXPECT_EQ(merged.result().std_error, whole.result().std_error);
  save_replicates(parts[1], key_of_bootstrap(c.fitted, options), marked);
  Bootstrap with_mark(c.fitted, {}, all);
  with_mark.extend(20);
  EXPECT_EQ(with_mark.result().theta[4][0], 0.125);
  EXPECT_EQ(with_mark.result().theta[5], whole.result().theta[5]);
}

TEST(Bootstrap, GoesOnFromFinishedReplicates) {
  const Case c = noisy_case();
  const Folder folder;
  UncertaintyOptions options = small(0);
  options.keep = folder.file();
  Bootstrap first(c.fitted, {}, options);
  first.extend(12);
  const BootstrapResult whole = first.result();
  // A quick run writes nothing by itself. Put a mark into a file of finished replicates: it shows
  // whether they are taken over or made anew.
  EXPECT_FALSE(fs::exists(folder.file()));
  ReplicateTable table;
  table.slots = 3;
  table.grow(5);
  for (std::size_t i = 0; i < 5; ++i) table.state[i] = ReplicateTable::State::usable;
  table.theta.assign(15, 0.125);
  save_replicates(folder.file(), first.key(), table);
  Bootstrap second(c.fitted, {}, options);
  second.extend(12);
  EXPECT_EQ(second.result().theta[4], std::vector<double>(3, 0.125));
  EXPECT_EQ(second.result().theta[5], whole.theta[5]);
  // Another seed, scheme, point or program is another bootstrap.
  UncertaintyOptions other = options;
  other.seed = 2;
  EXPECT_NE(Bootstrap(c.fitted, {}, other).key(), first.key());
  other = options;
  other.scheme = Scheme::wild;
  EXPECT_NE(Bootstrap(c.fitted, {}, other).key(), first.key());
  other = options;
  other.keep_key = "a later version";
  EXPECT_NE(Bootstrap(c.fitted, {}, other).key(), first.key());
  Case moved = c;
  moved.fitted.data.points[0].restitution += 1e-15;
  EXPECT_NE(Bootstrap(moved.fitted, {}, options).key(), first.key());
  // And so are other settings of the noise, which every replicate settles anew.
  const auto key_with = [&](const auto& change) {
    Case changed = c;
    change(changed.fitted.data);
    return Bootstrap(changed.fitted, {}, options).key();
  };
  for (const auto& key : {
           key_with([](Observations& data) { data.sd_stated = false; }),
           key_with([](Observations& data) { data.spec.variance = VarianceFunction::constant; }),
           key_with([](Observations& data) { data.spec.student = true; }),
           key_with([](Observations& data) { data.spec.velocity_relative_sd = 0.01; }),
           key_with([](Observations& data) { data.noise.variance = VarianceFunction::steep; }),
           key_with([](Observations& data) { data.points[0].velocity_sd = 0.01; }),
           key_with([](Observations& data) { data.points[0].events = 5; }),
       }) {
    EXPECT_NE(key, first.key());
  }
}

TEST(Failures, TheDisturbedPointIsFound) {
  // Claim that the replicates in which point 5 was drawn far up failed: it has to stand out.
  const Case c = noisy_case();
  const ResamplingPlan plan = plan_resampling(c.fitted, Scheme::parametric);
  std::vector<std::uint64_t> claimed;
  for (std::uint64_t r = 0; r < 999; ++r) {
    if (disturbance(plan, 3, r)[5] > 1.8) claimed.push_back(r);
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
