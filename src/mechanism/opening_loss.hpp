#pragma once

#include <array>
#include <cstddef>

#include "mechanism/encounter.hpp"

namespace recoil {

/// The groups of an impact under the ring law in which the opening of the contact takes a work per
/// area. With x = n / n_c, energies in m V^2, and the dampings of `ImpactGroups`:
///   in:  d(energy) = (alpha x^(3/2) + kappa x^(1/2)) u dx
///   out: the same, and beta gamma x^(1/2) u dx + strength (u x^(-1/2))^exponent dx.
struct OpeningGroups {
  static constexpr std::size_t count = 7;

  double alpha = 0.0, beta = 0.0, gamma = 0.0, kappa = 0.0;
  /// pi R w n_c / (m V^2) times (crack velocity / u x^(-1/2))^exponent, w at a crack velocity of 1.
  double strength = 0.0;
  double exponent = 0.0;
  double returned = 0.0;  ///< (v / V)^2 on the way out without the opening
};

struct OpeningLoss {
  double square = 0.0;                                   ///< loss of (v / V)^2 by the opening
  std::array<double, OpeningGroups::count> slopes = {};  ///< in the groups, in their order
};

/// The loss by the opening of the contact. Opening and dampings depend on the speed, which they
/// reduce. The other losses follow from `returned`, and are distributed evenly over the way out.
/// Solved by Radau IIA (order 5) from the deepest point. The error of e^2 is below 2e-5 for crack
/// factors of 0.05 to 2 (compared with DOP853).
/// @param damps_both gamma acts on the way in, too
/// @param slopes computes the slopes, which are zero otherwise
OpeningLoss opening_loss(const OpeningGroups& groups, bool damps_both, bool slopes = true);

/// The energy [J] lost by the opening of a contact under the ring law, with a work of separation of
/// w v_c^k [J/m2] in addition to that of the base model, v_c = |a'| in m/s.
template <class T>
T opening_energy(const Encounter<T>& e, const T& work, const T& exponent) {
  const T speed = e.velocity;
  const T energy = e.mass() * speed * speed;
  const T scale = e.scale();
  const T crack = 0.5 * speed * sqrt(e.contact_radius / scale);  // v_c at u = 1, x = 1
  const T strength = work * e.contact_radius * scale / energy * std::numbers::pi *
                     exponential(exponent * logarithm(crack));
  const std::array<T, OpeningGroups::count> groups = {e.hertz_damping * speed,
                                                      e.beta(),
                                                      e.adhesion_damping * speed,
                                                      1.5 * e.relaxation * speed / scale,
                                                      strength,
                                                      exponent,
                                                      e.square / (speed * speed)};
  const OpeningLoss loss = opening_loss(
      {value_of(groups[0]), value_of(groups[1]), value_of(groups[2]), value_of(groups[3]),
       value_of(groups[4]), value_of(groups[5]), value_of(groups[6])},
      e.at->phase == AdhesionDampingPhase::both, !std::is_same_v<T, double>);
  T square(loss.square);
  for (std::size_t k = 0; k < OpeningGroups::count; ++k) {
    add_slopes(square, loss.slopes[k], groups[k]);
  }
  return 0.5 * energy * square;
}

}  // namespace recoil
