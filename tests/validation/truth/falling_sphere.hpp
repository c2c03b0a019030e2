#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/random.hpp"
#include "core/units.hpp"

namespace recoil {

/// One passage through the measuring plane, as an instrument writes it.
struct Crossing {
  double time = 0.0;        ///< [s]
  double velocity = 0.0;    ///< down positive [m/s]
  double tangential = 0.0;  ///< [m/s]
  double diameter = 0.0;    ///< [m]
};

/// What the instrument sees of a sphere, and how the sphere falls.
struct Instrument {
  double height = 0.0;       ///< of the measuring plane above the surface [m]
  double least_climb = 0.0;  ///< a rebound that climbs less far is not seen [m]
  double volume_sd = 0.0;    ///< of the height at which a passage is timed [m]
  double velocity_sd = 0.0;  ///< of one passage, relative [1]
  double diameter_sd = 0.0;  ///< of one passage, relative [1]
  double angle_sd = 0.0;     ///< of the fall to the normal [rad]
  double seen_down = 1.0;    ///< share of passages down that are written [1]
  double seen_up = 1.0;
  double return_time = 0.0;  ///< a rebound comes back through the volume with exp(-t / this) [s]
};

/// One impact of a falling sphere, and its passages as far as they were seen.
struct FallenImpact {
  int number = 1;
  double speed = 0.0;    ///< at the surface, before and after [m/s]
  double rebound = 0.0;  ///< 0: captured
  bool climbs = false;   ///< high enough to be seen
  std::optional<Crossing> down, up;
};

/// Follows a sphere that hits the surface at the time `hits` [s] with `speed` [m/s], and again
/// while it comes back. It comes without spin and leaves rolling, v_t' = v_t / (1 + I / (m r^2))
/// with I = (2/5) m r^2 (Cross 2002, Am. J. Phys. 70, 1093-1102); friction is enough for that near
/// the normal: mu > (2/7) tan(theta) / (1 + e).
/// @param restitution e for a speed; may draw from `random`
/// @param visit called with every impact
template <class Restitution, class Visit>
void follow_sphere(const Instrument& at, double diameter, double hits, double speed,
                   RandomStream& random, const Restitution& restitution, const Visit& visit) {
  constexpr double g = standard_gravity;
  constexpr double rolling = 5.0 / 7.0;
  double sideways = speed * std::tan(at.angle_sd * random.normal());
  const auto pass = [&](double from, bool down) -> std::optional<Crossing> {
    const double height = at.height + at.volume_sd * random.normal();
    const double plane = std::sqrt(std::max(from * from - 2.0 * g * height, 0.0));
    const double velocity = plane * (1.0 + at.velocity_sd * random.normal());
    const double size = diameter * (1.0 + at.diameter_sd * random.normal());
    const double seen = down ? at.seen_down : at.seen_up;
    if (random.uniform() > seen || !(velocity > 1e-4)) return std::nullopt;
    const double apart = (from - plane) / g;
    return Crossing{down ? hits - apart : hits + apart, down ? velocity : -velocity, sideways,
                    size};
  };
  for (int number = 1; number < 50; ++number) {
    FallenImpact impact{number, speed, 0.0, false, pass(speed, true), std::nullopt};
    impact.rebound = speed * restitution(speed);
    if (number == 1) sideways *= rolling;  // a sphere that rolls already keeps all
    const double square = impact.rebound * impact.rebound;
    impact.climbs = square > 2.0 * g * at.least_climb;
    bool comes_back = false;
    if (impact.climbs) {
      impact.up = pass(impact.rebound, false);
      const double above = 2.0 / g * std::sqrt(square - 2.0 * g * at.height);
      comes_back = random.uniform() <= std::exp(-above / at.return_time);
    }
    visit(impact);
    if (!comes_back) return;
    hits += 2.0 * impact.rebound / g;
    speed = impact.rebound;
  }
}

}  // namespace recoil
