#include "estimate/two_point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "core/units.hpp"

namespace recoil {
namespace {

constexpr int most_iterations = 200;
constexpr double settled = 1e-8;         // relative change of both factors
constexpr double root_tolerance = 1e-9;  // relative, of each factor; Newton ends far below it

struct Excess {
  double value;  // e^2 of the model minus e^2 of the point
  double slope;  // d value / d damping, negative
};

/// The damping in [0, upper] at which `excess` (which falls with damping) vanishes: Newton from
/// `guess`, kept inside a bracket. Nothing when even no damping leaves it below zero, the largest
/// leaves it above, or the model has no answer.
std::optional<double> damping_for(const std::function<Excess(double)>& excess, double guess,
                                  double upper) {
  double low = 0.0;
  double high = upper;
  bool zero_allows_it = false;  // excess(0) >= 0: there is a root above zero
  double damping = guess;
  constexpr int most_steps = 200;
  for (int i = 0; i < most_steps; ++i) {
    const Excess at = excess(damping);
    if (!std::isfinite(at.value)) return std::nullopt;
    if (damping == 0.0) {
      if (at.value < 0.0) return std::nullopt;
      zero_allows_it = true;
    }
    if (at.value > 0.0 && damping >= upper) return std::nullopt;
    (at.value > 0.0 ? low : high) = damping;
    double next = damping - at.value / at.slope;
    if (next <= 0.0 && !zero_allows_it) {
      next = 0.0;
    } else if (!(next > low) || !(next < high)) {
      // Newton left the bracket: from below a root it may overshoot into the flat or captured
      // range.
      next = low > 0.0 ? std::min(4.0 * low, std::sqrt(low * high)) : 0.25 * high;
      if (high == upper && next > 0.5 * upper) next = upper;
    }
    if (next > 0.0 && std::abs(next - damping) <= root_tolerance * next) return next;
    damping = next;
  }
  return damping;
}

/// The damping factor in `slot` that gives `point` its measured e, the others as in `theta`.
std::optional<double> calibrate(const ImpactModel& model, std::vector<double> theta,
                                std::size_t slot, const Observation& point) {
  const double target = point.restitution * point.restitution;
  const double guess = theta[slot];
  return damping_for(
      [&](double damping) {
        theta[slot] = damping;
        const Prediction at =
            predict(model, theta, point.dataset, point.diameter, point.velocity, true);
        if (!at.usable()) return Excess{std::nan(""), 0.0};
        return Excess{at.restitution_squared - target, at.gradient[slot]};
      },
      guess, model.slots[slot].upper);
}

std::string describe(const Observation& point) {
  return fmt::format("e = {:.4g} at V = {:.4g} m/s", point.restitution, point.velocity);
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

std::string to_string(TwoPointStatus status) {
  switch (status) {
    case TwoPointStatus::converged:
      return "converged";
    case TwoPointStatus::no_hertz_damping:
      return "no_hertz_damping";
    case TwoPointStatus::no_adhesion_damping:
      return "no_adhesion_damping";
    case TwoPointStatus::not_converging:
      return "not_converging";
    case TwoPointStatus::too_few_points:
      return "too_few_points";
  }
  return "";
}

TwoPointResult two_point(const ImpactModel& model, const Observations& data, std::size_t dataset,
                         double diameter) {
  TwoPointResult result;
  result.theta = model.initial();
  if (!choose_points(data, dataset, diameter, result)) {
    result.text = "the diameter has fewer than two velocities at which spheres rebounded";
    return result;
  }
  const Observation& low = data.points[result.low_point];
  const Observation& high = data.points[result.high_point];
  const std::size_t hertz = model.slot_C_H[dataset];
  const std::size_t adhesion = model.slot_C_A[dataset];
  // f0 stays at eq. 12 even when the full fit frees it: the iteration knows no third unknown.
  result.theta[model.slot_f0[dataset]] = model.contacts[dataset].adhesion_force;
  result.theta[hertz] = 0.0;
  result.theta[adhesion] = 0.0;

  for (result.iterations = 1; result.iterations <= most_iterations; ++result.iterations) {
    const std::optional<double> new_hertz = calibrate(model, result.theta, hertz, high);
    const double hertz_change = std::abs(new_hertz.value_or(0.0) - result.theta[hertz]);
    result.theta[hertz] = new_hertz.value_or(0.0);
    const std::optional<double> new_adhesion = calibrate(model, result.theta, adhesion, low);
    const double adhesion_change = std::abs(new_adhesion.value_or(0.0) - result.theta[adhesion]);
    result.theta[adhesion] = new_adhesion.value_or(0.0);
    if (hertz_change > settled * result.theta[hertz] ||
        adhesion_change > settled * result.theta[adhesion]) {
      continue;
    }
    if (!new_hertz) {
      result.status = TwoPointStatus::no_hertz_damping;
      result.text = fmt::format(
          "no C_H >= 0 gives {}: the adhesion that the lowest velocity asks for (C_A = {:.4g} s/m) "
          "already costs more there",
          describe(high), result.theta[adhesion]);
    } else if (!new_adhesion) {
      result.status = TwoPointStatus::no_adhesion_damping;
      result.text = fmt::format("no C_A in [0, {:.4g}] s/m gives {} beside C_H = {:.4g} s/m",
                                model.slots[adhesion].upper, describe(low), result.theta[hertz]);
    } else {
      result.status = TwoPointStatus::converged;
      result.text = fmt::format("from {} and {}", describe(low), describe(high));
    }
    return result;
  }
  result.iterations = most_iterations;
  result.status = TwoPointStatus::not_converging;
  result.text = fmt::format("C_H and C_A still change after {} iterations on {} and {}",
                            most_iterations, describe(low), describe(high));
  return result;
}

}  // namespace recoil
