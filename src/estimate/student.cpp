#include "estimate/student.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_sf_psi.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/numerics.hpp"

namespace recoil {
namespace {

/// E f(z) for standard normal z: the trapezoid rule converges faster than any power for smooth f.
template <class Function>
double normal_mean(const Function& f) {
  constexpr double reach = 12.0;
  constexpr int halves = 600;
  constexpr double step = reach / halves;
  double sum = 0.0;
  for (int i = -halves; i <= halves; ++i) sum += f(i * step) * gsl_ran_ugaussian_pdf(i * step);
  return sum * step;
}

double psi_slope(double dof, double r) {
  const double q = dof + r * r;
  return (dof + 1.0) * (dof - r * r) / (q * q);
}

/// The scale of t noise at which psi^2 has the same mean as for standard normal noise: E psi(scale
/// t)^2 = E psi(z)^2, by the trapezoid rule in t = sinh(x), whose tails fall exponentially.
double core_scale(const StudentNoise& student) {
  constexpr double step = 0.05;
  const int halves = static_cast<int>(std::ceil(40.0 / student.dof / step)) + 100;
  std::vector<std::pair<double, double>> nodes;  // t and its weight
  for (int i = -halves; i <= halves; ++i) {
    const double t = std::sinh(i * step);
    nodes.emplace_back(t, gsl_ran_tdist_pdf(t, student.dof) * std::cosh(i * step) * step);
  }
  const auto excess = [&](double scale) {
    double square = 0.0;
    for (const auto& [t, weight] : nodes) {
      square += weight * student.psi(scale * t) * student.psi(scale * t);
    }
    return square - student.mean_square;
  };
  return find_root(excess, 0.05, 2.0);
}

}  // namespace

double StudentNoise::psi(double r) const { return (dof + 1.0) * r / (dof + r * r); }

WeightedResidual StudentNoise::transformed(const WeightedResidual& normal) const {
  const double c = std::sqrt(calibration());
  const double r = normal.value;
  const double root = std::sqrt((dof + 1.0) * std::log1p(r * r / dof));
  const double slope = root > 0.0 ? psi(std::abs(r)) / root : std::sqrt((dof + 1.0) / dof);
  return {std::copysign(c * root, r), c * slope * normal.slope};
}

double StudentNoise::original(double value) const {
  const double deviance = value * value / calibration();
  return std::copysign(std::sqrt(dof * std::expm1(deviance / (dof + 1.0))), value);
}

StudentNoise student_noise(double dof) {
  StudentNoise student;
  student.dof = dof;
  const auto square = [&](double z) { return student.psi(z) * student.psi(z); };
  student.mean_slope = normal_mean([&](double z) { return psi_slope(dof, z); });
  student.mean_square = normal_mean(square);
  student.gauss_newton = normal_mean([&](double z) {
    const double d = (dof + 1.0) * std::log1p(z * z / dof);
    return d > 0.0 ? square(z) / d : (dof + 1.0) / dof;
  });
  student.core = core_scale(student);
  return student;
}

double StudentNoise::p_value(std::span<const double> residuals, int freedom) const {
  const auto n = static_cast<double>(residuals.size());
  double sum = 0.0;
  double largest = 0.0;
  for (const double r : residuals) {
    const double t = r / core;
    sum += (dof + 1.0) * std::log1p(t * t / dof);
    largest = std::max(largest, std::abs(t));
  }
  const double mean = (dof + 1.0) * (gsl_sf_psi(0.5 * (dof + 1.0)) - gsl_sf_psi(0.5 * dof));
  const double variance =
      (dof + 1.0) * (dof + 1.0) * (gsl_sf_psi_1(0.5 * dof) - gsl_sf_psi_1(0.5 * (dof + 1.0)));
  const double ratio = variance / mean;
  const double of_sum = gsl_cdf_gamma_Q(sum, freedom * mean / ratio, ratio);
  const double beyond = std::min(1.0, 2.0 * gsl_cdf_tdist_Q(largest, dof));
  const double of_largest = -std::expm1(n * std::log1p(-std::min(beyond, 1.0 - 1e-16)));
  return std::min(1.0, 2.0 * std::min(of_sum, of_largest));
}

}  // namespace recoil
