#include "uncertainty/profile.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "estimate/impact_problem.hpp"

namespace recoil {
namespace {

constexpr int most_strides = 60;
constexpr int most_bisections = 60;
constexpr double end_tolerance = 1e-3;  // of the rise at an interval's end

class Profile {
 public:
  Profile(const FitResult& fitted, const Observations& data, std::size_t slot)
      : fitted_(fitted), problem_(impact_problem(fitted.model, data)), slot_(slot) {
    problem_.fixed[slot] = true;
    options_.covariance = false;
    options_.function_tolerance = 1e-10;
  }

  /// chi2 minimised over the others with the slot at `value`, above the minimum; `others` is both
  /// the start and the end of the refit. Nothing when it fails.
  std::optional<double> rise(double value, std::vector<double>& others) const {
    others[slot_] = value;
    const LeastSquaresResult refit = minimise(problem_, others, options_);
    if (!refit.converged) return std::nullopt;
    others = refit.theta;
    return refit.sum_of_squares - fitted_.chi2;
  }

 private:
  const FitResult& fitted_;
  LeastSquaresProblem problem_;
  std::size_t slot_;
  LeastSquaresOptions options_;
};

/// One end of the interval, walking from the estimate in `direction` until the rise exceeds
/// `allowed`, then closing in by regula falsi (Illinois). Nothing when a refit fails.
struct End {
  double value;
  bool at_bound;
};
std::optional<End> find_end(const Profile& profile, const FitResult& fitted, std::size_t slot,
                            double direction, double allowed, double stride) {
  const ParameterSlot& parameter = fitted.model.slots[slot];
  const double bound = direction < 0.0 ? parameter.lower : parameter.upper;
  std::vector<double> others = fitted.theta;
  double inside = fitted.theta[slot];
  double rise_inside = 0.0;
  double outside = inside;
  double rise_outside = 0.0;
  if (inside == bound) return End{bound, true};
  for (int i = 0;; ++i) {
    if (i == most_strides) return std::nullopt;
    outside = inside + direction * stride;
    if (direction * (outside - bound) >= 0.0) outside = bound;
    const auto rise = profile.rise(outside, others);
    if (!rise) return std::nullopt;
    rise_outside = *rise;
    if (rise_outside > allowed) break;
    if (outside == bound) return End{bound, true};
    inside = outside;
    rise_inside = rise_outside;
    stride *= 1.6;
  }
  // sqrt(rise) is nearly linear in the parameter, so the false position converges at once.
  double f_in = std::sqrt(std::max(rise_inside, 0.0)) - std::sqrt(allowed);
  double f_out = std::sqrt(rise_outside) - std::sqrt(allowed);
  for (int i = 0; i < most_bisections; ++i) {
    const double guess = outside - f_out * (outside - inside) / (f_out - f_in);
    const auto rise = profile.rise(guess, others);
    if (!rise) return std::nullopt;
    if (std::abs(*rise - allowed) <= end_tolerance * allowed) return End{guess, false};
    const double f = std::sqrt(std::max(*rise, 0.0)) - std::sqrt(allowed);
    if (f > 0.0) {
      outside = guess;
      f_out = f;
      f_in *= 0.5;
    } else {
      inside = guess;
      f_in = f;
      f_out *= 0.5;
    }
  }
  return End{inside, false};
}

}  // namespace

Interval profile_interval(const FitResult& fitted, const Observations& data, std::size_t slot,
                          double level) {
  Interval interval;
  const double scale = fitted.noise_scale * fitted.noise_scale;
  // The quantile of F(1, dof) is the square of Student's.
  const double student = fitted.dof > 0 ? gsl_cdf_tdist_Pinv(0.5 + level / 2.0, fitted.dof) : 0.0;
  const double quantile =
      data.sd_stated || fitted.dof <= 0 ? gsl_cdf_chisq_Pinv(level, 1.0) : student * student;
  const double allowed = quantile * scale;
  const Profile profile(fitted, data, slot);
  const double value = fitted.theta[slot];
  double stride = fitted.std_error[slot] > 0.0 ? fitted.std_error[slot] : 0.1 * std::abs(value);
  if (!(stride > 0.0)) {
    const double start = std::abs(fitted.model.slots[slot].initial);
    stride = start > 0.0 ? 0.1 * start : 1e-3 * fitted.model.slots[slot].upper;
  }
  const auto low = find_end(profile, fitted, slot, -1.0, allowed, stride);
  const auto high = find_end(profile, fitted, slot, +1.0, allowed, stride);
  if (!low || !high) {
    interval.why = "a constrained refit along the profile failed";
    return interval;
  }
  interval.lower = low->value;
  interval.upper = high->value;
  interval.shape = low->at_bound && high->at_bound   ? "flat"
                   : low->at_bound || high->at_bound ? "one-sided"
                                                     : "bounded";
  return interval;
}

}  // namespace recoil
