#include "uncertainty/profile.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "estimate/impact_problem.hpp"
#include "uncertainty/intervals.hpp"
#include "uncertainty/profile_end.hpp"
#include "uncertainty/refit.hpp"

namespace recoil {

namespace {

constexpr int curve_steps = 14;  // on either side of the estimate
// Reach of a curve, over the distance from the estimate to the end.
constexpr double curve_reach = 1.4;

class Profile {
 public:
  Profile(const FitResult& fitted, std::size_t slot)
      : fitted_(fitted), kept_{fitted.theta, fitted.weights}, last_(kept_), slot_(slot) {
    problem_ = impact_problem(fitted.model, fitted.data, last_.weights);
    problem_.fixed[slot] = true;
    least_ = fitted.objective + event_spread_offset(fitted.data, fitted.weights);
  }

  /// The increase of chi2 over its minimum with the slot at `value`, minimised over the other
  /// parameters and the spread of the impacts from the kept place. Nullopt if it fails.
  std::optional<double> rise(double value) {
    last_ = kept_;
    auto& [others, weights] = last_;
    follow(value, others);
    double before = INFINITY;
    for (int round = 0; round < most_rounds; ++round) {
      const LeastSquaresResult refit = minimise(problem_, others, options_);
      if (!refit.ended()) return std::nullopt;
      others = refit.theta;
      const double now = refit.sum_of_squares + event_spread_offset(fitted_.data, weights) - least_;
      if (!(weights.noise.event_spread > 0.0) || std::abs(before - now) < at_rest) return now;
      before = now;
      auto renewed = with_event_spread_at(fitted_.model, fitted_.data, weights, others);
      if (!renewed) return std::nullopt;
      weights = std::move(*renewed);
    }
    return before;
  }

  /// Keeps the place where the last refit ended.
  void keep() { kept_ = last_; }
  /// Keeps the fit itself.
  void restart() { kept_ = {fitted_.theta, fitted_.weights}; }

 private:
  /// Moves the slot to `value` and the other parameters with it, as they do to first order.
  void follow(double value, std::vector<double>& others) const {
    const std::size_t p = others.size();
    const double by = value - others[slot_];
    const double variance =
        fitted_.covariance.empty() ? 0.0 : fitted_.covariance[slot_ * p + slot_];
    for (std::size_t j = 0; j < p && variance > 0.0; ++j) {
      const ParameterSlot& other = fitted_.model.slots[j];
      const double at = others[j] + by * fitted_.covariance[slot_ * p + j] / variance;
      if (at > other.lower && at < other.upper) others[j] = at;
    }
    others[slot_] = value;
  }

  static constexpr int most_rounds = 12;
  // Tolerance of the rise: a thousandth of the interval's width.
  static constexpr double at_rest = 5e-3;

  struct Place {
    std::vector<double> theta;
    Weights weights;  ///< with the spread of the impacts there
  };

  const FitResult& fitted_;
  Place kept_, last_;
  LeastSquaresProblem problem_;
  std::size_t slot_;
  const LeastSquaresOptions options_ = refit_options();
  double least_ = 0.0;
};

/// The allowed rise of the profile at a value of the slot: smaller near a bound, see
/// `profile_quantile`.
class Allowance {
 public:
  Allowance(const ParameterSlot& slot, double level, int dof, double scale, double error)
      : slot_(slot), level_(level), dof_(dof), scale_(scale), error_(error) {}

  double operator()(double value) const {
    const double room = std::min(value - slot_.lower, slot_.upper - value);
    const double distance = error_ > 0.0 ? room / error_ : INFINITY;
    return scale_ * profile_quantile(level_, dof_, distance);
  }

 private:
  const ParameterSlot& slot_;
  double level_;
  int dof_;
  double scale_;
  double error_;
};

/// The standard error of the slot without its bound: from J'J of the slot and the other moving
/// parameters. 0 if J'J is singular.
double free_standard_error(const FitResult& fitted, std::size_t slot) {
  if (fitted.std_error[slot] > 0.0) return fitted.std_error[slot];
  const LeastSquaresProblem problem = impact_problem(fitted.model, fitted.data, fitted.weights);
  const std::size_t n = problem.residual_count;
  const std::size_t p = fitted.theta.size();
  std::vector<double> residuals(n);
  std::vector<double> jacobian(n * p);
  if (!problem.evaluate(fitted.theta, residuals, jacobian)) return 0.0;
  std::vector<std::size_t> moving = {slot};
  for (std::size_t j = 0; j < p; ++j) {
    if (j != slot && fitted.std_error[j] > 0.0) moving.push_back(j);
  }
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(moving.size()));
  for (std::size_t k = 0; k < moving.size(); ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      columns(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          jacobian[i * p + moving[k]];
    }
  }
  // The norm of the slot's column, orthogonal to the other columns, is 1 / error.
  const Eigen::VectorXd own = columns.col(0);
  const Eigen::MatrixXd others = columns.rightCols(columns.cols() - 1);
  Eigen::VectorXd beyond = own;
  if (others.cols() > 0) beyond -= others * others.colPivHouseholderQr().solve(own);
  const double information = beyond.norm();
  constexpr double singular = 1e-7;
  return information > singular * own.norm() ? fitted.noise_scale / information : 0.0;
}

/// Widens an interval of one slot by the errors of constants that the fit holds. An end at the
/// distance d from the estimate, z standard errors in the profile, moves to sqrt(d^2 + (z s)^2).
/// Here z s is the shift of the estimate on that side when the constants change by z of their
/// standard deviations, one at a time, added in quadrature. s comes from refits at `most_z`, where
/// intervals end, and is taken as constant.
class ConstantErrors {
 public:
  ConstantErrors(const FitResult& fitted, std::size_t slot)
      : slot_(fitted.model.slots[slot]), estimate_(fitted.theta[slot]) {
    for (std::size_t k = 0; k < fitted.constant_effects.size(); ++k) {
      // A constant that adds less than 1 % of the variance is treated to first order.
      const double linear = fitted.constant_effects[k][slot];
      if (std::abs(linear) < 0.1 * fitted.std_error[slot]) {
        add(linear);
        add(-linear);
        continue;
      }
      for (const double by : {-most_z, most_z}) {
        const auto theta = estimate_with_constant_moved(fitted, k, by);
        add(theta ? ((*theta)[slot] - estimate_) / most_z : std::copysign(1.0, by) * linear);
      }
    }
    for (double& error : error_) error = std::sqrt(error);
  }

  /// The widened end for `value`, which is `z` standard errors away; within the bounds.
  double widened(double value, double z) const { return moved(value, z, 1.0); }
  /// The inverse of `widened`; the estimate if there is none.
  double narrowed(double value, double z) const { return moved(value, z, -1.0); }
  /// The constants' part of the standard error over the distance from the estimate.
  double ratio(double value) const {
    return value == estimate_ ? 0.0 : error_[value > estimate_] / std::abs(value - estimate_);
  }

 private:
  static constexpr double most_z = 1.96;

  void add(double by) { error_[by > 0.0] += by * by; }
  double moved(double value, double z, double sign) const {
    const double d = value - estimate_;
    const double by = z * error_[d > 0.0];
    const double reach = std::sqrt(std::max(0.0, d * d + sign * by * by));
    return std::clamp(estimate_ + std::copysign(reach, d), slot_.lower, slot_.upper);
  }
  const ParameterSlot& slot_;
  double estimate_;
  std::array<double, 2> error_ = {};  // below and above the estimate
};

Allowance allowance(const FitResult& fitted, std::size_t slot, double level, double error) {
  return {fitted.model.slots[slot], level, degrees_of_freedom(fitted, slot),
          fitted.noise_scale * fitted.noise_scale, error};
}

}  // namespace

Interval profile_interval(const FitResult& fitted, std::size_t slot, double level) {
  const double error = free_standard_error(fitted, slot);
  const Allowance allowed = allowance(fitted, slot, level, error);
  Profile profile(fitted, slot);
  const double value = fitted.theta[slot];
  // Where the rise is quadratic, the first step ends just outside.
  const double reach =
      fitted.noise_scale > 0.0 ? 1.05 * std::sqrt(allowed(value)) / fitted.noise_scale : 1.0;
  double stride = error > 0.0 ? reach * error : 0.1 * std::abs(value);
  if (!(stride > 0.0)) {
    const double start = std::abs(fitted.model.slots[slot].initial);
    stride = start > 0.0 ? 0.1 * start : 1e-3 * fitted.model.slots[slot].upper;
  }
  const ProfileWalk walk = {[&](double at) { return profile.rise(at); }, [&] { profile.keep(); }};
  const auto low = find_profile_end(walk, value, fitted.model.slots[slot].lower, stride, allowed);
  profile.restart();
  const auto high = find_profile_end(walk, value, fitted.model.slots[slot].upper, stride, allowed);
  if (!low || !high) {
    return no_interval(low    ? NoInterval::no_upper_end
                       : high ? NoInterval::no_lower_end
                              : NoInterval::no_ends);
  }
  const ConstantErrors constants(fitted, slot);
  const auto end = [&](const ProfileEnd& of) {
    if (of.at_bound || !(fitted.noise_scale > 0.0)) return of.value;
    return constants.widened(of.value, std::sqrt(allowed(of.value)) / fitted.noise_scale);
  };
  Interval interval;
  interval.lower = end(*low);
  interval.upper = end(*high);
  interval.shape = low->at_bound && high->at_bound   ? ProfileShape::flat
                   : low->at_bound || high->at_bound ? ProfileShape::one_sided
                                                     : ProfileShape::bounded;
  return interval;
}

std::vector<ProfilePoint> profile_curve(const FitResult& fitted, std::size_t slot, double level,
                                        const Interval& interval) {
  if (!interval.available() || !(fitted.noise_scale > 0.0)) return {};
  Profile profile(fitted, slot);
  const Allowance allowed = allowance(fitted, slot, level, free_standard_error(fitted, slot));
  const ParameterSlot& parameter = fitted.model.slots[slot];
  const double estimate = fitted.theta[slot];
  const double scale = fitted.noise_scale * fitted.noise_scale;
  const ConstantErrors constants(fitted, slot);
  const auto point = [&](double value, double rise) {
    const double height = std::max(rise, 0.0) / scale;
    return ProfilePoint{constants.widened(value, std::sqrt(height)), height,
                        allowed(value) / scale};
  };
  std::vector<ProfilePoint> curve;
  for (const double direction : {-1.0, 1.0}) {
    const double quoted = direction < 0.0 ? *interval.lower : *interval.upper;
    const double end = constants.narrowed(quoted, std::sqrt(allowed(quoted) / scale));
    const double last =
        std::clamp(estimate + curve_reach * (end - estimate), parameter.lower, parameter.upper);
    profile.restart();
    for (int k = 1; k <= curve_steps && last != estimate; ++k) {
      const double value = estimate + (last - estimate) * k / curve_steps;
      const auto rise = profile.rise(value);
      if (!rise) break;
      profile.keep();
      curve.push_back(point(value, *rise));
    }
    if (direction < 0.0) {
      std::reverse(curve.begin(), curve.end());
      curve.push_back(point(estimate, 0.0));
    }
  }
  return curve;
}

}  // namespace recoil
