#pragma once

#include <cmath>

/// The contact `granular jkr` of LAMMPS with damping `viscoelastic`, integrated over time with the
/// classical method of order 4, from the equations of its manual (pair_style granular):
///   delta = a^2 / R - 2 (pi gamma a / E*)^(1/2),
///   F = 4 E* a^3 / (3 R) - 2 pi a^2 (4 gamma E* / (pi a))^(1/2) - eta a m delta'.
/// It forms at delta = 0 and parts at the delta of the largest pull, a^3 = 9 pi gamma R^2 / (4 E*).
struct JkrByTime {
  double R, m, E, eta, gamma;  // E* [Pa]

  double delta(double a) const { return a * a / R - 2.0 * std::sqrt(M_PI * gamma * a / E); }
  double parting() const { return std::cbrt(9.0 * M_PI * gamma * R * R / (4.0 * E)); }
  /// Newton's method from `a`, on the branch above the smallest delta.
  double radius(double at, double a) const {
    for (int k = 0; k < 50; ++k) {
      const double step = (delta(a) - at) / (2.0 * a / R - std::sqrt(M_PI * gamma / (E * a)));
      a -= step;
      if (std::abs(step) < 1e-13 * a) break;
    }
    return a;
  }
  /// e; 0 for a capture.
  double restitution(double V, int steps_per_contact = 2000) const {
    const double hertz = std::pow(15.0 * m * V * V / (16.0 * E * std::sqrt(R)), 0.4);
    const double formed = std::cbrt(4.0 * M_PI * gamma * R * R / E);  // a at delta = 0
    const double depth = hertz + formed * formed / R;
    const double h =
        3.0 * depth / (V + std::sqrt(2.0 * M_PI * gamma * R * depth / m)) / steps_per_contact;
    const double end = delta(parting());
    double a = formed;
    const auto pull = [&](double x, double v) {
      a = radius(x, a);
      return -(4.0 * E * a * a * a / (3.0 * R) -
               2.0 * M_PI * a * a * std::sqrt(4.0 * gamma * E / (M_PI * a)) + eta * a * m * v) /
             m;
    };
    double x = 0.0;
    double v = V;
    for (int k = 0; k < 20 * steps_per_contact; ++k) {
      const double k1 = pull(x, v);
      const double k2 = pull(x + 0.5 * h * v, v + 0.5 * h * k1);
      const double k3 = pull(x + 0.5 * h * (v + 0.5 * h * k1), v + 0.5 * h * k2);
      const double k4 = pull(x + h * (v + 0.5 * h * k2), v + h * k3);
      const double next = x + h * (v + h * (k1 + k2 + k3) / 6.0);
      const double faster = v + h * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
      if (next <= end) return -(v + (faster - v) * (end - x) / (next - x)) / V;
      if (v < 0.0 && faster >= 0.0) return 0.0;
      x = next;
      v = faster;
    }
    return 0.0;
  }
};
