#include "uncertainty/intervals.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

namespace recoil {
namespace {

constexpr std::size_t fewest_replicates = 39;  // (B + 1) 0.025 >= 1

Interval missing(std::string why) {
  Interval interval;
  interval.why = std::move(why);
  return interval;
}

}  // namespace

double sorted_quantile(std::span<const double> ascending, double p) {
  const double position = p * (static_cast<double>(ascending.size()) + 1.0) - 1.0;
  const double last = static_cast<double>(ascending.size()) - 1.0;
  const double clamped = std::clamp(position, 0.0, last);
  const std::size_t below = static_cast<std::size_t>(clamped);
  const std::size_t above = std::min(below + 1, ascending.size() - 1);
  const double part = clamped - static_cast<double>(below);
  return ascending[below] + part * (ascending[above] - ascending[below]);
}

Interval percentile_interval(std::vector<double> replicates, double level) {
  if (replicates.size() < fewest_replicates) return missing("fewer than 39 usable replicates");
  std::sort(replicates.begin(), replicates.end());
  const double tail = (1.0 - level) / 2.0;
  Interval interval;
  interval.lower = sorted_quantile(replicates, tail);
  interval.upper = sorted_quantile(replicates, 1.0 - tail);
  return interval;
}

std::optional<BcaConstants> bca_constants(std::span<const double> replicates, double estimate,
                                          std::span<const double> delete_one) {
  double below = 0.0;
  for (const double r : replicates) below += r < estimate ? 1.0 : r == estimate ? 0.5 : 0.0;
  const double fraction = below / static_cast<double>(replicates.size());
  if (!(fraction > 0.0) || !(fraction < 1.0)) return std::nullopt;
  double mean = 0.0;
  for (const double v : delete_one) mean += v / static_cast<double>(delete_one.size());
  double square = 0.0;
  double cube = 0.0;
  for (const double v : delete_one) {
    square += std::pow(mean - v, 2);
    cube += std::pow(mean - v, 3);
  }
  BcaConstants constants;
  constants.bias = gsl_cdf_ugaussian_Pinv(fraction);
  constants.acceleration = square > 0.0 ? cube / (6.0 * std::pow(square, 1.5)) : 0.0;
  return constants;
}

Interval bca_interval(std::vector<double> replicates, double estimate,
                      std::span<const double> delete_one, double level) {
  if (replicates.size() < fewest_replicates) return missing("fewer than 39 usable replicates");
  if (delete_one.size() < 3) return missing("fewer than three delete-one refits succeeded");
  const auto constants = bca_constants(replicates, estimate, delete_one);
  if (!constants) return missing("all replicates lie on one side of the estimate, as at a bound");
  std::sort(replicates.begin(), replicates.end());
  const auto end = [&](double p) {
    const double z = constants->bias + gsl_cdf_ugaussian_Pinv(p);
    const double adjusted =
        gsl_cdf_ugaussian_P(constants->bias + z / (1.0 - constants->acceleration * z));
    return sorted_quantile(replicates, adjusted);
  };
  const double tail = (1.0 - level) / 2.0;
  Interval interval;
  interval.lower = end(tail);
  interval.upper = end(1.0 - tail);
  return interval;
}

Interval studentized_interval(std::span<const double> replicates,
                              std::span<const double> replicate_errors, double estimate,
                              double std_error, double level, double lower, double upper) {
  if (!(std_error > 0.0)) return missing("no standard error (at a bound, or not determined)");
  std::vector<double> pivots;
  for (std::size_t i = 0; i < replicates.size(); ++i) {
    if (replicate_errors[i] > 0.0) {
      pivots.push_back((replicates[i] - estimate) / replicate_errors[i]);
    }
  }
  constexpr double most_without_error = 0.1;
  const double left_out = static_cast<double>(replicates.size() - pivots.size());
  if (left_out > most_without_error * static_cast<double>(replicates.size())) {
    return missing("more than a tenth of the replicates rest on a bound and have no error");
  }
  if (pivots.size() < fewest_replicates) return missing("fewer than 39 usable replicates");
  std::sort(pivots.begin(), pivots.end());
  const double tail = (1.0 - level) / 2.0;
  Interval interval;
  interval.lower = std::max(lower, estimate - std_error * sorted_quantile(pivots, 1.0 - tail));
  interval.upper = std::min(upper, estimate - std_error * sorted_quantile(pivots, tail));
  return interval;
}

Interval wald_interval(double estimate, double std_error, double level, int dof, double lower,
                       double upper) {
  if (!(std_error > 0.0)) return missing("no standard error (at a bound, or not determined)");
  const double tail = 0.5 + level / 2.0;
  const double quantile = dof > 0 ? gsl_cdf_tdist_Pinv(tail, dof) : gsl_cdf_ugaussian_Pinv(tail);
  Interval interval;
  interval.lower = std::max(lower, estimate - quantile * std_error);
  interval.upper = std::min(upper, estimate + quantile * std_error);
  return interval;
}

}  // namespace recoil
