#pragma once

#include <cstdint>
#include <vector>

#include "estimate/model.hpp"

namespace recoil {

inline constexpr int guesses_drawn = 200;
/// A value that no fit has estimated is taken as known to this factor: the standard deviation of
/// its logarithm is that of the factor.
inline constexpr double guess_factor = 2.0;

/// What is known about the parameters before an experiment.
struct Guess {
  std::vector<double> theta;  ///< the likeliest values [slots]
  /// Covariance of the parameters that a fit has estimated [slots][slots]; variance 0: no fit has;
  /// empty: none of them.
  std::vector<std::vector<double>> covariance;
};

/// Values of theta that a guess allows: first the likeliest, then draws, in which the free
/// parameters are lognormal with the relative variance of the fit, or by `guess_factor`. Draws end
/// at the bounds; a 0 and what is not free do not move.
std::vector<std::vector<double>> drawn_values(const ImpactModel& model, const Guess& guess,
                                              std::uint64_t seed, int count = guesses_drawn);

}  // namespace recoil
