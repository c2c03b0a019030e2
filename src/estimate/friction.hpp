#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "data/dataset.hpp"

namespace recoil {

/// The coefficient of friction mu between the spheres and the surface of a dataset, from its points
/// with a tangential restitution e_t = V_t,rebound / V_t.
///
/// A rigid sphere without spin hits the surface. Its normal impulse is m (1 + e) V_n. While the
/// contact slides, the tangential impulse is mu times that, and both together give
///   e_t = 1 - mu (1 + e) V_n / V_t,   V_n / V_t = 1 / tan(incidence_angle).
/// The friction spins a solid sphere (2 m r^2 / 5) until it rolls, which needs 2/7 of m V_t:
///   e_t = 5/7   where   mu (1 + e) V_n / V_t > 2/7.
/// (Impulse and momentum of a rigid ball with Coulomb friction: Cross 2002, Am. J. Phys. 70,
/// 1093-1102. Alumina spheres on glass slide as in the first equation beyond 30 degrees from the
/// normal: Kharaz, Gorham & Salman 2001, Powder Technol. 120, 281-291.)
///
/// mu minimises S = sum (e_t - e_t(mu))^2 over both branches, with equal weights. The interval is
/// the range of mu with S <= S_min (1 + t^2 / (n - 1)), where t is the quantile of Student's t with
/// n - 1 degrees of freedom. If all n points slide, this is mu +/- t times its standard error. If
/// it reaches to the mu at which all points roll, it has no upper end: only a lower limit is known.
struct Friction {
  std::optional<double> mu;                       ///< [1]; nullopt: only `least` is known
  std::optional<std::array<double, 2>> interval;  ///< 95 %; nullopt: no mu, or one point
  std::optional<double> least;  ///< lower limit of mu, where all points may roll [1]
  std::size_t points = 0;       ///< with e and e_t
  std::size_t sliding = 0;      ///< those that slide throughout at the best mu; the others roll
};

/// nullopt if no point has a tangential restitution and an e.
std::optional<Friction> fit_friction(const Dataset& dataset);

}  // namespace recoil
