#pragma once

#include <string>
#include <vector>

#include "estimate/fit.hpp"
#include "uncertainty/bootstrap_result.hpp"
#include "uncertainty/capture_estimate.hpp"
#include "uncertainty/replicate_table.hpp"
#include "uncertainty/resample.hpp"
#include "uncertainty/uncertainty_options.hpp"

namespace recoil {

/// One bootstrap of a fit, which can be extended. A replicate is a pure function of (seed, index):
/// how many batches or threads make it, and whether the run was stopped in between, changes
/// nothing.
class Bootstrap {
 public:
  /// Prepares the scheme and takes over what an earlier run of the same bootstrap has left in
  /// `options.keep`, and shards of it in `options.parts`. Fit, data and options have to outlive the
  /// object.
  Bootstrap(const FitResult& fitted, const std::vector<CaptureEstimate>& capture,
            const UncertaintyOptions& options);

  /// Runs what is missing of the first `count` replicates, and of `options.shard`'s.
  /// @throws Interrupted when the user stops it and `options.keep` says where to keep the finished
  ///   ones; they are there then.
  void extend(int count);

  /// The first replicates, as many as the last `extend` asked for, in order.
  /// @pre the shard is the only one
  BootstrapResult result() const;

  const ReplicateTable& table() const { return table_; }

  const ResamplingPlan& plan() const { return plan_; }

  /// Of everything that decides a replicate's digits; empty without `options.keep` and `parts`.
  const std::string& key() const { return key_; }

 private:
  void keep() const;

  const FitResult& fitted_;
  std::vector<CaptureEstimate> capture_;
  const UncertaintyOptions& options_;
  ResamplingPlan plan_;
  std::vector<double> reference_covariance_;
  std::string key_;
  ReplicateTable table_;
  std::size_t count_ = 0;
  std::vector<std::vector<double>> capture_velocity_;  // [count][diameters]
};

/// The key of the bootstrap of `fitted` (`Bootstrap::key`).
std::string key_of_bootstrap(const FitResult& fitted, const UncertaintyOptions& options);

/// The bootstrap of `fitted`: `options.replicates` replicates or, with `options.replicates_auto`,
/// as many as bring the Monte-Carlo error of the intervals' ends down to `options.wanted_error`.
/// @param capture of `capture_estimates`: every replicate gets its capture velocities, too
BootstrapResult bootstrap(const FitResult& fitted, const std::vector<CaptureEstimate>& capture,
                          const UncertaintyOptions& options);

/// The largest number of replicates that `bootstrap` can run under these options.
std::size_t replicates_at_most(const UncertaintyOptions& options);

/// The replicates of `options.shard` among `replicates_at_most`.
/// @throws Interrupted as `Bootstrap::extend` does
ReplicateTable shard_of_bootstrap(const FitResult& fitted,
                                  const std::vector<CaptureEstimate>& capture,
                                  const UncertaintyOptions& options);

/// The estimates of all data sets from which one unit (a point, or a series in the cluster scheme)
/// is left out [units][slots], for the acceleration of BCa. A set whose refit fails gives an empty
/// entry.
std::vector<std::vector<double>> jackknife(const ResamplingPlan& plan, int threads);

}  // namespace recoil
