#pragma once

#include <optional>

#include "core/random.hpp"
#include "estimate/observation.hpp"
#include "estimate/student.hpp"

namespace recoil {

/// The captures among the impacts of a point with scatter, drawn anew by the binomial quantile of
/// `uniform` where the truth is `restitution_squared`, with the sd that a mean of this many
/// rebounds has; its mean is left to the caller.
Observation redraw_captures(const Observation& point, double restitution_squared, double uniform);

/// Of the error that a point has for itself: 0 for a bounce whose error `draw_setting_errors`
/// draws.
inline double own_noise_scale(const Observation& point, double noise_scale) {
  return point.launch == Observation::no_launch ? noise_scale : 0.0;
}

/// A point measured anew under the noise that weights it, where the truth is `restitution_squared`:
/// - a mean of rebounds gets an e^2 shifted by input_sd z_1 and a mean about its root by sd
///   `noise_scale` z_2 (Student's t in place of z_2 where `student` says so), not below 0;
/// - where impacts differ (scatter), the captures among its events are drawn from the binomial
///   distribution and the survivors' mean about its expectation, with the sd that this many have; a
///   point may so become captured altogether, or a captured one rebound;
/// - a captured point without scatter stays captured.
/// Draws three numbers from `random`, whatever happens. The weights of the result are those of
/// `point`; `renew_weights` renews them.
Observation simulate_observation(const Observation& point, double restitution_squared,
                                 double noise_scale, const std::optional<StudentNoise>& student,
                                 RandomStream& random);

}  // namespace recoil
