#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "core/names.hpp"

namespace recoil {

/// When the adhesion damping acts; it always takes energy out.
/// Printed with the sign of Li, Dunn & Brach (1999) eq. 5, a positive C_A would feed energy in and
/// e could exceed 1; `rebound` is their words ("acts during the rebound phase").
enum class AdhesionDampingPhase { rebound, both };

template <>
struct NamesOf<AdhesionDampingPhase> {
  static constexpr std::array<std::string_view, 2> names = {"rebound", "both"};
};

/// What holds sphere and surface together; the elastic part is Hertz's or, in JKR, its own.
enum class AdhesionLaw {
  ring,  ///< the paper's: a force 2 pi a f0 along the edge of the contact (RingAdhesionLaw)
  jkr,   ///< JkrLaw
  dmt    ///< DmtLaw
};

template <>
struct NamesOf<AdhesionLaw> {
  static constexpr std::array<std::string_view, 3> names = {"ring", "jkr", "dmt"};
};

/// One sphere about to hit one surface, in SI units.
struct ImpactConditions {
  double diameter = 0.0;          ///< [m]
  double velocity = 0.0;          ///< incident V [m/s], > 0
  double density = 0.0;           ///< of the sphere [kg/m3]
  double stiffness = 0.0;         ///< K [Pa]
  double adhesion_force = 0.0;    ///< f0 at this diameter [N/m], >= 0
  double hertz_damping = 0.0;     ///< C_H [s/m], >= 0
  double adhesion_damping = 0.0;  ///< C_A [s/m], >= 0
};

/// The three dimensionless groups on which e depends, and nothing else. With A = sqrt(r) K / m and
/// B = 2 pi sqrt(r) f0 / m, lengths in n_c = (V^2 / A)^(2/5) and velocities in V, the equation of
/// motion (eq. 5) becomes
///   x'' = -x^(3/2) (1 + alpha u) + beta x^(1/2) (1 + gamma S),
/// S = -u while the damping of the adhesion acts and 0 otherwise. A mechanism may add a dashpot
/// that works along the contact radius in both phases, -kappa x^(1/2) u (see BulkDashpotLaw).
struct ImpactGroups {
  double alpha = 0.0;  ///< C_H V
  double beta = 0.0;   ///< B A^(-3/5) V^(-4/5) = (V / V_a)^(-4/5)
  double gamma = 0.0;  ///< C_A V
  double kappa = 0.0;  ///< of the dashpot; other than 0 only with ImpactOptions::dashpot
};

/// The scales that turn the dimensionless impact back into SI units.
struct ImpactScales {
  double length = 0.0;    ///< n_c [m]
  double velocity = 0.0;  ///< V [m/s]
  double time = 0.0;      ///< n_c / V [s]
  double force = 0.0;     ///< m V^2 / n_c [N]
  double energy = 0.0;    ///< m V^2 [J]
};

ImpactGroups impact_groups(const ImpactConditions& conditions);
ImpactScales impact_scales(const ImpactConditions& conditions);

/// The velocity at which adhesion and inertia balance, V_a = B^(5/4) A^(-3/4) [m/s];
/// beta = (V / V_a)^(-4/5). Zero without adhesion.
double adhesion_velocity(const ImpactConditions& conditions);

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

/// The result of one dimensionless impact.
///
/// `restitution_squared` is e^2 after a rebound (the text speaks of the ring law; under the others
/// the depth of the well is JkrLaw::depth or DmtLaw::depth). After a capture it is continued below
/// zero as 2 H / (m V^2), H = mechanical energy at the first outer turning point: C1 across the
/// capture velocity, never below the depth of the adhesive well, -(8/15) beta^(5/2) = -(8/15) (V /
/// V_a)^-2, so that a fit has gradients there. A sphere so strongly damped that it creeps into the
/// well without turning once more has no outer turning point; it ends on that floor.
struct ImpactResult {
  ImpactOutcome outcome = ImpactOutcome::integration_failure;
  double restitution_squared = 0.0;
  std::array<double, 4> gradient = {};  ///< d e^2 / d (alpha, beta, gamma, kappa)
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
  bool dashpot = false;           ///< the ring law with kappa; without, kappa has to be 0
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

}  // namespace recoil
