#include "uncertainty/intervals.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>

#include <algorithm>
#include <cmath>

#include "core/numerics.hpp"
#include "core/statistics.hpp"
#include "estimate/least_squares.hpp"

namespace recoil {

double student_probability(double x, int dof) {
  return dof > 0 ? gsl_cdf_tdist_P(x, dof) : gsl_cdf_ugaussian_P(x);
}

double student_quantile(double p, int dof) {
  return dof > 0 ? gsl_cdf_tdist_Pinv(p, dof) : gsl_cdf_ugaussian_Pinv(p);
}

Interval percentile_interval(std::vector<double> replicates, double level) {
  if (replicates.size() < fewest_replicates(level)) return no_interval(NoInterval::few_replicates);
  std::sort(replicates.begin(), replicates.end());
  const double tail = (1.0 - level) / 2.0;
  Interval interval;
  interval.lower = sorted_quantile(replicates, tail);
  interval.upper = sorted_quantile(replicates, 1.0 - tail);
  interval.lower_error = quantile_error(replicates, tail);
  interval.upper_error = quantile_error(replicates, 1.0 - tail);
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

std::optional<double> bca_level(const BcaConstants& constants, double p) {
  const double w = constants.bias + gsl_cdf_ugaussian_Pinv(p);
  const double room = 1.0 - constants.acceleration * w;
  if (!(room > 0.0)) return std::nullopt;
  return gsl_cdf_ugaussian_P(constants.bias + w / room);
}

namespace {

/// Standard deviation of the rank of a BCa end among the replicates. With F the empirical
/// distribution, the end solves F(x) = q(z0), z0 = Phi^-1(F(estimate)); to first order the rank
/// changes by B [g (F(estimate) - below) - (F(x) - q)], g = (dq/dz0) / phi(z0), and the covariance
/// of F at two points is (min - product) / B.
double bca_rank_sd(const BcaConstants& constants, double p, double q, double count) {
  const double below = gsl_cdf_ugaussian_P(constants.bias);
  const double w = constants.bias + gsl_cdf_ugaussian_Pinv(p);
  const double room = 1.0 - constants.acceleration * w;
  const double z = constants.bias + w / room;
  const double per_bias = gsl_ran_ugaussian_pdf(z) * (1.0 + 1.0 / (room * room));
  const double g = per_bias / gsl_ran_ugaussian_pdf(constants.bias);
  const double variance =
      q * (1.0 - q) + g * g * below * (1.0 - below) - 2.0 * g * (std::min(q, below) - q * below);
  return std::sqrt(std::max(variance, 0.0) * count);
}

}  // namespace

Interval bca_interval(std::vector<double> replicates, double estimate,
                      std::span<const double> delete_one, double level) {
  if (replicates.empty()) return no_interval(NoInterval::few_replicates);
  if (delete_one.size() < 3) return no_interval(NoInterval::few_delete_one_refits);
  const auto constants = bca_constants(replicates, estimate, delete_one);
  if (!constants) return no_interval(NoInterval::one_sided_replicates);
  const double tail = (1.0 - level) / 2.0;
  const auto low = bca_level(*constants, tail);
  const auto high = bca_level(*constants, 1.0 - tail);
  if (!low || !high) {
    return no_interval(NoInterval::large_acceleration);
  }
  if (replicates.size() < fewest_replicates(level)) return no_interval(NoInterval::few_replicates);
  std::sort(replicates.begin(), replicates.end());
  const double count = static_cast<double>(replicates.size());
  Interval interval;
  interval.lower = sorted_quantile(replicates, *low);
  interval.upper = sorted_quantile(replicates, *high);
  interval.lower_error =
      quantile_error(replicates, *low, bca_rank_sd(*constants, tail, *low, count));
  interval.upper_error =
      quantile_error(replicates, *high, bca_rank_sd(*constants, 1.0 - tail, *high, count));
  return interval;
}

Interval studentized_interval(std::span<const double> replicates,
                              std::span<const double> replicate_errors, double estimate,
                              double std_error, double level, double lower, double upper) {
  if (!(std_error > 0.0)) return no_interval(NoInterval::no_standard_error);
  std::vector<double> pivots;
  for (std::size_t i = 0; i < replicates.size(); ++i) {
    if (replicate_errors[i] > 0.0) {
      pivots.push_back((replicates[i] - estimate) / replicate_errors[i]);
    }
  }
  constexpr double most_without_error = 0.1;
  const double left_out = static_cast<double>(replicates.size() - pivots.size());
  if (left_out > most_without_error * static_cast<double>(replicates.size())) {
    return no_interval(NoInterval::replicates_without_error);
  }
  if (pivots.size() < fewest_replicates(level)) return no_interval(NoInterval::few_replicates);
  std::sort(pivots.begin(), pivots.end());
  const double tail = (1.0 - level) / 2.0;
  Interval interval;
  interval.lower = std::max(lower, estimate - std_error * sorted_quantile(pivots, 1.0 - tail));
  interval.upper = std::min(upper, estimate - std_error * sorted_quantile(pivots, tail));
  interval.lower_error = std_error * quantile_error(pivots, 1.0 - tail);
  interval.upper_error = std_error * quantile_error(pivots, tail);
  return interval;
}

Interval wald_interval(double estimate, double std_error, double level, int dof, double lower,
                       double upper) {
  if (!(std_error > 0.0)) return no_interval(NoInterval::no_standard_error);
  const double tail = 0.5 + level / 2.0;
  const double quantile = student_quantile(tail, dof);
  Interval interval;
  interval.lower = std::max(lower, estimate - quantile * std_error);
  interval.upper = std::min(upper, estimate + quantile * std_error);
  return interval;
}

Interval averaged_wald_interval(std::span<const WaldTerm> terms, double level, double lower,
                                double upper) {
  const WaldTerm& chosen = terms.front();
  Interval interval =
      wald_interval(chosen.estimate, chosen.std_error, level, chosen.dof, lower, upper);
  if (!interval.available() || terms.size() == 1) return interval;
  double total = 0.0;
  for (const WaldTerm& term : terms) total += term.std_error > 0.0 ? term.weight : 0.0;
  const auto end = [&](double p) {
    double low = INFINITY;
    double high = -INFINITY;
    for (const WaldTerm& term : terms) {
      if (!(term.std_error > 0.0)) continue;
      const double own = term.estimate + student_quantile(p, term.dof) * term.std_error;
      low = std::min(low, own);
      high = std::max(high, own);
    }
    const auto excess = [&](double value) {
      double below = 0.0;
      for (const WaldTerm& term : terms) {
        if (!(term.std_error > 0.0)) continue;
        below += term.weight / total *
                 student_probability((value - term.estimate) / term.std_error, term.dof);
      }
      return below - p;
    };
    // If all terms are equal, the ends agree up to rounding.
    const double found = low < high ? find_root(excess, low, high) : low;
    return std::isnan(found) ? 0.5 * (low + high) : found;
  };
  interval.lower = std::max(lower, end(0.5 - level / 2.0));
  interval.upper = std::min(upper, end(0.5 + level / 2.0));
  return interval;
}

double profile_quantile(double level, int dof, double distance) {
  const double far = std::pow(student_quantile(0.5 + level / 2.0, dof), 2);
  if (distance * distance >= far) return far;
  const double on_bound = level > 0.5 ? std::pow(student_quantile(level, dof), 2) : 0.0;
  if (!(distance > 0.0)) return on_bound;
  // The probability increases with c; at the ends it may equal the level up to rounding.
  const auto excess = [&](double c) {
    return student_probability(std::sqrt(c), dof) -
           student_probability(-(c + distance * distance) / (2.0 * distance), dof) - level;
  };
  if (!(excess(on_bound) < 0.0)) return on_bound;
  if (!(excess(far) > 0.0)) return far;
  return find_root(excess, on_bound, far);
}

std::vector<double> sandwich_covariance(std::span<const double> residuals,
                                        std::span<const double> jacobian,
                                        std::span<const double> covariance) {
  const std::vector<double> h = leverages(jacobian, covariance);
  const std::size_t n = residuals.size();
  const std::size_t p = n == 0 ? 0 : jacobian.size() / n;
  std::vector<double> sandwich(p * p, 0.0);
  std::vector<double> step(p);  // influence of point i on every parameter
  for (std::size_t i = 0; i < h.size(); ++i) {
    const double scaled = residuals[i] / (1.0 - std::min(h[i], most_leverage));
    for (std::size_t a = 0; a < p; ++a) {
      step[a] = 0.0;
      for (std::size_t b = 0; b < p; ++b) step[a] += covariance[a * p + b] * jacobian[i * p + b];
    }
    for (std::size_t a = 0; a < p; ++a) {
      for (std::size_t b = 0; b < p; ++b) {
        sandwich[a * p + b] += step[a] * step[b] * scaled * scaled;
      }
    }
  }
  return sandwich;
}

}  // namespace recoil
