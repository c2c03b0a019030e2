#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "core/names.hpp"
#include "impact/adhesion_law.hpp"
#include "impact/groups.hpp"

namespace recoil {

/// When the adhesion damping acts; it always takes energy out.
/// Printed with the sign of Li, Dunn & Brach (1999) eq. 5, a positive C_A would feed energy in and
/// e could exceed 1; `rebound` is their words ("acts during the rebound phase").
enum class AdhesionDampingPhase { rebound, both };

template <>
struct NamesOf<AdhesionDampingPhase> {
  static constexpr std::array<std::string_view, 2> names = {"rebound", "both"};
};

/// How an impact ended. The last two carry no answer and are never turned into numbers.
enum class ImpactOutcome { rebound, captured, integration_failure, step_limit };

template <>
struct NamesOf<ImpactOutcome> {
  static constexpr std::array<std::string_view, 4> names = {"rebound", "captured",
                                                            "integration failure", "step limit"};
};

/// Where the incident kinetic energy went, in units of m V^2 (so it starts with 1/2).
struct EnergyBudget {
  double kinetic = 0.0;        ///< at the end: of the rebound, or 0 when captured
  double potential = 0.0;      ///< at the end: Hertz minus adhesion; 0 after a release
  double hertz_loss = 0.0;     ///< taken by C_H
  double adhesion_loss = 0.0;  ///< taken by C_A
  double dashpot_loss = 0.0;   ///< taken by kappa
  double largest = 0.0;        ///< largest single energy on the way, the yardstick of the audit

  /// 1/2 - (kinetic + potential + losses), relative to `largest`: zero but for integration error.
  double audit() const;
};

/// Places in ImpactResult::gradient.
inline constexpr std::size_t place_of_kappa = 3, place_of_range = 4;

/// The result of one dimensionless impact.
///
/// `restitution_squared` is e^2 after a rebound (the text speaks of the ring law; under the others
/// the depth of the well is that of their struct). After a capture it is continued below
/// zero as 2 H / (m V^2), H = mechanical energy at the first outer turning point: C1 across the
/// capture velocity, never below the depth of the adhesive well, -(8/15) beta^(5/2) = -(8/15) (V /
/// V_a)^-2, so that a fit has gradients there. A sphere so strongly damped that it creeps into the
/// well without turning once more has no outer turning point; it ends on that floor.
struct ImpactResult {
  ImpactOutcome outcome = ImpactOutcome::integration_failure;
  double restitution_squared = 0.0;
  std::array<double, 5> gradient = {};  ///< d e^2 / d (alpha, beta, gamma, kappa, range)
  EnergyBudget energy;                  ///< when asked for
  double contact_time = 0.0;            ///< until release or the outer turning point [n_c / V]
  double penetration_max = 0.0;         ///< [n_c]
  double force_compression = 0.0;       ///< largest push of the surface on the sphere [m V^2 / n_c]
  double force_tension = 0.0;           ///< largest pull, positive [m V^2 / n_c]
  long steps = 0;                       ///< of the integrator

  bool usable() const {
    return outcome == ImpactOutcome::rebound || outcome == ImpactOutcome::captured;
  }
};

/// What to compute and how exactly.
struct ImpactOptions {
  AdhesionLaw adhesion = AdhesionLaw::ring;
  AdhesionDampingPhase phase = AdhesionDampingPhase::rebound;
  bool gradient = false;          ///< forward sensitivities
  bool budget = false;            ///< energy budget, contact time and peak forces
  bool dashpot = false;           ///< the law with kappa; without, kappa has to be 0
  double tolerance = 1e-11;       ///< relative, per step, of the reference
  long max_steps = 200000;        ///< of the reference
  double fast_tolerance = 1e-10;  ///< absolute error of q and u per step of the fast solver
};

/// One moment of an impact, dimensionless as above; forces are signed, positive pushes outward.
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

/// Integrates one impact from touch to release or to the first outer turning point.
///
/// Reference solver: SUNDIALS CVODES (Adams, variable order) with forward sensitivities, on the
/// field made polynomial by q = sqrt(x), dt = 2 q dsigma:
///   dq/dsigma = u,   du/dsigma = 2 q^2 [beta (1 + gamma S) - q^2 (1 + alpha u)].
/// The square roots of the force law make the right-hand side in (x, t) only Hoelder-1/2 at touch
/// and release; in (q, sigma) the release is a transversal crossing of q = 0.
/// @param history when not null, receives every step of the integrator.
ImpactResult simulate_impact(const ImpactGroups& groups, const ImpactOptions& options = {},
                             std::vector<ImpactMoment>* history = nullptr);

/// e^2 and its gradient, several impacts per SIMD register: the two phases as integral equations
/// (impact/phase_solver.hpp), or where these do not converge by a method of fixed order on the
/// regularised field (impact/step_solver.hpp). Hundreds to thousands of times faster than the
/// reference, and never a different answer. Certified against the reference over a wide box, see
/// tests/impact/fast_solver_test.cpp: e^2 to 1e-9, gradient to 1e-7.
///
/// Where neither can hold its accuracy (too many or too small steps) the reference answers
/// instead, and is counted. The same digits come out for an impact alone or among others, at any
/// register width. No memory is allocated.
/// `options.budget` is not supported here. @pre !options.budget, results.size() == groups.size()
/// @return how many impacts were handed over
long simulate_impacts_fast(std::span<const ImpactGroups> groups, const ImpactOptions& options,
                           std::span<ImpactResult> results);

/// The same for one impact. Many at once cost a fraction of this each.
ImpactResult simulate_impact_fast(const ImpactGroups& groups, const ImpactOptions& options);

/// How many impacts of this process were handed over to the reference so far.
long reference_handovers();

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
