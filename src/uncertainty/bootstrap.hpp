#pragma once

#include "uncertainty/replicate_table.hpp"
#include "uncertainty/resample.hpp"
#include "uncertainty/uncertainty.hpp"

namespace recoil {

/// How replicates are refitted: they start at the estimate and need no more digits than their own
/// scatter has.
LeastSquaresOptions refit_options();

/// The refit of a sample from `start`, together with the weights that depend on it
/// (`reweighted_fit`).
LeastSquaresResult refit(const ImpactModel& model, const Observations& sample,
                         std::span<const double> start);

/// Did a refit give an answer? It has to converge, and its data have to determine the parameters
/// (J'J regular) where those of the fit do: where they do not, it merely stays where it started.
bool has_answer(const LeastSquaresResult& refit, const FitResult& fitted);

/// One bootstrap of a fit, which can be extended. A replicate is a pure function of (seed, index):
/// how many batches or threads make it, and whether the run was stopped in between, changes
/// nothing.
class Bootstrap {
 public:
  /// Prepares the scheme and takes over what an earlier run of the same bootstrap has left in
  /// `options.keep`. Fit, data and options have to outlive the object.
  Bootstrap(const FitResult& fitted, const std::vector<CaptureEstimate>& capture,
            const UncertaintyOptions& options);

  /// Runs what is missing of the first `count` replicates.
  /// @throws Interrupted when the user stops it and `options.keep` says where to keep the finished
  ///   ones; they are there then.
  void extend(int count);

  /// The first replicates, as many as the last `extend` asked for, in order.
  BootstrapResult result() const;

  const ResamplingPlan& plan() const { return plan_; }

  /// Of everything that decides a replicate's digits; empty without `options.keep`.
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

/// Runs the paper's two-point iteration on the same resampled data as the replicates of `result`
/// (the first 999 of them), and adds what came out of it.
void bootstrap_two_point(const ResamplingPlan& plan, const std::vector<TwoPointResult>& two_point,
                         const UncertaintyOptions& options, BootstrapResult& result);

/// All of it in one call: `options.replicates` replicates, and the two-point iteration on them.
BootstrapResult bootstrap(const FitResult& fitted, const std::vector<CaptureEstimate>& capture,
                          const std::vector<TwoPointResult>& two_point,
                          const UncertaintyOptions& options);

/// The estimates of all data sets from which one unit (a point, or a series in the cluster scheme)
/// is left out [units][slots], for the acceleration of BCa. A set whose refit fails gives an empty
/// entry.
std::vector<std::vector<double>> jackknife(const ResamplingPlan& plan, int threads);

/// Finds out which data made the replicates of `index` fail: the points whose mean disturbance in
/// them is furthest, in its standard errors, from that in the other replicates below `replicates`.
FailedReplicates locate_failures(const ResamplingPlan& plan, std::uint64_t seed, int replicates,
                                 std::vector<std::uint64_t> index);

}  // namespace recoil
