#include "impact/reference_solver.hpp"

#include <ceres/jet.h>
#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <sundials/sundials_context.hpp>

#include "impact/dmt_law.hpp"
#include "impact/force_law.hpp"
#include "impact/impact.hpp"
#include "impact/jkr_law.hpp"

namespace recoil {
namespace {

constexpr int most_groups = 4;       // three, and kappa where there is a dashpot
constexpr int anderson_depth = 0;    // the field is not stiff: plain functional iteration
constexpr double longest_arc = 1e9;  // "until an event": no impact is this long in sigma
// At the separatrix q falls like sigma^-2 and release is never reached. Inside this circle about
// q = u = 0 the energy that is left is below 1e-15 m V^2 (`cusp_radius` of the law) and decides.
constexpr double undecided_energy = 1e-15;

enum class Stage { compression, restitution };

struct Field {
  double alpha, strength, gamma, kappa;
  AdhesionDampingPhase phase;
  Stage stage = Stage::compression;
  double cusp_radius_squared = 0.0;

  /// Whether the adhesion damping acts: 0 or 1.
  double acts() const {
    return phase == AdhesionDampingPhase::both || stage == Stage::restitution ? 1.0 : 0.0;
  }
};

const Field& field_of(void* user_data) { return *static_cast<const Field*>(user_data); }

/// du/dsigma under `Law`; only the ring law knows a dashpot.
template <class Law, class Q, class U, class Alpha, class Strength, class Gamma, class Kappa>
auto acceleration_of(const Q& q, const U& u, double acts, const Alpha& alpha,
                     const Strength& strength, const Gamma& gamma,
                     [[maybe_unused]] const Kappa& kappa) {
  if constexpr (std::is_same_v<Law, RingAdhesionLaw>) {
    return Law::acceleration(q, u, acts, alpha, strength, gamma) +
           dashpot_acceleration(q, u, kappa);
  } else {
    return Law::acceleration(q, u, acts, alpha, strength, gamma);
  }
}

template <class Law>
int right_hand_side(realtype, N_Vector y, N_Vector y_dot, void* user_data) {
  const Field& f = field_of(user_data);
  const double q = NV_Ith_S(y, 0);
  const double u = NV_Ith_S(y, 1);
  NV_Ith_S(y_dot, 0) = u;
  NV_Ith_S(y_dot, 1) = acceleration_of<Law>(q, u, f.acts(), f.alpha, f.strength, f.gamma, f.kappa);
  return 0;
}

/// s_dot = (d field / d y) s + d field / d p, every partial derivative from the one force law.
template <class Law>
int sensitivity_right_hand_side(int count, realtype, N_Vector y, N_Vector, N_Vector* s,
                                N_Vector* s_dot, void* user_data, N_Vector, N_Vector) {
  const Field& f = field_of(user_data);
  using Dual = ceres::Jet<double, 2 + most_groups>;
  const Dual q(NV_Ith_S(y, 0), 0);
  const Dual u(NV_Ith_S(y, 1), 1);
  const Dual acceleration = acceleration_of<Law>(
      q, u, f.acts(), Dual(f.alpha, 2), Dual(f.strength, 3), Dual(f.gamma, 4), Dual(f.kappa, 5));
  for (int i = 0; i < count; ++i) {
    const double s_q = NV_Ith_S(s[i], 0);
    const double s_u = NV_Ith_S(s[i], 1);
    NV_Ith_S(s_dot[i], 0) = s_u;
    NV_Ith_S(s_dot[i], 1) =
        acceleration.v[0] * s_q + acceleration.v[1] * s_u + acceleration.v[2 + i];
  }
  return 0;
}

/// Time and the losses: dt = (dx / dq) dsigma, power = -force times u.
template <class Law>
int quadrature_right_hand_side(realtype, N_Vector y, N_Vector rates, void* user_data) {
  const Field& f = field_of(user_data);
  const double q = NV_Ith_S(y, 0);
  const double u = NV_Ith_S(y, 1);
  const auto forces = Law::forces(q, u, f.alpha, f.strength, f.gamma, f.acts());
  const double clock = Law::clock(q, f.strength);
  NV_Ith_S(rates, 0) = clock;
  NV_Ith_S(rates, 1) = -clock * forces.hertz_damping * u;
  NV_Ith_S(rates, 2) = -clock * forces.adhesion_damping * u;
  if (NV_LENGTH_S(rates) > 3) NV_Ith_S(rates, 3) = -dashpot_acceleration(q, u, f.kappa) * u;
  return 0;
}

int turning_event(realtype, N_Vector y, realtype* value, void*) {
  value[0] = NV_Ith_S(y, 1);
  return 0;
}

int end_events(realtype, N_Vector y, realtype* value, void* user_data) {
  const double q = NV_Ith_S(y, 0);
  const double u = NV_Ith_S(y, 1);
  value[0] = q;                                                        // release
  value[1] = u;                                                        // outer turning point
  value[2] = q * q + u * u - field_of(user_data).cusp_radius_squared;  // separatrix
  return 0;
}

struct FreeVector {
  void operator()(N_Vector v) const { N_VDestroy(v); }
};
using Vector = std::unique_ptr<std::remove_pointer_t<N_Vector>, FreeVector>;

struct FreeMemory {
  void operator()(void* memory) const { CVodeFree(&memory); }
};
struct FreeNonlinearSolver {
  void operator()(SUNNonlinearSolver solver) const { SUNNonlinSolFree(solver); }
};
using NonlinearSolver =
    std::unique_ptr<std::remove_pointer_t<SUNNonlinearSolver>, FreeNonlinearSolver>;

/// One CVODES integration, with everything it owns.
template <class Law>
class Integration {
 public:
  Integration(const ImpactGroups& groups, const ImpactOptions& options)
      : options_(options),
        groups_count_(options.dashpot ? most_groups : most_groups - 1),
        strength_slope_(Law::strength_slope(groups)),
        resting_place_(Law::resting_place(groups)),
        depth_(Law::depth(groups)),
        field_{groups.alpha, Law::strength(groups), groups.gamma, groups.kappa, options.phase},
        state_(N_VNew_Serial(2, context_)),
        quadratures_(N_VNew_Serial(groups_count_, context_)) {
    const double radius = Law::cusp_radius(field_.strength, undecided_energy);
    field_.cusp_radius_squared = radius * radius;
    NV_Ith_S(state_.get(), 0) = Law::start;
    NV_Ith_S(state_.get(), 1) = 1.0;
    N_VConst(0.0, quadratures_.get());
    memory_.reset(CVodeCreate(CV_ADAMS, context_));
    ready_ = memory_ != nullptr && set_up();
  }

  bool ready() const { return ready_; }
  void* memory() const { return memory_.get(); }
  const Field& field() const { return field_; }
  double q() const { return NV_Ith_S(state_.get(), 0); }
  double u() const { return NV_Ith_S(state_.get(), 1); }
  double potential() const { return Law::potential(q(), 0.0, field_.strength, 0.0); }
  double quadrature(int i) const { return NV_Ith_S(quadratures_.get(), i); }

  /// One internal step, or to the next event if that comes first; CVODES's return code.
  int step() {
    const int code = CVode(memory_.get(), longest_arc, state_.get(), &sigma_, CV_ONE_STEP);
    if (options_.budget) CVodeGetQuad(memory_.get(), &sigma_, quadratures_.get());
    return code;
  }

  /// Passes the inner turning point: the adhesion damping switches on (continuously, as u = 0), and
  /// the events to look for become those of the restitution.
  bool turn() {
    field_.stage = Stage::restitution;
    if (options_.gradient && CVodeGetSens(memory_.get(), &sigma_, sensitivity_) < 0) return false;
    NV_Ith_S(state_.get(), 1) = 0.0;
    bool good = CVodeReInit(memory_.get(), sigma_, state_.get()) == CV_SUCCESS;
    if (options_.gradient) {
      good = good && CVodeSensReInit(memory_.get(), CV_SIMULTANEOUS, sensitivity_) == CV_SUCCESS;
    }
    if (options_.budget) {
      good = good && CVodeQuadReInit(memory_.get(), quadratures_.get()) == CV_SUCCESS;
    }
    std::array<int, 3> directions = {-1, 1, -1};
    return good && CVodeRootInit(memory_.get(), 3, end_events) == CV_SUCCESS &&
           CVodeSetRootDirection(memory_.get(), directions.data()) == CV_SUCCESS;
  }

  /// Puts a sphere that has all but settled to rest at the bottom of the well; true when it did.
  bool settles() {
    const double energy = 0.5 * u() * u() + potential();
    if (!(energy < (1.0 - settled_part) * depth_)) return false;
    NV_Ith_S(state_.get(), 0) = resting_place_;
    NV_Ith_S(state_.get(), 1) = 0.0;
    return true;
  }

  /// d (2 H) / d group at the end of the impact. Both ends need no correction for the change of the
  /// arc length: u' = 0 at a release (q = 0) and H' = 0 at a turning point (u = 0).
  bool energy_gradient(std::array<double, most_groups>& gradient) {
    if (CVodeGetSens(memory_.get(), &sigma_, sensitivity_) < 0) return false;
    using Dual = ceres::Jet<double, 2>;
    const Dual potential = Law::potential(Dual(q(), 0), 0.0, Dual(field_.strength, 1), 0.0);
    for (int i = 0; i < groups_count_; ++i) {
      const double s_q = NV_Ith_S(sensitivity_[i], 0);
      const double s_u = NV_Ith_S(sensitivity_[i], 1);
      const double direct = i == 1 ? potential.v[1] : 0.0;
      gradient[static_cast<std::size_t>(i)] = 2.0 * (u() * s_u + potential.v[0] * s_q + direct);
    }
    gradient[1] *= strength_slope_;
    return true;
  }

 private:
  bool set_up() {
    void* memory = memory_.get();
    const double absolute = 1e-2 * options_.tolerance;
    std::array<int, 1> falling = {-1};
    CVodeSetErrFile(memory, nullptr);
    bool good = CVodeInit(memory, right_hand_side<Law>, 0.0, state_.get()) == CV_SUCCESS &&
                CVodeSStolerances(memory, options_.tolerance, absolute) == CV_SUCCESS &&
                CVodeSetUserData(memory, &field_) == CV_SUCCESS &&
                CVodeRootInit(memory, 1, turning_event) == CV_SUCCESS &&
                CVodeSetRootDirection(memory, falling.data()) == CV_SUCCESS;
    solver_.reset(SUNNonlinSol_FixedPoint(state_.get(), anderson_depth, context_));
    good = good && CVodeSetNonlinearSolver(memory, solver_.get()) == CV_SUCCESS;
    if (good && options_.gradient) good = set_up_sensitivities(absolute);
    if (good && options_.budget) {
      good = CVodeQuadInit(memory, quadrature_right_hand_side<Law>, quadratures_.get()) ==
                 CV_SUCCESS &&
             CVodeSetQuadErrCon(memory, SUNTRUE) == CV_SUCCESS &&
             CVodeQuadSStolerances(memory, options_.tolerance, absolute) == CV_SUCCESS;
    }
    return good;
  }

  bool set_up_sensitivities(double absolute) {
    void* memory = memory_.get();
    for (int i = 0; i < groups_count_; ++i) {
      sensitivity_owner_[static_cast<std::size_t>(i)].reset(N_VNew_Serial(2, context_));
      sensitivity_[i] = sensitivity_owner_[static_cast<std::size_t>(i)].get();
      N_VConst(0.0, sensitivity_[i]);
    }
    std::array<double, most_groups> absolutes = {};
    absolutes.fill(absolute);
    sensitivity_solver_.reset(
        SUNNonlinSol_FixedPointSens(groups_count_ + 1, state_.get(), anderson_depth, context_));
    return CVodeSensInit(memory, groups_count_, CV_SIMULTANEOUS, sensitivity_right_hand_side<Law>,
                         sensitivity_) == CV_SUCCESS &&
           CVodeSensSStolerances(memory, options_.tolerance, absolutes.data()) == CV_SUCCESS &&
           CVodeSetSensErrCon(memory, SUNTRUE) == CV_SUCCESS &&
           CVodeSetNonlinearSolverSensSim(memory, sensitivity_solver_.get()) == CV_SUCCESS;
  }

  // Declared in the order of dependence: everything below lives in the context.
  sundials::Context context_;
  ImpactOptions options_;
  int groups_count_;
  double strength_slope_, resting_place_, depth_;
  Field field_;
  Vector state_;
  Vector quadratures_;
  std::array<Vector, most_groups> sensitivity_owner_;
  N_Vector sensitivity_[most_groups] = {};
  NonlinearSolver solver_;
  NonlinearSolver sensitivity_solver_;
  std::unique_ptr<void, FreeMemory> memory_;
  double sigma_ = 0.0;
  bool ready_ = false;
};

/// What is watched on the way, from step to step.
template <class Law>
void observe(const Integration<Law>& run, const ImpactOptions& options, ImpactResult& result,
             std::vector<ImpactMoment>* history) {
  const Field& f = run.field();
  const double q = std::max(run.q(), 0.0);
  const double x = Law::penetration(q, f.strength);
  const auto forces = Law::forces(q, run.u(), f.alpha, f.strength, f.gamma, f.acts());
  const double push =
      -(forces.hertz + forces.hertz_damping + forces.adhesion + forces.adhesion_damping) +
      q * f.kappa * run.u();
  result.penetration_max = std::max(result.penetration_max, x);
  result.force_compression = std::max(result.force_compression, push);
  result.force_tension = std::max(result.force_tension, -push);
  result.energy.largest = std::max(
      {result.energy.largest, run.u() * run.u() / 2.0, Law::largest_energy(q, f.strength)});
  if (history != nullptr && options.budget) {
    history->push_back({run.quadrature(0), x, run.u(), -forces.hertz, -forces.hertz_damping,
                        -forces.adhesion, -forces.adhesion_damping, q * f.kappa * run.u()});
  }
}

template <class Law>
void finish(Integration<Law>& run, const ImpactOptions& options, ImpactResult& result) {
  const double kinetic = run.u() * run.u() / 2.0;
  const double potential = run.potential();
  const double left = kinetic + potential;
  if (!std::isfinite(left)) {
    result.outcome = ImpactOutcome::integration_failure;
    return;
  }
  result.restitution_squared = 2.0 * left;
  result.outcome = left > 0.0 ? ImpactOutcome::rebound : ImpactOutcome::captured;
  if (options.gradient && !run.energy_gradient(result.gradient)) {
    result.outcome = ImpactOutcome::integration_failure;
  }
  if (options.budget) {
    result.contact_time = run.quadrature(0);
    result.energy.hertz_loss = run.quadrature(1);
    result.energy.adhesion_loss = run.quadrature(2);
    if (options.dashpot) result.energy.dashpot_loss = run.quadrature(3);
  }
  result.energy.kinetic = kinetic;
  result.energy.potential = potential;
}

/// From touch to release or to the first outer turning point.
template <class Law>
ImpactResult simulate(const ImpactGroups& groups, const ImpactOptions& options,
                      std::vector<ImpactMoment>* history) {
  ImpactResult result;
  Integration<Law> run(groups, options);
  if (!run.ready()) return result;
  observe(run, options, result, history);
  bool turned = false;
  for (;;) {
    if (++result.steps > options.max_steps) {
      result.outcome = ImpactOutcome::step_limit;
      return result;
    }
    const int code = run.step();
    if (code < 0) return result;
    observe(run, options, result, history);
    if (turned && run.settles()) break;
    if (code != CV_ROOT_RETURN) continue;
    if (turned) break;
    turned = true;
    if (!run.turn()) return result;
  }
  finish(run, options, result);
  return result;
}

/// Hertz's contact, which every law becomes, with the slope that JKR has there.
ImpactResult without_adhesion(ImpactGroups groups, const ImpactOptions& options,
                              std::vector<ImpactMoment>* history) {
  groups.beta = 0.0;
  ImpactResult result = simulate<RingAdhesionLaw>(groups, options, history);
  result.gradient[1] = 0.0;
  return result;
}

}  // namespace

double EnergyBudget::audit() const {
  return (0.5 - (kinetic + potential + hertz_loss + adhesion_loss + dashpot_loss)) /
         std::max(largest, 0.5);
}

ImpactResult simulate_impact(const ImpactGroups& groups, const ImpactOptions& options,
                             std::vector<ImpactMoment>* history) {
  ImpactResult result;
  if (!(std::isfinite(groups.alpha) && std::isfinite(groups.beta) && std::isfinite(groups.gamma) &&
        groups.alpha >= 0.0 && groups.beta >= 0.0 && groups.gamma >= 0.0 &&
        (options.dashpot ? options.adhesion == AdhesionLaw::ring && std::isfinite(groups.kappa) &&
                               groups.kappa >= 0.0
                         : groups.kappa == 0.0))) {
    return result;  // an inadmissible trial point of an optimiser is a failure, not a crash
  }
  switch (options.adhesion) {
    case AdhesionLaw::ring:
      return simulate<RingAdhesionLaw>(groups, options, history);
    case AdhesionLaw::dmt:
      return simulate<DmtLaw>(groups, options, history);
    case AdhesionLaw::jkr:
      return groups.beta < JkrLaw::least_beta ? without_adhesion(groups, options, history)
                                              : simulate<JkrLaw>(groups, options, history);
  }
  return result;
}

}  // namespace recoil
