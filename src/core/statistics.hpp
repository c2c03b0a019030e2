#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace recoil {

/// The arithmetic mean; 0 if there are no values.
double mean(std::span<const double> values);

/// The sample standard deviation, with n - 1; 0 for fewer than two values.
double standard_deviation(std::span<const double> values);

/// The p-quantile of an ascending sample by the (B + 1) p rule with linear interpolation, clamped
/// to the sample (Davison & Hinkley 1997, section 5.2.1; type 6 of Hyndman & Fan 1996, Am. Stat.
/// 50, 361-365). @pre not empty
double sorted_quantile(std::span<const double> ascending, double p);

/// Monte-Carlo error of `sorted_quantile(ascending, p)`: half the distance between the order
/// statistics one standard deviation of the rank on either side (Woodruff 1952, J. Am. Stat. Assoc.
/// 47, 635-646). The rank is binomial with sd = sqrt(B p (1 - p)).
/// @param rank_sd overrides the binomial standard deviation when it is not negative [ranks]
double quantile_error(std::span<const double> ascending, double p, double rank_sd = -1.0);

/// The median; 0 if there are no values.
double median(std::vector<double> values);

/// A robust estimate of the standard deviation: 1.4826 times the median absolute deviation.
double robust_sd(std::vector<double> values);

/// The probability that a Poisson variable with this mean is at least `count`.
double poisson_at_least(std::size_t count, double mean);

/// 95 % limits of a share by the score method of Wilson (1927), J. Am. Stat. Assoc. 22, 209-212.
/// @pre whole > 0
struct ShareLimits {
  double lower = 0.0;
  double upper = 1.0;
};
ShareLimits share_limits(int part, int whole);

}  // namespace recoil
