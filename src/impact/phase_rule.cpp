#include "impact/phase_rule.hpp"

#include <algorithm>
#include <numbers>

namespace recoil {
namespace {

/// Moves the nodes towards the release, where adhesion brings zeros of u close to the path. This is
/// the best of 0, 0.15, 0.3, 0.45 and 0.6 for 12 and 16 nodes and the shipped fits.
constexpr double crowding = 0.15;

/// sin(pi x / 2) for x from 0 to 1.
double sine_of_quarters(double x) {
  const double angle = 1.5707963267948966 * x;
  double sum = 0.0, term = angle;
  for (int k = 1; k < 40; k += 2) {
    sum += term;
    term *= -angle * angle / double((k + 1) * (k + 2));
  }
  return sum;
}

/// P_0(x), ..., P_(count + 2)(x).
std::vector<double> polynomials(std::size_t count, double x) {
  std::vector<double> p(count + 3);
  p[0] = 1.0;
  p[1] = x;
  for (std::size_t k = 2; k < p.size(); ++k) {
    p[k] = (double(2 * k - 1) * x * p[k - 1] - double(k - 1) * p[k - 2]) / double(k);
  }
  return p;
}

struct Value {
  double value, slope;
};
/// P_count and its slope.
Value legendre(std::size_t count, double x) {
  const auto p = polynomials(count, x);
  return {p[count], double(count) * (x * p[count] - p[count - 1]) / (x * x - 1.0)};
}

/// By Newton's method from Tricomi's -cos(pi (4 k + 3) / (4 count + 2)). The roots are symmetric.
std::vector<double> roots_of_legendre(std::size_t count) {
  std::vector<double> found(count);
  for (std::size_t k = 0; 2 * k < count; ++k) {
    double x = -sine_of_quarters(double(2 * (count - 2 * k) - 2) / double(2 * count + 1));
    for (int step = 0; step < 8; ++step) {
      const Value p = legendre(count, x);
      x -= p.value / p.slope;
    }
    found[k] = x;
    found[count - 1 - k] = -x;
  }
  return found;
}

/// The series times (1 + sign x) / 2, by the recurrence of the polynomials.
GaussRule::Series times_half(const GaussRule::Series& series, double sign) {
  GaussRule::Series product(series.size());
  for (std::size_t k = 0; k < series.size(); ++k) {
    product[k] = 0.5 * series[k];
    if (k > 0) product[k] += 0.5 * sign * double(k) / double(2 * k - 1) * series[k - 1];
    if (k + 1 < series.size()) {
      product[k] += 0.5 * sign * double(k + 1) / double(2 * k + 3) * series[k + 1];
    }
  }
  return product;
}

}  // namespace

GaussRule::GaussRule(std::size_t nodes)
    : count(nodes), node(nodes), weight(nodes), last(nodes), last_but_one(nodes) {
  const std::vector<double> roots = roots_of_legendre(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = roots[i];
    const double slope = legendre(count, x).slope;
    node[i] = 0.5 + 0.5 * x;
    weight[i] = 1.0 / ((1.0 - x * x) * slope * slope);
  }
  for (std::size_t j = 0; j < count; ++j) {
    const Row& at_j = of_node.emplace_back(polynomials(count, roots[j]));
    last[j] = double(2 * count - 1) * at_j[count - 1] * weight[j];
    last_but_one[j] = double(2 * count - 3) * at_j[count - 2] * weight[j];
  }
  for (std::size_t i = 0; i < count; ++i) up_to.push_back(integral_up_to(node[i]));
}

GaussRule::Row GaussRule::integral_up_to(double s) const {
  const Row at_s = polynomials(count, 2.0 * s - 1.0);
  // The integral of P_k from -1 to x is (P_(k+1)(x) - P_(k-1)(x)) / (2 k + 1).
  Row part(count);
  for (std::size_t k = 1; k < count; ++k) part[k] = 0.5 * (at_s[k + 1] - at_s[k - 1]);
  Row row(count);
  for (std::size_t j = 0; j < count; ++j) {
    double sum = s;
    for (std::size_t k = 1; k < count; ++k) sum += of_node[j][k] * part[k];
    row[j] = weight[j] * sum;
  }
  return row;
}

std::vector<GaussRule::Series> GaussRule::vanishing(bool at_both_ends) const {
  std::vector<Series> all;
  for (std::size_t j = 0; j < count; ++j) {
    Series series(count + 2);
    for (std::size_t k = 0; k < count; ++k) {
      series[k] = double(2 * k + 1) * weight[j] * of_node[j][k] / node[j];
    }
    series = times_half(series, 1.0);
    if (at_both_ends) {
      for (double& entry : series) entry /= 1.0 - node[j];
      series = times_half(series, -1.0);
    }
    all.push_back(std::move(series));
  }
  return all;
}

GaussRule::Row GaussRule::integral_up_to(double s, const std::vector<Series>& vanishing) const {
  const Row at_s = polynomials(count, 2.0 * s - 1.0);
  Row row;
  for (const Series& series : vanishing) {
    double sum = series[0] * s;
    for (std::size_t k = 1; k < series.size(); ++k) {
      sum += series[k] * 0.5 * (at_s[k + 1] - at_s[k - 1]) / double(2 * k + 1);
    }
    row.push_back(sum);
  }
  return row;
}

PhaseRule::PhaseRule(std::size_t nodes, bool both_ends_turn) : count(nodes) {
  const GaussRule gauss(count);
  const GaussRule coarse(few);
  const auto functions = gauss.vanishing(both_ends_turn);
  const auto coarse_functions = coarse.vanishing(both_ends_turn);
  const auto put = [](const GaussRule::Row& row, double* to) {
    std::copy(row.begin(), row.end(), to);
  };
  put(gauss.weight, weight);
  put(gauss.last, last);
  put(gauss.last_but_one, last_but_one);
  for (std::size_t i = 0; i < count; ++i) {
    const double s = gauss.node[i];
    if (both_ends_turn) {
      const double sine = sine_of_quarters(s);
      part[i] = sine * sine;
      rate[i] = std::numbers::pi * sine * sine_of_quarters(1.0 - s);
    } else {
      part[i] = s * s * (1.0 + crowding * (1.0 - s * s));
      rate[i] = 2.0 * s * (1.0 + crowding * (1.0 - 2.0 * s * s));
    }
    put(gauss.up_to[i], up_to[i]);
    put(gauss.integral_up_to(s, functions), losses[i]);
    put(coarse.integral_up_to(s, coarse_functions), from_few[i]);
  }
}

const PhaseRules& phase_rules() {
  static const PhaseRules rules;
  return rules;
}

}  // namespace recoil
