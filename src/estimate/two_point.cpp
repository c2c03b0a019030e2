#include "estimate/two_point.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "estimate/predictor.hpp"

namespace recoil {
namespace {

constexpr int most_iterations = 200;
constexpr double at_rest = 1e-8;  // relative change of both factors
// Relative, of each factor; the error after the last Newton step is far smaller.
constexpr double root_tolerance = 1e-9;

/// C_H, which the fast point determines, and C_A, which the slow point determines [s/m].
using Dampings = std::array<double, 2>;

/// The fast and the slow point, and what the model predicts for them.
class TwoPoints {
 public:
  /// @param theta every parameter but the dampings [slots]
  TwoPoints(const ImpactModel& model, std::vector<double> theta, const Observation& fast,
            const Observation& slow)
      : predictors_{PointPredictor(model, {fast.conditions()}),
                    PointPredictor(model, {slow.conditions()})},
        slots_{model.slot_C_H[fast.dataset], model.slot_C_A[fast.dataset]},
        upper_{model.slots[slots_[0]].upper, model.slots[slots_[1]].upper},
        measured_{fast.restitution, slow.restitution},
        theta_(std::move(theta)),
        row_(theta_.size()) {}

  const std::vector<double>& theta() const { return theta_; }
  Dampings dampings() const { return {theta_[slots_[0]], theta_[slots_[1]]}; }

  void set_damping(std::size_t k, double value) { theta_[slots_[k]] = value; }

  /// The damping `k` in [0, upper] at which the model gives the e of point `k`, by Newton's method
  /// within a bracket from the present damping. Nullopt if e is too low without damping or too high
  /// with the largest, or if an impact cannot be solved.
  std::optional<double> solve_one(std::size_t k) {
    constexpr int most_steps = 200;
    double damping = theta_[slots_[k]];
    double low = 0.0;
    double high = upper_[k];
    bool root_above_zero = false;  // the excess without damping is not negative
    for (int step = 0; step < most_steps; ++step) {
      set_damping(k, damping);
      const double value = excess(k);
      if (!std::isfinite(value)) return std::nullopt;
      if (damping == 0.0) {
        if (value < 0.0) return std::nullopt;
        root_above_zero = true;
      }
      if (value > 0.0 && damping >= upper_[k]) return std::nullopt;
      (value > 0.0 ? low : high) = damping;
      double next = damping - value / slope(k, k);
      if (next <= 0.0 && !root_above_zero) {
        next = 0.0;
      } else if (!(next > low) || !(next < high)) {
        // From below a root, Newton's method may overshoot into the flat or captured range.
        next = low > 0.0 ? std::min(4.0 * low, std::sqrt(low * high)) : 0.25 * high;
        if (high == upper_[k] && next > 0.5 * upper_[k]) next = upper_[k];
      }
      if (next > 0.0 && std::abs(next - damping) <= root_tolerance * next) return next;
      damping = next;
    }
    return damping;
  }

  /// Finds both dampings at once by Newton's method from `near`. False if a step leaves the bounds,
  /// if Newton's method does not converge, or if the paper's iteration would not converge there.
  bool solve_both(const Dampings& near) {
    constexpr int most_steps = 12;
    for (std::size_t k = 0; k < 2; ++k) set_damping(k, near[k]);
    for (int step = 0; step < most_steps; ++step) {
      const Eigen::Vector2d excesses(excess(0), excess(1));
      if (!excesses.allFinite()) return false;
      Eigen::Matrix2d slopes;
      slopes << slope(0, 0), slope(0, 1), slope(1, 0), slope(1, 1);
      const Eigen::Vector2d by = -slopes.inverse() * excesses;
      bool rests = true;
      for (std::size_t k = 0; k < 2; ++k) {
        const double change = by(static_cast<Eigen::Index>(k));
        const double next = theta_[slots_[k]] + change;
        if (!(next > 0.0 && next < upper_[k])) return false;
        rests = rests && std::abs(change) <= root_tolerance * next;
        set_damping(k, next);
      }
      // The paper's iteration converges here if a change of one factor changes the other by less.
      if (rests) {
        return std::abs(slopes(0, 1) * slopes(1, 0)) < std::abs(slopes(0, 0) * slopes(1, 1));
      }
    }
    return false;
  }

 private:
  /// e^2 of the model minus that of point `i`; NaN if the impact cannot be solved.
  double excess(std::size_t i) {
    predictors_[i].evaluate(theta_, true);
    const ImpactResult& impact = predictors_[i].at(0);
    return impact.usable() ? impact.restitution_squared - measured_[i] * measured_[i] : NAN;
  }
  /// d e^2 of point `i` / d damping `k` where `excess` was evaluated last [m/s].
  double slope(std::size_t i, std::size_t k) {
    predictors_[i].gradient_row(0, 1.0, row_);
    return row_[slots_[k]];
  }

  std::array<PointPredictor, 2> predictors_;
  std::array<std::size_t, 2> slots_;
  Dampings upper_;
  std::array<double, 2> measured_;
  std::vector<double> theta_;
  std::vector<double> row_;
};

/// Runs the paper's iteration from C_H = C_A = 0; sets status and iterations.
void iterate(TwoPoints& points, TwoPointResult& result) {
  result.status = TwoPointStatus::not_converging;
  points.set_damping(0, 0.0);
  points.set_damping(1, 0.0);
  for (result.iterations = 1;; ++result.iterations) {
    std::array<bool, 2> found{};
    bool moved = false;
    for (std::size_t k = 0; k < 2; ++k) {
      const double before = points.dampings()[k];
      const std::optional<double> damping = points.solve_one(k);
      const double now = damping.value_or(0.0);
      points.set_damping(k, now);
      found[k] = damping.has_value();
      moved = moved || std::abs(now - before) > at_rest * now;
    }
    if (!moved) {
      result.status = !found[0]   ? TwoPointStatus::no_hertz_damping
                      : !found[1] ? TwoPointStatus::no_adhesion_damping
                                  : TwoPointStatus::converged;
      return;
    }
    if (result.iterations == most_iterations) return;
  }
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
  if (!choose_points(data, dataset, diameter, result)) return result;
  std::vector<double> theta = without_mechanisms(model, model.initial());
  const std::size_t adhesion = model.slot_adhesion[dataset];
  if (model.slots[adhesion].free) theta[adhesion] = derived_adhesion(model, dataset);
  TwoPoints points(model, std::move(theta), data.points[result.high_point],
                   data.points[result.low_point]);
  if (!near.empty() &&
      points.solve_both({near[model.slot_C_H[dataset]], near[model.slot_C_A[dataset]]})) {
    result.status = TwoPointStatus::converged;
    result.iterations = 1;
  } else {
    iterate(points, result);
  }
  result.theta = points.theta();
  return result;
}

}  // namespace recoil
