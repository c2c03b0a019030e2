#pragma once

#include <cstddef>
#include <cstdint>

namespace recoil {

struct PosteriorOptions {
  double level = 0.95;
  std::uint64_t seed = 20260101;
  int threads = 0;                ///< 0: all cores. No digit depends on it.
  int ensembles = 4;              ///< independent of one another
  int fewest_steps = 1000;        ///< kept of every walker, after as many that are dropped
  int most_steps = 8000;          ///< beyond it the sampler gives up
  double largest_r_hat = 1.01;    ///< of every quantity
  double least_effective = 1000;  ///< draws of every quantity
  std::size_t kept = 2000;        ///< joint draws that are handed on
};

}  // namespace recoil
