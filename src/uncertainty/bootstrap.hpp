#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/resumable.hpp"
#include "estimate/fit.hpp"
#include "uncertainty/bootstrap_result.hpp"
#include "uncertainty/capture_estimate.hpp"
#include "uncertainty/resample.hpp"
#include "uncertainty/uncertainty_options.hpp"

namespace recoil {

/// Finds out which data made the replicates of `index` fail: the points whose mean disturbance in
/// them is furthest, in its standard errors, from that in the other replicates below `replicates`.
FailedReplicates locate_failures(const ResamplingPlan& plan, std::uint64_t seed, int replicates,
                                 std::vector<std::uint64_t> index);

/// One bootstrap of a fit, which can be extended. A replicate is a pure function of (seed, index):
/// the number of batches, threads and interruptions changes no digit.
class Bootstrap {
 public:
  /// Prepares the scheme. `fitted` and `options` have to outlive the object.
  /// @param capture the capture velocities that every replicate finds, too
  Bootstrap(const FitResult& fitted, const std::vector<CaptureEstimate>& capture,
            const UncertaintyOptions& options);
  Bootstrap(const Bootstrap&) = delete;
  Bootstrap& operator=(const Bootstrap&) = delete;

  /// Runs the first `count` replicates, without those that ran before or that `options.kept` has.
  void extend(int count);

  /// The first replicates, as many as the last `extend` asked for, in order.
  BootstrapResult result() const;

  /// Replicate `index` as a row of `options.kept`. May be called from any thread.
  Json row(std::size_t index) const;

  const ResamplingPlan& plan() const { return plan_; }

 private:
  const FitResult& fitted_;
  std::vector<CaptureEstimate> capture_;
  const UncertaintyOptions& options_;
  ResamplingPlan plan_;
  std::vector<double> reference_covariance_;
  /// One replicate: theta [slots], its standard errors [slots], and of every capture velocity the
  /// value [m/s] and the error of its logarithm; empty if the refit failed. Called from any thread.
  std::function<std::vector<double>(std::size_t index)> replicate_;
  std::vector<std::vector<double>> replicates_;
  std::size_t count_ = 0;
};

/// Every digit of a fit that decides a digit of its bootstrap.
std::string digits_of(const FitResult& fitted);

/// The bootstrap of `fitted`: `options.replicates` replicates or, with `options.replicates_auto`,
/// as many as bring the Monte-Carlo error of the intervals' ends down to `options.wanted_error`.
/// @param capture of `capture_estimates`: every replicate gets its capture velocities, too
BootstrapResult bootstrap(const FitResult& fitted, const std::vector<CaptureEstimate>& capture,
                          const UncertaintyOptions& options);

/// The largest number of replicates that `bootstrap` can run under these options.
std::size_t replicates_at_most(const UncertaintyOptions& options);

/// All replicates of a bootstrap (`replicates_at_most`) as pieces that processes can share.
/// `fitted` and `options` have to outlive them.
Pieces bootstrap_pieces(const FitResult& fitted, const std::vector<CaptureEstimate>& capture,
                        const UncertaintyOptions& options);

/// The estimates of all data sets from which one unit (a point, or a series in the cluster scheme)
/// is left out [units][slots], for the acceleration of BCa. A set whose refit fails gives an empty
/// entry.
std::vector<std::vector<double>> jackknife(const ResamplingPlan& plan, int threads);

}  // namespace recoil
