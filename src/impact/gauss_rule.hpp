#pragma once

#include <array>
#include <cstddef>

namespace recoil {

/// sin(pi x / 2) for x from 0 to 1, when a table is made.
constexpr double sine_of_quarters(double x) {
  const double angle = 1.5707963267948966 * x;
  double sum = 0.0, term = angle;
  for (int k = 1; k < 40; k += 2) {
    sum += term;
    term *= -angle * angle / double((k + 1) * (k + 2));
  }
  return sum;
}

/// Gauss's nodes s_i on [0, 1], what integrates a polynomial through them up to each node and up to
/// 1, and its two highest coefficients in Legendre polynomials.
///
/// `Owner` makes the table a different type for every kernel (see fast_kernel.cpp).
template <class Owner, std::size_t count>
struct GaussRule {
  using Row = std::array<double, count>;

  Row node = {};
  Row weight = {};                    ///< sum_j weight[j] f(s_j) = integral from 0 to 1
  std::array<Row, count> up_to = {};  ///< sum_j up_to[i][j] f(s_j) = integral from 0 to s_i
  Row last = {}, last_but_one = {};   ///< coefficients of P_(count - 1) and P_(count - 2)

  static constexpr GaussRule made() {
    GaussRule rule;
    const Row roots = roots_of_legendre();
    for (std::size_t i = 0; i < count; ++i) {
      const double x = roots[i];
      const double slope = legendre(x).slope;
      rule.node[i] = 0.5 + 0.5 * x;
      rule.weight[i] = 1.0 / ((1.0 - x * x) * slope * slope);
    }
    for (std::size_t j = 0; j < count; ++j) {
      const auto at_j = polynomials(roots[j]);
      for (std::size_t k = 0; k < count; ++k) rule.of_node[j][k] = at_j[k];
      rule.last[j] = double(2 * count - 1) * at_j[count - 1] * rule.weight[j];
      rule.last_but_one[j] = double(2 * count - 3) * at_j[count - 2] * rule.weight[j];
    }
    for (std::size_t i = 0; i < count; ++i) rule.up_to[i] = rule.integral_up_to(rule.node[i]);
    return rule;
  }

  /// sum_j row[j] f(s_j) = integral from 0 to s
  constexpr Row integral_up_to(double s) const {
    Row row = {};
    const auto at_s = polynomials(2.0 * s - 1.0);
    // The integral of P_k from -1 to x is (P_(k+1)(x) - P_(k-1)(x)) / (2 k + 1).
    double part[count] = {};
    for (std::size_t k = 1; k < count; ++k) part[k] = 0.5 * (at_s[k + 1] - at_s[k - 1]);
    for (std::size_t j = 0; j < count; ++j) {
      double sum = s;
      for (std::size_t k = 1; k < count; ++k) sum += of_node[j][k] * part[k];
      row[j] = weight[j] * sum;
    }
    return row;
  }

  using Series = std::array<double, count + 2>;  ///< in Legendre polynomials

  /// For an f that is s, or with `at_both_ends` s (1 - s), times a polynomial through the nodes:
  /// what is 1 at each node in turn and 0 at the others. Integrals of such an f have an error that
  /// vanishes with its slope where f does: what is divided by s^2 or its root keeps its digits at
  /// the first nodes.
  constexpr std::array<Series, count> vanishing(bool at_both_ends) const {
    std::array<Series, count> all = {};
    for (std::size_t j = 0; j < count; ++j) {
      Series& series = all[j];
      for (std::size_t k = 0; k < count; ++k) {
        series[k] = double(2 * k + 1) * weight[j] * of_node[j][k] / node[j];
      }
      series = times_half(series, 1.0);
      if (!at_both_ends) continue;
      for (double& entry : series) entry /= 1.0 - node[j];
      series = times_half(series, -1.0);
    }
    return all;
  }

  /// The same for the f of `vanishing`.
  static constexpr Row integral_up_to(double s, const std::array<Series, count>& vanishing) {
    const auto at_s = polynomials(2.0 * s - 1.0);
    Row row = {};
    for (std::size_t j = 0; j < count; ++j) {
      const Series& series = vanishing[j];
      double sum = series[0] * s;
      for (std::size_t k = 1; k < series.size(); ++k) {
        sum += series[k] * 0.5 * (at_s[k + 1] - at_s[k - 1]) / double(2 * k + 1);
      }
      row[j] = sum;
    }
    return row;
  }

 private:
  double of_node[count][count] = {};  // P_k at each node

  /// (1 + sign x) / 2 times the series, by the recurrence of the polynomials.
  static constexpr Series times_half(const Series& series, double sign) {
    Series product = {};
    for (std::size_t k = 0; k < series.size(); ++k) {
      product[k] = 0.5 * series[k];
      if (k > 0) product[k] += 0.5 * sign * double(k) / double(2 * k - 1) * series[k - 1];
      if (k + 1 < series.size()) {
        product[k] += 0.5 * sign * double(k + 1) / double(2 * k + 3) * series[k + 1];
      }
    }
    return product;
  }

  struct Value {
    double value, slope;
  };
  /// P_0(x), ..., P_(count + 2)(x)
  static constexpr std::array<double, count + 3> polynomials(double x) {
    std::array<double, count + 3> p = {1.0, x};
    for (std::size_t k = 2; k < p.size(); ++k) {
      p[k] = (double(2 * k - 1) * x * p[k - 1] - double(k - 1) * p[k - 2]) / double(k);
    }
    return p;
  }
  static constexpr Value legendre(double x) {
    const auto p = polynomials(x);
    return {p[count], double(count) * (x * p[count] - p[count - 1]) / (x * x - 1.0)};
  }
  /// By Newton's steps from Tricomi's -cos(pi (4 k + 3) / (4 count + 2)); they mirror each other.
  static constexpr Row roots_of_legendre() {
    Row found = {};
    for (std::size_t k = 0; 2 * k < count; ++k) {
      double x = -sine_of_quarters(double(2 * (count - 2 * k) - 2) / double(2 * count + 1));
      for (int step = 0; step < 8; ++step) {
        const Value p = legendre(x);
        x -= p.value / p.slope;
      }
      found[k] = x;
      found[count - 1 - k] = -x;
    }
    return found;
  }
};

}  // namespace recoil
