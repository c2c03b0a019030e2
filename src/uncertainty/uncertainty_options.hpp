#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "estimate/fit_spec.hpp"

namespace recoil {

class KeptRows;

struct PosteriorOptions {
  double level = 0.95;
  std::uint64_t seed = 20260101;
  int threads = 0;  ///< 0: all cores. Results do not depend on it.
  std::size_t chains = 4;
  std::size_t length = 1000;  ///< draws kept per chain
  /// Largest number of steps per chain in one round; the sampler then stops.
  int most_steps = 64000;
  double largest_r_hat = 1.01;   ///< largest R-hat of every quantity
  bool pointwise = true;         ///< keep the likelihood of every point, and leave points out
  double least_effective = 400;  ///< least effective draws of every quantity, in bulk and tails
};

struct UncertaintyOptions {
  int replicates = 1999;
  /// Add batches, from 999 to 19999 replicates, until the Monte-Carlo error of every percentile end
  /// and quoted capture end is below `wanted_error` times the width of its interval. `replicates`
  /// is then not used.
  bool replicates_auto = false;
  double wanted_error = 0.02;
  Scheme scheme = Scheme::automatic;
  double level = 0.95;
  std::uint64_t seed = 20260101;
  int threads = 0;            ///< 0: all cores. Results do not depend on it.
  bool posterior = false;     ///< sample the posterior
  PosteriorOptions sampling;  ///< options of the sampler; level, seed and threads are those above
  /// The finished replicates of an earlier run or of other processes, by index. They are not run
  /// again, and new ones are added. Null: none are kept.
  std::shared_ptr<KeptRows> kept;
};

/// The options of the sampler: `options.sampling` with the level, seed and threads of `options`.
inline PosteriorOptions sampling_options(const UncertaintyOptions& options) {
  PosteriorOptions sampling = options.sampling;
  sampling.level = options.level;
  sampling.seed = options.seed;
  sampling.threads = options.threads;
  return sampling;
}

}  // namespace recoil
