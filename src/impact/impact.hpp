#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/names.hpp"
#include "impact/adhesion_law.hpp"
#include "impact/groups.hpp"

namespace recoil {

/// The phase in which the adhesion damping acts. It always dissipates energy: with the sign printed
/// in Li, Dunn & Brach (1999), eq. 5, a positive C_A would supply energy and e could exceed 1.
/// `rebound` follows their text ("acts during the rebound phase").
enum class AdhesionDampingPhase { rebound, both };

constexpr auto names_of_values(AdhesionDampingPhase) { return name_list("rebound", "both"); }

/// The outcome of an impact. The last two have no result.
enum class ImpactOutcome { rebound, captured, integration_failure, step_limit };

constexpr auto names_of_values(ImpactOutcome) {
  return name_list("rebound", "captured", "integration failure", "step limit");
}

/// The energy budget of an impact in units of m V^2; the incident energy is 1/2.
struct EnergyBudget {
  double kinetic = 0.0;        ///< at the end: of the rebound, or 0 if captured
  double potential = 0.0;      ///< at the end: elastic minus adhesive; 0 after a release
  double hertz_loss = 0.0;     ///< dissipated by C_H
  double adhesion_loss = 0.0;  ///< dissipated by C_A
  double dashpot_loss = 0.0;   ///< dissipated by kappa
  double largest = 0.0;        ///< largest single energy during the impact

  /// 1/2 - (kinetic + potential + losses), divided by `largest`: the error of integration.
  double audit() const;
};

/// Indices in ImpactResult::gradient.
inline constexpr std::size_t place_of_kappa = 3, place_of_range = 4;

/// The result of one dimensionless impact.
///
/// `restitution_squared` is e^2 after a rebound. After a capture it is continued below zero, so
/// that a fit has gradients: it is 2 H / (m V^2), H the mechanical energy at the first outer
/// turning point. The continuation is C1 at the capture velocity, and at least twice the depth of
/// the adhesive well, which for the ring law is -(8/15) beta^(5/2) = -(8/15) (V / V_a)^-2. A
/// strongly damped sphere creeps into the well without an outer turning point and has this value.
struct ImpactResult {
  ImpactOutcome outcome = ImpactOutcome::integration_failure;
  double restitution_squared = 0.0;
  std::array<double, 5> gradient = {};  ///< d e^2 / d (alpha, beta, gamma, kappa, range)
  EnergyBudget energy;                  ///< if requested
  double contact_time = 0.0;            ///< until release or the outer turning point [n_c / V]
  double penetration_max = 0.0;         ///< [n_c]
  double force_compression = 0.0;       ///< largest push of the surface on the sphere [m V^2 / n_c]
  double force_tension = 0.0;           ///< largest pull, positive [m V^2 / n_c]
  long steps = 0;                       ///< of the integrator

  bool usable() const {
    return outcome == ImpactOutcome::rebound || outcome == ImpactOutcome::captured;
  }
};

/// The law, the quantities to compute and the tolerances.
struct ImpactOptions {
  AdhesionLaw adhesion = AdhesionLaw::ring;
  AdhesionDampingPhase phase = AdhesionDampingPhase::rebound;
  bool gradient = false;  ///< forward sensitivities
  bool budget = false;    ///< energy budget, contact time and peak forces
  bool dashpot = false;   ///< the law has a dashpot; otherwise kappa has to be 0
  /// The elastic force and the dashpot together never pull; they are 0 instead.
  bool never_pulls = false;
  double tolerance = 1e-11;       ///< relative, per step, of the reference
  long max_steps = 200000;        ///< of the reference
  double fast_tolerance = 1e-10;  ///< absolute error of q and u per step of the fast solver
};

/// One moment of a dimensionless impact. Positive forces push outward.
struct ImpactMoment {
  double time = 0.0;
  double penetration = 0.0;
  double approach = 0.0;  ///< u, positive into the surface
  double hertz = 0.0;
  double hertz_damping = 0.0;
  double adhesion = 0.0;
  double adhesion_damping = 0.0;
  double dashpot = 0.0;
};

/// Integrates one impact from first contact to release or to the first outer turning point.
///
/// Reference solver: SUNDIALS CVODES (Adams, variable order) with forward sensitivities, on the
/// field made polynomial by q = sqrt(x), dt = 2 q dsigma:
///   dq/dsigma = u,   du/dsigma = 2 q^2 [beta (1 + gamma S) - q^2 (1 + alpha u)].
/// The square roots of the force law make the right-hand side in (x, t) only Hoelder-1/2 at first
/// contact and release; in (q, sigma) the release is a transversal crossing of q = 0.
/// @param history gets every step of the integrator, unless it is null
ImpactResult simulate_impact(const ImpactGroups& groups, const ImpactOptions& options = {},
                             std::vector<ImpactMoment>* history = nullptr);

/// Computes e^2 and its gradient for several impacts per SIMD register. Solves the two phases as
/// integral equations (impact/phase_solver.hpp), or, if these do not converge, integrates the
/// regularised field by a method of fixed order (impact/step_solver.hpp). It is hundreds to
/// thousands of times faster than the reference, with the same results: tests/impact/
/// fast_solver_test.cpp compares e^2 to 1e-9 and the gradient to 1e-7 over a wide range, relative
/// to the depth of the adhesive well where that exceeds the incident energy.
///
/// If neither method is accurate (too many or too small steps), the reference solves the impact. An
/// impact has the same digits alone and among others, at any register width. No memory is
/// allocated.
/// @pre !options.budget, results.size() == groups.size()
/// @return the number of impacts solved by the reference
long simulate_impacts_fast(std::span<const ImpactGroups> groups, const ImpactOptions& options,
                           std::span<ImpactResult> results);

/// The same for one impact, which takes longer per impact than many at once.
ImpactResult simulate_impact_fast(const ImpactGroups& groups, const ImpactOptions& options);

/// The contact at the deepest point of an undamped impact, under jkr, dmt or maugis.
struct DeepestContact {
  struct Quantity {
    double value = 0.0;
    double by_beta = 0.0;   ///< derivative in the group beta
    double by_range = 0.0;  ///< in the group `range`
  };
  Quantity square;  ///< a^2 / (r n_c) [1]
  Quantity stored;  ///< elastic energy of the bodies, without that of the surfaces [m V^2]
};

/// @pre law is not the ring's
DeepestContact deepest_contact(AdhesionLaw law, double beta, double range);

}  // namespace recoil
