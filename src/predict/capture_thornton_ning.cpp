#include "predict/capture_thornton_ning.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/roots.hpp"
#include "predict/capture_jkr.hpp"

namespace recoil {
namespace {

using std::numbers::pi;

/// Radius of curvature of the flattened sphere over its own [1], at V >= V_Y.
double flattening(const CaptureContact& c, double yield_pressure, double velocity) {
  const double p = yield_pressure;
  const double R = c.radius();
  const double E = c.reduced_modulus;
  const double yield_force = std::pow(pi, 3.0) * R * R * p * p * p / (6.0 * E * E);
  const double yielded = yield_velocity(c, p);
  const double force = std::sqrt(yield_force * yield_force +
                                 pi * p * R * c.mass() * (velocity * velocity - yielded * yielded));
  const double grown =
      4.0 * E / (3.0 * force) * std::pow((2.0 * force + yield_force) / (2.0 * pi * p), 1.5);
  return std::max(1.0, grown / R);
}

}  // namespace

double thornton_ning_elastic_velocity(const CaptureContact& c) {
  return 1.84 * std::pow(std::pow(c.adhesion_energy / c.radius(), 5.0) /
                             (std::pow(c.density, 3.0) * c.reduced_modulus * c.reduced_modulus),
                         1.0 / 6.0);
}

double yield_velocity(const CaptureContact& c, double yield_pressure) {
  return pi * pi / (2.0 * std::sqrt(10.0)) *
         std::sqrt(std::pow(yield_pressure, 5.0) / (std::pow(c.reduced_modulus, 4.0) * c.density));
}

double plastic_restitution(double velocity, double yield_velocity) {
  if (velocity <= yield_velocity) return 1.0;
  const double v = yield_velocity / velocity;
  return std::sqrt(6.0 * std::sqrt(3.0) / 5.0 * (1.0 - v * v / 6.0)) *
         std::pow(v / (v + 2.0 * std::sqrt((6.0 - v * v) / 5.0)), 0.25);
}

double thornton_ning_plastic_velocity(const CaptureContact& contact, double yield_pressure) {
  const double elastic = jkr_capture_velocity(contact);
  const double yielded = yield_velocity(contact, yield_pressure);
  if (elastic <= yielded) return elastic;
  // What comes back over what is lost, minus one: W_s grows as R_p^(4/3), V_s^2 with it.
  const auto excess = [&](double V) {
    const double e = plastic_restitution(V, yielded);
    const double lost =
        elastic * elastic * std::pow(flattening(contact, yield_pressure, V), 4.0 / 3.0);
    return e * e * V * V / lost - 1.0;
  };
  double high = elastic;
  for (int i = 0; i < 60 && excess(high) < 0.0; ++i) high *= 2.0;
  return high > elastic ? find_root(excess, elastic, high) : elastic;
}

}  // namespace recoil
