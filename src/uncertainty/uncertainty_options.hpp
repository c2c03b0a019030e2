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
  int threads = 0;  ///< 0: all cores. No digit depends on it.
  std::size_t chains = 4;
  std::size_t length = 1000;     ///< draws that are kept of every chain
  int most_steps = 64000;        ///< of a chain in one round, beyond which the sampler gives up
  double largest_r_hat = 1.01;   ///< of every quantity
  double least_effective = 400;  ///< draws of every quantity, in bulk and tails
};

struct UncertaintyOptions {
  int replicates = 1999;
  /// Add batches until every percentile and recommended end has a Monte-Carlo error below
  /// `wanted_error` of its interval's width, from 999 on and up to 19999. `replicates` is not used.
  bool replicates_auto = false;
  double wanted_error = 0.02;
  Scheme scheme = Scheme::automatic;
  double level = 0.95;
  std::uint64_t seed = 20260101;
  int threads = 0;            ///< 0: all cores. No digit depends on it.
  bool posterior = false;     ///< sample it
  PosteriorOptions sampling;  ///< how; level, seed and threads are those above
  /// The finished replicates of an earlier run or of other processes, by their index. They are not
  /// run again, and new ones are put there. Null: none are kept.
  std::shared_ptr<KeptRows> kept;
};

/// How to sample the posterior: `options.sampling` with the level, seed and threads of `options`.
inline PosteriorOptions sampling_options(const UncertaintyOptions& options) {
  PosteriorOptions sampling = options.sampling;
  sampling.level = options.level;
  sampling.seed = options.seed;
  sampling.threads = options.threads;
  return sampling;
}

}  // namespace recoil
