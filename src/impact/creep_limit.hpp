#pragma once

#include <array>
#include <cmath>
#include <tuple>

#include "impact/force_law.hpp"

namespace recoil {

/// Finds spheres that creep into the well of `Law`, without an outer turning point. Let k = c(n_0)
/// / 2, n_0 the place of rest and c the damping. Where the push F is at most k (c(n) - k) (n -
/// n_0), a sphere of the speed k (n - n_0) slows down faster than this limit falls, so that one
/// that is slower stays so and never passes n_0. Beyond n_0, F / (n - n_0) and c grow, so that
/// values at a few places prove this for all. A dashpot (see WithDashpot) damps further, and is not
/// counted.
///
/// All functions are always inline, because kernels for different instruction sets must not share
/// them.
template <class Law>
class CreepLimit {
 public:
  CreepLimit() = default;
  [[gnu::always_inline]] CreepLimit(const ImpactGroups& impact, const LawPath& path)
      : groups_(Law::groups_of(impact)),
        constants_(Law::constants_of(impact)),
        resting_(path.resting) {
    if constexpr (Law::constants > 0) constants_.back() = 0.0;  // in contact, see LawPath::seam
    const PlainForces resting = forces(path.resting, 1.0);
    damping_ = -(resting.hertz_damping + resting.adhesion_damping);
    rest_ = penetration(path.resting);
    // The law with the softest well is JKR.
    possible_ = damping_ * damping_ >= 3.6 * __builtin_sqrt(impact.beta);
  }

  /// @param q a place on the way out
  /// @param speed outward
  [[gnu::always_inline]] bool is_certain(double q, double speed) const {
    const double k = 0.5 * damping_;
    if (!possible_ || speed > k * (penetration(q) - rest_)) return false;
    constexpr int places = 8;
    double damping = damping_;
    for (int i = 1; i <= places; ++i) {
      const double place = resting_ + (q - resting_) * (i * i) / (places * places);
      const PlainForces there = forces(place, 1.0);
      const double push = -(there.hertz + there.adhesion);
      if (!(push <= k * (damping - k) * (penetration(place) - rest_))) return false;
      damping = -(there.hertz_damping + there.adhesion_damping);
    }
    return true;
  }

 private:
  [[gnu::always_inline]] PlainForces forces(double q, double u) const {
    return std::apply(
        [](auto... all) __attribute__((always_inline)) { return Law::forces(all...); },
        std::tuple_cat(std::tuple(q, u, 1.0), groups_, constants_));
  }
  [[gnu::always_inline]] double penetration(double q) const {
    return std::apply(
        [](auto... all) __attribute__((always_inline)) { return Law::penetration(all...); },
        std::tuple_cat(std::tuple(q), groups_, constants_));
  }

  std::array<double, Law::groups> groups_ = {};
  std::array<double, Law::constants> constants_ = {};
  double resting_ = 0.0;               // q
  double damping_ = 0.0, rest_ = 0.0;  // c(n_0) and n_0
  bool possible_ = false;
};

}  // namespace recoil
