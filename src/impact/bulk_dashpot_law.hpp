#pragma once

#include <array>

#include "impact/force_law.hpp"

namespace recoil {

/// The ring-adhesion law with a dashpot that works along the contact radius in both phases:
///   x'' = -x^(3/2) (1 + alpha u) + beta x^(1/2) (1 + gamma S) - kappa x^(1/2) u.
/// Two mechanisms have exactly this form. A viscoelastic bulk (Kuwabara & Kono 1987; Brilliantov et
/// al. 1996): the force -(3/2) A K sqrt(r n) n' gives kappa = (3/2) A V / n_c. A thin plate that
/// yields with the velocity F / Z (Zener 1941): n'' = -F / m - F' / Z with F = K sqrt(r) n^(3/2)
/// gives kappa = (3/2) m V / (Z n_c).
struct BulkDashpotLaw {
  static constexpr unsigned groups = 4;  ///< alpha, beta, gamma, kappa
  static constexpr double start = 0.0;
  static constexpr double tolerance_share = 1.0;  ///< of the fast solver, per step

  static double strength_slope(const ImpactGroups&) { return 1.0; }

  static std::array<double, groups> groups_of(const ImpactGroups& g) {
    return {g.alpha, g.beta, g.gamma, g.kappa};
  }
  template <class Q, class U, class Alpha, class Beta, class Gamma, class Kappa, class Acts>
  static constexpr auto acceleration(const Q& q, const U& u, const Acts& acts, const Alpha& alpha,
                                     const Beta& beta, const Gamma& gamma, const Kappa& kappa) {
    return regularised_acceleration(q, u, alpha, beta, gamma, acts) +
           dashpot_acceleration(q, u, kappa);
  }
  template <class Q, class Alpha, class Beta, class Gamma, class Kappa>
  static constexpr auto potential(const Q& q, const Alpha&, const Beta& beta, const Gamma&,
                                  const Kappa&) {
    return potential_energy(q, beta);
  }
  static double resting_place(const ImpactGroups& g) { return RingAdhesionLaw::resting_place(g); }
};

}  // namespace recoil
