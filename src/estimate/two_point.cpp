#include "estimate/two_point.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

namespace recoil {
namespace {

constexpr int most_iterations = 200;
constexpr double at_rest = 1e-8;  // relative change of both factors
// Relative, of each factor; the error after the last Newton step is far smaller.
constexpr double root_tolerance = 1e-9;

struct Excess {
  double value;  // e^2 of the model minus e^2 of the point
  double slope;  // d value / d damping, negative
};

/// The damping in [0, upper] at which `excess`, which falls with damping, vanishes, by Newton's
/// method from `guess` within a bracket. Nullopt if the excess is negative without damping, if it
/// is positive at the largest damping, or if an impact cannot be solved.
template <class ExcessAt>
std::optional<double> find_damping(const ExcessAt& excess_at, double guess, double upper) {
  constexpr int most_steps = 200;
  double damping = guess;
  double low = 0.0;
  double high = upper;
  bool root_above_zero = false;  // excess(0) >= 0
  for (int step = 0; step < most_steps; ++step) {
    const Excess at = excess_at(damping);
    if (!std::isfinite(at.value)) return std::nullopt;
    if (damping == 0.0) {
      if (at.value < 0.0) return std::nullopt;
      root_above_zero = true;
    }
    if (at.value > 0.0 && damping >= upper) return std::nullopt;
    (at.value > 0.0 ? low : high) = damping;
    double next = damping - at.value / at.slope;
    if (next <= 0.0 && !root_above_zero) {
      next = 0.0;
    } else if (!(next > low) || !(next < high)) {
      // From below a root, Newton's method may overshoot into the flat or captured range.
      next = low > 0.0 ? std::min(4.0 * low, std::sqrt(low * high)) : 0.25 * high;
      if (high == upper && next > 0.5 * upper) next = upper;
    }
    if (next > 0.0 && std::abs(next - damping) <= root_tolerance * next) return next;
    damping = next;
  }
  return damping;
}

/// The adhesion that the fit file fixes; that of eq. 12 if the full fit frees it.
double adhesion_of_two_points(const ImpactModel& model, std::size_t dataset) {
  const ParameterSlot& slot = model.slots[model.slot_adhesion[dataset]];
  return slot.free ? derived_adhesion(model, dataset) : slot.initial;
}

/// Simulates the impacts of one diameter for given dampings.
class CalibratedSphere {
 public:
  CalibratedSphere(const ImpactModel& model, std::size_t dataset, double diameter)
      : model_(model), dataset_(dataset), diameter_(diameter), theta_(model.initial()) {
    theta_[model.slot_adhesion[dataset]] = adhesion_of_two_points(model, dataset);
  }

  /// beta at the velocity of `point`.
  double beta_at(const Observation& point) const {
    return impact_groups(conditions_at(model_, theta_, dataset_, diameter_, point.velocity)).beta;
  }

  /// The damping factors at which the model gives the measured e of both points, by Newton's method
  /// in both from `theta`. Nullopt if a step leaves the bounds, if Newton's method does not
  /// converge, or if the paper's iteration would not converge there.
  std::optional<std::array<double, 2>> both_factors(const std::array<const Observation*, 2>& points,
                                                    const std::array<double, 2>& beta,
                                                    std::span<const double> theta) const {
    constexpr int most_steps = 12;
    const std::array<std::size_t, 2> slots = {model_.slot_C_H[dataset_], model_.slot_C_A[dataset_]};
    std::array<double, 2> factors = {theta[slots[0]], theta[slots[1]]};
    for (int step = 0; step < most_steps; ++step) {
      std::array<ImpactGroups, 2> groups;
      std::array<ImpactResult, 2> results;
      for (std::size_t i = 0; i < 2; ++i) {
        const double V = points[i]->velocity;
        groups[i] = {factors[0] * V, beta[i], factors[1] * V};
      }
      model_.simulator()(groups, model_.impact_options(true), results);
      Eigen::Matrix2d slopes;
      Eigen::Vector2d excess;
      for (int i = 0; i < 2; ++i) {
        const ImpactResult& result = results[static_cast<std::size_t>(i)];
        const Observation& point = *points[static_cast<std::size_t>(i)];
        if (!result.usable()) return std::nullopt;
        excess(i) = result.restitution_squared - point.restitution * point.restitution;
        slopes.row(i) << point.velocity * result.gradient[0], point.velocity * result.gradient[2];
      }
      const Eigen::Vector2d by = -slopes.inverse() * excess;
      bool rests = true;
      for (std::size_t k = 0; k < 2; ++k) {
        const double change = by(static_cast<Eigen::Index>(k));
        factors[k] += change;
        if (!(factors[k] > 0.0 && factors[k] < model_.slots[slots[k]].upper)) return std::nullopt;
        rests = rests && std::abs(change) <= root_tolerance * factors[k];
      }
      // The paper's iteration converges here if a change of one factor changes the other by less.
      const bool draws =
          std::abs(slopes(0, 1) * slopes(1, 0)) < std::abs(slopes(0, 0) * slopes(1, 1));
      if (rests) return draws ? std::optional(factors) : std::nullopt;
    }
    return std::nullopt;
  }

  /// e^2 of the model minus that of `point`, and its slope in C_H (`group` 0) or C_A (2).
  Excess excess(const Observation& point, double beta, double C_H, double C_A, int group) const {
    const double V = point.velocity;
    const ImpactGroups groups{C_H * V, beta, C_A * V};
    ImpactResult result;
    model_.simulator()(std::span(&groups, 1), model_.impact_options(true), std::span(&result, 1));
    if (!result.usable()) return {std::nan(""), 0.0};
    return {result.restitution_squared - point.restitution * point.restitution,
            V * result.gradient[static_cast<std::size_t>(group)]};
  }

 private:
  const ImpactModel& model_;
  std::size_t dataset_;
  double diameter_;
  std::vector<double> theta_;
};

/// Runs the iteration on the two points of `result`; sets its status, theta and iterations.
void iterate(const ImpactModel& model, const Observations& data, std::size_t dataset,
             std::span<const double> near, TwoPointResult& result) {
  const Observation& low = data.points[result.low_point];
  const Observation& high = data.points[result.high_point];
  const CalibratedSphere sphere(model, dataset, result.diameter);
  const double beta_low = sphere.beta_at(low);
  const double beta_high = sphere.beta_at(high);
  const double upper_C_H = model.slots[model.slot_C_H[dataset]].upper;
  const double upper_C_A = model.slots[model.slot_C_A[dataset]].upper;
  double C_H = 0.0;
  double C_A = 0.0;
  const auto replace = [](double& damping, double found) {
    const double change = std::abs(found - damping);
    damping = found;
    return change > at_rest * found;
  };
  std::optional<std::array<double, 2>> found;
  if (!near.empty()) found = sphere.both_factors({&high, &low}, {beta_high, beta_low}, near);
  if (found) {
    result.status = TwoPointStatus::converged;
    C_H = found->front();
    C_A = found->back();
  } else {
    result.status = TwoPointStatus::not_converging;
  }
  for (result.iterations = 1; !found; ++result.iterations) {
    const std::optional<double> hertz = find_damping(
        [&](double damping) { return sphere.excess(high, beta_high, damping, C_A, 0); }, C_H,
        upper_C_H);
    const bool hertz_moves = replace(C_H, hertz.value_or(0.0));
    const std::optional<double> adhesion =
        find_damping([&](double damping) { return sphere.excess(low, beta_low, C_H, damping, 2); },
                     C_A, upper_C_A);
    const bool adhesion_moves = replace(C_A, adhesion.value_or(0.0));
    if (!hertz_moves && !adhesion_moves) {
      result.status = !hertz      ? TwoPointStatus::no_hertz_damping
                      : !adhesion ? TwoPointStatus::no_adhesion_damping
                                  : TwoPointStatus::converged;
      break;
    }
    if (result.iterations == most_iterations) break;
  }
  result.theta = model.initial();
  result.theta[model.slot_adhesion[dataset]] = adhesion_of_two_points(model, dataset);
  result.theta[model.slot_C_H[dataset]] = C_H;
  result.theta[model.slot_C_A[dataset]] = C_A;
}

bool choose_points(const Observations& data, std::size_t dataset, double diameter,
                   TwoPointResult& result) {
  double nearest = 0.0;
  for (const Observation& point : data.points) {
    if (point.dataset != dataset || point.censored) continue;
    if (nearest == 0.0 || std::abs(point.diameter - diameter) < std::abs(nearest - diameter)) {
      nearest = point.diameter;
    }
  }
  result.diameter = nearest;
  std::optional<std::size_t> low;
  std::optional<std::size_t> high;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const Observation& point = data.points[i];
    if (point.dataset != dataset || point.censored || point.diameter != nearest) continue;
    if (!low || point.velocity < data.points[*low].velocity) low = i;
    if (!high || point.velocity > data.points[*high].velocity) high = i;
  }
  if (!low || *low == *high) return false;
  result.low_point = *low;
  result.high_point = *high;
  return true;
}

}  // namespace

TwoPointResult two_point(const ImpactModel& model, const Observations& data, std::size_t dataset,
                         double diameter, std::span<const double> near) {
  TwoPointResult result;
  result.theta = without_mechanisms(model, model.initial());
  if (choose_points(data, dataset, diameter, result)) iterate(model, data, dataset, near, result);
  return result;
}

}  // namespace recoil
