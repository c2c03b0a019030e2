#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace recoil {

/// A value with its derivatives in N directions (forward automatic differentiation). The laws of
/// the catalogue are templates of the number type, and use double if no derivatives are needed.
template <std::size_t N>
struct Dual {
  double value = 0.0;
  std::array<double, N> slope = {};

  Dual() = default;
  Dual(double constant) : value(constant) {}  // NOLINT: a constant is a dual without slopes
  /// The independent variable of direction `k`.
  Dual(double at, std::size_t k) : value(at) { slope[k] = 1.0; }

  Dual& operator+=(const Dual& b) {
    value += b.value;
    for (std::size_t k = 0; k < N; ++k) slope[k] += b.slope[k];
    return *this;
  }
  Dual& operator-=(const Dual& b) {
    value -= b.value;
    for (std::size_t k = 0; k < N; ++k) slope[k] -= b.slope[k];
    return *this;
  }
  Dual& operator*=(const Dual& b) {
    for (std::size_t k = 0; k < N; ++k) slope[k] = slope[k] * b.value + value * b.slope[k];
    value *= b.value;
    return *this;
  }
  Dual& operator*=(double b) {
    value *= b;
    for (double& s : slope) s *= b;
    return *this;
  }
  Dual& operator/=(const Dual& b) {
    const double inverse = 1.0 / b.value;
    const double quotient = value / b.value;
    for (std::size_t k = 0; k < N; ++k) slope[k] = (slope[k] - quotient * b.slope[k]) * inverse;
    value = quotient;
    return *this;
  }

  friend Dual operator+(Dual a, const Dual& b) { return a += b; }
  friend Dual operator-(Dual a, const Dual& b) { return a -= b; }
  friend Dual operator*(Dual a, const Dual& b) { return a *= b; }
  friend Dual operator/(Dual a, const Dual& b) { return a /= b; }
  friend Dual operator+(Dual a, double b) { return a.value += b, a; }
  friend Dual operator+(double a, Dual b) { return b.value += a, b; }
  friend Dual operator-(Dual a, double b) { return a.value -= b, a; }
  friend Dual operator-(double a, Dual b) { return (b *= -1.0) += a; }
  friend Dual operator*(Dual a, double b) { return a *= b; }
  friend Dual operator*(double a, Dual b) { return b *= a; }
  friend Dual operator/(Dual a, double b) { return a *= 1.0 / b; }
  friend Dual operator-(Dual a) { return a *= -1.0; }
};

/// The value of a double or a dual number.
inline double value_of(double x) { return x; }
template <std::size_t N>
double value_of(const Dual<N>& x) {
  return x.value;
}

/// f(x) from f and f' at the value of x: the chain rule.
inline double compose(double, double f, double) { return f; }
template <std::size_t N>
Dual<N> compose(Dual<N> x, double f, double slope) {
  x *= slope;
  x.value = f;
  return x;
}

/// Adds slope * (x - its value): a term that carries derivatives and no value.
inline void add_slopes(double&, double, double) {}
template <std::size_t N>
void add_slopes(Dual<N>& sum, double slope, const Dual<N>& x) {
  for (std::size_t k = 0; k < N; ++k) sum.slope[k] += slope * x.slope[k];
}

template <class T>
T sqrt(const T& x) {
  const double root = std::sqrt(value_of(x));
  return compose(x, root, 0.5 / root);
}
template <class T>
T power(const T& x, double exponent) {
  const double at = value_of(x);
  const double f = std::pow(at, exponent);
  return compose(x, f, at == 0.0 ? exponent * std::pow(at, exponent - 1.0) : exponent * f / at);
}
template <class T>
T exponential(const T& x) {
  const double f = std::exp(value_of(x));
  return compose(x, f, f);
}
/// exp(x) - 1, exact for small x.
template <class T>
T exponential_less_one(const T& x) {
  const double f = std::expm1(value_of(x));
  return compose(x, f, f + 1.0);
}
template <class T>
T logarithm(const T& x) {
  return compose(x, std::log(value_of(x)), 1.0 / value_of(x));
}
/// ln(1 + x), exact for small x.
template <class T>
T logarithm_of_one_plus(const T& x) {
  return compose(x, std::log1p(value_of(x)), 1.0 / (1.0 + value_of(x)));
}
/// Standard normal density and distribution function.
template <class T>
T normal_density(const T& x) {
  const double at = value_of(x);
  const double f = std::exp(-0.5 * at * at) / std::sqrt(2.0 * std::numbers::pi);
  return compose(x, f, -at * f);
}
template <class T>
T normal_probability(const T& x) {
  const double at = value_of(x);
  return compose(x, 0.5 * std::erfc(-at / std::numbers::sqrt2),
                 std::exp(-0.5 * at * at) / std::sqrt(2.0 * std::numbers::pi));
}

}  // namespace recoil
