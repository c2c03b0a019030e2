#include <ceres/jet.h>
#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <sundials/sundials_context.hpp>
#include <utility>

#include "impact/impact.hpp"
#include "impact/laws.hpp"
#include "impact/with_dashpot.hpp"

namespace recoil {
namespace {

constexpr int anderson_depth = 0;    // the field is not stiff: plain functional iteration
constexpr double longest_arc = 1e9;  // "until an event": no impact is this long in sigma
// On the separatrix q falls like sigma^-2 and never reaches the release. The integration ends
// within a circle about the release and u = 0 where the remaining energy is below this [m V^2]
// (`cusp_radius` of the law), and its sign decides between rebound and capture.
constexpr double undecided_energy = 1e-15;

/// The data of an integration under `Law`.
template <class Law>
struct Field {
  std::array<double, Law::groups> groups;
  std::array<double, Law::constants> constants;
  LawPath path;
  AdhesionDampingPhase phase;
  bool never_pulls;
  double cusp_radius_squared;
  bool rebounding = false;  ///< beyond the inner turning point

  /// 1 if the adhesion damping acts, else 0.
  double acts() const { return phase == AdhesionDampingPhase::both || rebounding ? 1.0 : 0.0; }
};

template <class Law>
const Field<Law>& field_of(void* user_data) {
  return *static_cast<const Field<Law>*>(user_data);
}

/// act(groups..., constants...), with each group converted by number(value, direction).
template <class Law, class Number, class Act>
auto with_values(const Field<Law>& f, Number number, Act act) {
  return [&]<std::size_t... k, std::size_t... c>(std::index_sequence<k...>,
                                                 std::index_sequence<c...>) {
    return act(number(f.groups[k], static_cast<int>(k))..., f.constants[c]...);
  }
  (std::make_index_sequence<Law::groups>{}, std::make_index_sequence<Law::constants>{});
}

template <class Law, class Act>
auto with_values(const Field<Law>& f, Act act) {
  return with_values(
      f, [](double value, int) { return value; }, act);
}

template <class Law>
constexpr bool has_dashpot = Law::places.back() == place_of_kappa;

/// The dashpot's power divided by u^2.
template <class Law>
double dashpot_power(const Field<Law>& f, double q) {
  const double weight = with_values(f, [&](auto... v) { return Law::dashpot_weight(q, v...); });
  return f.groups.back() * weight;
}

template <class Law>
int right_hand_side(realtype, N_Vector y, N_Vector y_dot, void* user_data) {
  const Field<Law>& f = field_of<Law>(user_data);
  const double q = NV_Ith_S(y, 0);
  const double u = NV_Ith_S(y, 1);
  NV_Ith_S(y_dot, 0) = u;
  NV_Ith_S(y_dot, 1) =
      with_values(f, [&](auto... v) { return Law::acceleration(q, u, f.acts(), v...); });
  return 0;
}

/// s_dot = (d field / d y) s + d field / d p, with partial derivatives of the force law.
template <class Law>
int sensitivity_right_hand_side(int count, realtype, N_Vector y, N_Vector, N_Vector* s,
                                N_Vector* s_dot, void* user_data, N_Vector, N_Vector) {
  const Field<Law>& f = field_of<Law>(user_data);
  using Dual = ceres::Jet<double, 2 + static_cast<int>(Law::groups)>;
  const Dual q(NV_Ith_S(y, 0), 0);
  const Dual u(NV_Ith_S(y, 1), 1);
  const Dual acceleration = with_values(
      f, [](double value, int k) { return Dual(value, 2 + k); },
      [&](auto... v) -> Dual { return Law::acceleration(q, u, f.acts(), v...); });
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
  const Field<Law>& f = field_of<Law>(user_data);
  const double q = NV_Ith_S(y, 0);
  const double u = NV_Ith_S(y, 1);
  const auto forces = with_values(f, [&](auto... v) { return Law::forces(q, u, f.acts(), v...); });
  const double clock = with_values(f, [&](auto... v) { return Law::clock(q, v...); });
  NV_Ith_S(rates, 0) = clock;
  NV_Ith_S(rates, 1) = -clock * forces.hertz_damping * u;
  NV_Ith_S(rates, 2) = -clock * forces.adhesion_damping * u;
  if constexpr (has_dashpot<Law>) {
    // A dashpot that may not pull takes up the elastic force.
    NV_Ith_S(rates, 3) = f.constants.back() > 0.0
                             ? dashpot_power(f, q) * u * u
                             : clock * (forces.hertz + forces.hertz_damping) * u;
  }
  return 0;
}

/// Zero where the law changes: at the seam, or where elastic force and dashpot cease to act.
template <class Law>
double seam_of(const Field<Law>& f, double q, [[maybe_unused]] double u) {
  if constexpr (has_dashpot<Law>) {
    if (!f.never_pulls || !f.rebounding || f.groups.back() == 0.0) return 1.0;
    return with_values(f, [&](auto... v) { return Law::push(q, u, v...); });
  } else {
    return f.path.seam ? q : 1.0;
  }
}

template <class Law>
int turning_event(realtype, N_Vector y, realtype* value, void* user_data) {
  value[0] = NV_Ith_S(y, 1);
  value[1] = seam_of(field_of<Law>(user_data), NV_Ith_S(y, 0), NV_Ith_S(y, 1));
  return 0;
}

template <class Law>
int end_events(realtype, N_Vector y, realtype* value, void* user_data) {
  const Field<Law>& f = field_of<Law>(user_data);
  const double way = NV_Ith_S(y, 0) - f.path.release;
  const double u = NV_Ith_S(y, 1);
  value[0] = way;                                        // release
  value[1] = u;                                          // outer turning point
  value[2] = way * way + u * u - f.cusp_radius_squared;  // separatrix
  value[3] = seam_of(f, NV_Ith_S(y, 0), u);
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
        impact_(groups),
        depth_(Law::depth(groups)),
        field_{Law::groups_of(groups), Law::constants_of(groups),
               Law::path_of(groups),   options.phase,
               options.never_pulls,    std::pow(Law::cusp_radius(groups, undecided_energy), 2)},
        state_(N_VNew_Serial(2, context_)),
        quadratures_(N_VNew_Serial(quadratures, context_)) {
    NV_Ith_S(state_.get(), 0) = field_.path.start;
    NV_Ith_S(state_.get(), 1) = 1.0;
    N_VConst(0.0, quadratures_.get());
    memory_.reset(CVodeCreate(CV_ADAMS, context_));
    ready_ = memory_ != nullptr && set_up();
  }

  bool ready() const { return ready_; }
  void* memory() const { return memory_.get(); }
  const Field<Law>& field() const { return field_; }
  double q() const { return NV_Ith_S(state_.get(), 0); }
  double u() const { return NV_Ith_S(state_.get(), 1); }
  double potential() const {
    return with_values(field_, [&](auto... v) { return Law::potential(q(), v...); });
  }
  double quadrature(int i) const { return NV_Ith_S(quadratures_.get(), i); }

  /// One internal step, or to the next event if that comes first; CVODES's return code.
  int step() {
    last_sigma_ = sigma_;
    const int code = CVode(memory_.get(), longest_arc, state_.get(), &sigma_, CV_ONE_STEP);
    if (options_.budget) CVodeGetQuad(memory_.get(), &sigma_, quadratures_.get());
    return code;
  }

  /// q and u at this part of the way from the start of the last step to its end.
  std::optional<std::pair<double, double>> within_step(double part) {
    const Vector at(N_VNew_Serial(2, context_));
    const double sigma = last_sigma_ + part * (sigma_ - last_sigma_);
    if (CVodeGetDky(memory_.get(), sigma, 0, at.get()) != CV_SUCCESS) return std::nullopt;
    return std::pair(NV_Ith_S(at.get(), 0), NV_Ith_S(at.get(), 1));
  }

  /// Begins the restitution at the inner turning point: the adhesion damping is switched on, which
  /// is continuous at u = 0, and the events become those of the restitution.
  bool turn() {
    field_.rebounding = true;
    return restart(1, 0.0);
  }

  /// True if the last root was the seam of the law, which does not end the impact.
  bool at_seam() const {
    std::array<int, 4> found = {};
    CVodeGetRootInfo(memory_.get(), found.data());
    const bool first = !field_.rebounding;
    return found[first ? 1 : 3] != 0 && found[0] == 0 &&
           (first || (found[1] == 0 && found[2] == 0));
  }

  /// Continues with the law of the other side; the seam is at q = 0.
  bool pass_seam() {
    if constexpr (Law::constants > 0) {
      double& side = field_.constants.back();
      side = 1.0 - side;
    }
    return has_dashpot<Law> ? restart(1, u()) : restart(0, 0.0);
  }

  /// Puts a sphere that has nearly settled at the bottom of the well. @return true if it has
  /// settled
  bool settles() {
    const double energy = 0.5 * u() * u() + potential();
    if (!(energy < (1.0 - settled_part) * depth_)) return false;
    NV_Ith_S(state_.get(), 0) = field_.path.resting;
    NV_Ith_S(state_.get(), 1) = 0.0;
    return true;
  }

  /// d (2 H) / d group at the end of the impact. A change of the arc length needs no correction,
  /// because H' = 0 at a turning point (u = 0) and at a release (u' = 0). A dashpot at the release
  /// is included by the sensitivity of u at constant q.
  bool energy_gradient(std::array<double, 5>& gradient) {
    if (CVodeGetSens(memory_.get(), &sigma_, sensitivity_) < 0) return false;
    using Dual = ceres::Jet<double, 1 + static_cast<int>(Law::groups)>;
    const Dual potential = with_values(
        field_, [](double value, int k) { return Dual(value, 1 + k); },
        [&](auto... v) -> Dual { return Law::potential(Dual(q(), 0), v...); });
    // At the release q is constant, and sigma changes by -s_q / u.
    const bool released = u() < 0.0;
    const double pull =
        released ? with_values(
                       field_,
                       [&](auto... v) { return Law::acceleration(q(), u(), field_.acts(), v...); })
                 : 0.0;
    std::array<double, Law::groups> by = {};
    for (std::size_t i = 0; i < Law::groups; ++i) {
      const double s_q = NV_Ith_S(sensitivity_[i], 0);
      const double s_u = NV_Ith_S(sensitivity_[i], 1);
      const double at_end = u() * s_u + (released ? -pull : potential.v[0]) * s_q;
      by[i] = 2.0 * (at_end + potential.v[1 + static_cast<int>(i)]);
    }
    gradient = impact_gradient<Law>(impact_, by);
    return true;
  }

 private:
  bool look_for_events() {
    void* memory = memory_.get();
    if (!field_.rebounding) {
      std::array<int, 2> directions = {-1, 0};
      return CVodeRootInit(memory, 2, turning_event<Law>) == CV_SUCCESS &&
             CVodeSetRootDirection(memory, directions.data()) == CV_SUCCESS;
    }
    std::array<int, 4> directions = {-1, 1, -1, 0};
    return CVodeRootInit(memory, 4, end_events<Law>) == CV_SUCCESS &&
           CVodeSetRootDirection(memory, directions.data()) == CV_SUCCESS;
  }

  /// Restarts the integration here, after setting component `which` of the state to `value`.
  bool restart(int which, double value) {
    if (options_.gradient && CVodeGetSens(memory_.get(), &sigma_, sensitivity_) < 0) return false;
    NV_Ith_S(state_.get(), which) = value;
    bool good = CVodeReInit(memory_.get(), sigma_, state_.get()) == CV_SUCCESS;
    if (options_.gradient) {
      good = good && CVodeSensReInit(memory_.get(), CV_SIMULTANEOUS, sensitivity_) == CV_SUCCESS;
    }
    if (options_.budget) {
      good = good && CVodeQuadReInit(memory_.get(), quadratures_.get()) == CV_SUCCESS;
    }
    return good && look_for_events();
  }

  bool set_up() {
    void* memory = memory_.get();
    const double absolute = 1e-2 * options_.tolerance;
    CVodeSetErrFile(memory, nullptr);
    bool good = CVodeInit(memory, right_hand_side<Law>, 0.0, state_.get()) == CV_SUCCESS &&
                CVodeSStolerances(memory, options_.tolerance, absolute) == CV_SUCCESS &&
                CVodeSetUserData(memory, &field_) == CV_SUCCESS && look_for_events();
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
    for (std::size_t i = 0; i < Law::groups; ++i) {
      sensitivity_owner_[i].reset(N_VNew_Serial(2, context_));
      sensitivity_[i] = sensitivity_owner_[i].get();
      N_VConst(0.0, sensitivity_[i]);
      if (Law::places[i] == place_of_range) NV_Ith_S(sensitivity_[i], 0) = field_.path.range_slope;
    }
    std::array<double, Law::groups> absolutes = {};
    absolutes.fill(absolute);
    sensitivity_solver_.reset(
        SUNNonlinSol_FixedPointSens(groups_count + 1, state_.get(), anderson_depth, context_));
    return CVodeSensInit(memory, groups_count, CV_SIMULTANEOUS, sensitivity_right_hand_side<Law>,
                         sensitivity_) == CV_SUCCESS &&
           CVodeSensSStolerances(memory, options_.tolerance, absolutes.data()) == CV_SUCCESS &&
           CVodeSetSensErrCon(memory, SUNTRUE) == CV_SUCCESS &&
           CVodeSetNonlinearSolverSensSim(memory, sensitivity_solver_.get()) == CV_SUCCESS;
  }

  static constexpr int groups_count = static_cast<int>(Law::groups);
  static constexpr int quadratures = has_dashpot<Law> ? 4 : 3;  // time and the losses

  // The context has to be declared first, because all other members depend on it.
  sundials::Context context_;
  ImpactOptions options_;
  ImpactGroups impact_;
  double depth_;
  Field<Law> field_;
  Vector state_;
  Vector quadratures_;
  std::array<Vector, Law::groups> sensitivity_owner_;
  N_Vector sensitivity_[Law::groups] = {};
  NonlinearSolver solver_;
  NonlinearSolver sensitivity_solver_;
  std::unique_ptr<void, FreeMemory> memory_;
  double sigma_ = 0.0, last_sigma_ = 0.0;
  bool ready_ = false;
};

/// Updates the largest penetration, forces and energy at a place of the path.
/// @return the dashpot's force and the others
template <class Law>
std::pair<double, PlainForces> observe(const Field<Law>& f, double at, double u,
                                       ImpactResult& result) {
  const double q = std::max(at, f.path.release);
  const double x = with_values(f, [&](auto... v) { return Law::penetration(q, v...); });
  const auto forces = with_values(f, [&](auto... v) { return Law::forces(q, u, f.acts(), v...); });
  double dashpot = 0.0;
  if constexpr (has_dashpot<Law>) {
    // Under JKR it grows without limit towards the release, where it is omitted.
    const double clock = with_values(f, [&](auto... v) { return Law::clock(q, v...); });
    dashpot = clock > 0.0 && q > f.path.release ? dashpot_power(f, q) * u / clock : 0.0;
    if (f.constants.back() == 0.0) dashpot = forces.hertz + forces.hertz_damping;
  }
  const double push =
      -(forces.hertz + forces.hertz_damping + forces.adhesion + forces.adhesion_damping) + dashpot;
  result.penetration_max = std::max(result.penetration_max, x);
  result.force_compression = std::max(result.force_compression, push);
  result.force_tension = std::max(result.force_tension, -push);
  result.energy.largest =
      std::max({result.energy.largest, u * u / 2.0,
                with_values(f, [&](auto... v) { return Law::largest_energy(q, v...); })});
  return {dashpot, forces};
}

/// Observes the last step, and also within it if there is a budget: the largest force lies between
/// two steps, and is known to 1e-6 of it from this many parts of a step.
template <class Law>
void observe_step(Integration<Law>& run, const ImpactOptions& options, ImpactResult& result,
                  std::vector<ImpactMoment>* history) {
  const Field<Law>& f = run.field();
  constexpr int parts = 32;
  for (int k = 1; options.budget && k < parts; ++k) {
    if (const auto at = run.within_step(k / double(parts))) {
      observe(f, at->first, at->second, result);
    }
  }
  const auto [dashpot, forces] = observe(f, run.q(), run.u(), result);
  if (history != nullptr && options.budget) {
    const double x = with_values(
        f, [&](auto... v) { return Law::penetration(std::max(run.q(), f.path.release), v...); });
    history->push_back({run.quadrature(0), x, run.u(), -forces.hertz, -forces.hertz_damping,
                        -forces.adhesion, -forces.adhesion_damping, dashpot});
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
    if constexpr (has_dashpot<Law>) result.energy.dashpot_loss = run.quadrature(3);
  }
  result.energy.kinetic = kinetic;
  result.energy.potential = potential;
}

/// Simulates from first contact to release or to the first outer turning point.
template <class Law>
ImpactResult simulate(const ImpactGroups& groups, const ImpactOptions& options,
                      std::vector<ImpactMoment>* history) {
  ImpactResult result;
  Integration<Law> run(groups, options);
  if (!run.ready()) return result;
  observe_step(run, options, result, history);
  bool turned = false;
  for (;;) {
    if (++result.steps > options.max_steps) {
      result.outcome = ImpactOutcome::step_limit;
      return result;
    }
    const int code = run.step();
    if (code < 0) return result;
    observe_step(run, options, result, history);
    if (turned && run.settles()) break;
    if (code != CV_ROOT_RETURN) continue;
    if (run.at_seam()) {
      if (!run.pass_seam()) return result;
      continue;
    }
    if (turned) break;
    turned = true;
    if (!run.turn()) return result;
  }
  finish(run, options, result);
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
  if (!is_admissible(groups, options)) return result;
  if (const auto simpler = without_adhesion(groups, options)) {
    result = simulate_impact(simpler->first, simpler->second, history);
    result.gradient[1] = 0.0;
    return result;
  }
  return with_law(options.adhesion, [&]<class Law>() {
    if constexpr (Law::has_dashpot) {
      if (options.dashpot) return simulate<WithDashpot<Law>>(groups, options, history);
    }
    return simulate<Law>(groups, options, history);
  });
}

}  // namespace recoil
