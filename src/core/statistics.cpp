#include "core/statistics.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

namespace recoil {
namespace {

/// A rank, from 0, clamped to the sample.
double clamped_rank(double rank, std::size_t count) {
  return std::clamp(rank, 0.0, static_cast<double>(count) - 1.0);
}

double at_rank(std::span<const double> ascending, double rank) {
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, ascending.size() - 1);
  const double part = rank - static_cast<double>(below);
  return ascending[below] + part * (ascending[above] - ascending[below]);
}

double quantile_rank(double p, std::size_t count) {
  return p * (static_cast<double>(count) + 1.0) - 1.0;
}

}  // namespace

double mean(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

double standard_deviation(std::span<const double> values) {
  if (values.size() < 2) return 0.0;
  const double middle = mean(values);
  double squares = 0.0;
  for (const double value : values) squares += (value - middle) * (value - middle);
  return std::sqrt(squares / (static_cast<double>(values.size()) - 1.0));
}

double sorted_quantile(std::span<const double> ascending, double p) {
  return at_rank(ascending, clamped_rank(quantile_rank(p, ascending.size()), ascending.size()));
}

double quantile_error(std::span<const double> ascending, double p, double rank_sd) {
  const double count = static_cast<double>(ascending.size());
  const double sd = rank_sd < 0.0 ? std::sqrt(count * p * (1.0 - p)) : rank_sd;
  const double rank = quantile_rank(p, ascending.size());
  const double low = clamped_rank(rank - sd, ascending.size());
  const double high = clamped_rank(rank + sd, ascending.size());
  if (!(high > low)) return 0.0;
  // If the sample ends within one standard deviation, the remaining distance is scaled up.
  return (at_rank(ascending, high) - at_rank(ascending, low)) * sd / (high - low);
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

double robust_sd(std::vector<double> values) {
  const double middle = median(values);
  for (double& value : values) value = std::abs(value - middle);
  return 1.4826 * median(std::move(values));
}

double poisson_at_least(std::size_t count, double mean) {
  if (count == 0) return 1.0;
  if (!(mean > 0.0)) return 0.0;
  // Sums p_j = mean^j exp(-mean) / j! on the side of `count` away from the mean, where they fall.
  // The logarithm of the first term does not underflow. (gsl_cdf_poisson_Q fails at some means of
  // 1e5.)
  const bool above = static_cast<double>(count) > mean;
  double j = static_cast<double>(above ? count : count - 1);
  double term = std::exp(j * std::log(mean) - mean - std::lgamma(j + 1.0));
  double sum = 0.0;
  while (term > 1e-17 * sum) {
    sum += term;
    if (above) {
      j += 1.0;
      term *= mean / j;
    } else {
      if (j == 0.0) break;
      term *= j / mean;
      j -= 1.0;
    }
  }
  return above ? sum : 1.0 - sum;
}

ShareLimits share_limits(int part, int whole) {
  const double n = whole;
  const double share = part / n;
  const double z = gsl_cdf_ugaussian_Pinv(0.975);
  const double middle = (share + z * z / (2.0 * n)) / (1.0 + z * z / n);
  const double half =
      z / (1.0 + z * z / n) * std::sqrt(share * (1.0 - share) / n + z * z / (4.0 * n * n));
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

}  // namespace recoil
