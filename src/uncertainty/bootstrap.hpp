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

/// Finds the data that made the replicates `index` fail: the points whose mean perturbation there
/// differs most, in standard errors, from that in the other replicates below `replicates`.
FailedReplicates locate_failures(const ResamplingPlan& plan, std::uint64_t seed, int replicates,
                                 std::vector<std::uint64_t> index);

/// One bootstrap of a fit, which can be extended. A replicate is a pure function of (seed, index):
/// the results do not depend on batches, threads or interruptions.
class Bootstrap {
 public:
  /// Prepares the scheme. `fitted` and `options` must outlive the object.
  /// @param capture the capture velocities to compute in every replicate
  Bootstrap(const FitResult& fitted, const std::vector<CaptureEstimate>& capture,
            const UncertaintyOptions& options);
  Bootstrap(const Bootstrap&) = delete;
  Bootstrap& operator=(const Bootstrap&) = delete;

  /// Runs the first `count` replicates, except those that ran before or that `options.kept`
  /// contains.
  void extend(int count);

  /// The replicates up to the count of the last `extend`, in order.
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
  /// One replicate: theta [slots], its standard errors [slots], and for every capture velocity its
  /// value [m/s] and the error of its logarithm; empty if the refit failed. Thread-safe.
  std::function<std::vector<double>(std::size_t index)> replicate_;
  std::vector<std::vector<double>> replicates_;
  std::size_t count_ = 0;
};

/// The numbers of a fit that determine its bootstrap, with all digits.
std::string digits_of(const FitResult& fitted);

/// The bootstrap of `fitted`: `options.replicates` replicates or, with `options.replicates_auto`,
/// as many as reduce the Monte-Carlo error of the interval ends to `options.wanted_error`.
/// @param capture from `capture_estimates`; every replicate also gets its capture velocities
BootstrapResult bootstrap(const FitResult& fitted, const std::vector<CaptureEstimate>& capture,
                          const UncertaintyOptions& options);

/// The largest number of replicates that `bootstrap` can run under these options.
std::size_t replicates_at_most(const UncertaintyOptions& options);

/// All replicates of a bootstrap (`replicates_at_most`) as pieces that processes can share.
/// `fitted` and `options` must outlive them.
Pieces bootstrap_pieces(const FitResult& fitted, const std::vector<CaptureEstimate>& capture,
                        const UncertaintyOptions& options);

/// The delete-one estimates [units][slots] for the acceleration of BCa: each omits one unit (a
/// point, or a series in the cluster scheme). The entry is empty if the refit fails.
std::vector<std::vector<double>> jackknife(const ResamplingPlan& plan, int threads);

}  // namespace recoil
