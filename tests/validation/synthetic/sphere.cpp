#include "validation/synthetic/sphere.hpp"

#include <cmath>
#include <numbers>

#include "validation/synthetic/runge_kutta.hpp"

namespace hidden {
namespace {

using std::numbers::pi;

/// Inward acceleration at the penetration n > 0 that changes at the rate `speed`.
class Forces {
 public:
  Forces(const Sphere& sphere, const ContactExtras& extras, bool retreat)
      : s_(sphere), x_(extras), retreat_(retreat) {}

  double elastic(double n) const { return std::sqrt(s_.radius) * s_.stiffness * n * std::sqrt(n); }

  double total(double n, double speed) const {
    if (!(n > 0.0)) return 0.0;
    const double a = std::sqrt(s_.radius * n);
    const double given_back = retreat_ ? 1.0 - x_.hysteretic_share : 1.0;
    double outward = elastic(n) * (given_back + s_.C_H * speed);
    outward += 1.5 * x_.bulk_relaxation * s_.stiffness * a * speed;
    double inward = 2.0 * pi * a * s_.adhesion_force;
    if (retreat_) {
      const double opening = std::max(-speed, 0.0);
      inward *= 1.0 + s_.C_A * opening;
      // d(pi a^2) = pi R dn: an energy per area is a force pi R w along n.
      inward += pi * s_.radius * x_.hysteresis_energy;
      if (x_.crack_energy > 0.0) {
        const double edge = std::sqrt(s_.radius) * opening / (2.0 * std::sqrt(n));  // |a'|
        inward += pi * s_.radius * x_.crack_energy * std::pow(edge, x_.crack_exponent);
      }
    }
    return inward - outward;
  }

  /// How fast n grows when the sphere moves inward at `speed` and the plate gives way.
  double closing(double n, double speed) const {
    if (x_.plate_mobility == 0.0) return speed;
    double rate = speed;
    for (int i = 0; i < 4; ++i) rate = speed + x_.plate_mobility * total(n, rate);
    return rate;
  }

 private:
  Sphere s_;
  ContactExtras x_;
  bool retreat_;
};

/// Twice the energy per mass in the conservative well at penetration n.
double well(const Sphere& s, double n) {
  const double hertz = 0.4 * std::sqrt(s.radius) * s.stiffness * std::pow(n, 2.5);
  const double adhesion =
      (4.0 / 3.0) * pi * std::sqrt(s.radius) * s.adhesion_force * std::pow(n, 1.5);
  return 2.0 * (hertz - adhesion) / s.mass;
}

/// D of a half-space: loss D (integral of F'^2 dt) = c / (2 pi mu c_T), c = 0.931 at a Poisson
/// ratio of 1/4 (Hunter 1957 and Miller & Pursey 1955, recomputed).
double half_space(const Base& base) {
  const double mu = base.surface_modulus / (2.0 * (1.0 + base.surface_ratio));
  return 0.931 / (2.0 * pi * mu * std::sqrt(mu / base.surface_density));
}

}  // namespace

Sphere sphere_of(const Base& base, double diameter) {
  Sphere sphere;
  sphere.mass = base.density * pi / 6.0 * diameter * diameter * diameter;
  sphere.radius = 0.5 * diameter;
  sphere.stiffness = base.stiffness();
  return sphere;
}

double well_depth(const Sphere& sphere) {
  return -well(sphere, 2.0 * pi * sphere.adhesion_force / sphere.stiffness);
}

double Base::stiffness() const {
  if (stated_stiffness > 0.0) return stated_stiffness;
  return 4.0 / 3.0 /
         ((1.0 - poisson_ratio * poisson_ratio) / youngs_modulus +
          (1.0 - surface_ratio * surface_ratio) / surface_modulus);
}

double Base::adhesion_energy() const {
  // Gilman (1960) with the lengths of Li, Dunn & Brach (1999): (1.3 A / pi)^2 / 2 A.
  constexpr double length = 1.3e-10 * 1.3e-10 / (pi * pi * 2e-10);
  return 2.0 * length * std::sqrt(youngs_modulus * surface_modulus);
}

ContactResult contact(const Sphere& sphere, const ContactExtras& extras, const Base& base,
                      double velocity) {
  // y = penetration, inward speed of the sphere, integral of (dF/dt)^2 of the elastic force
  using Y = State<3>;
  const double depth = std::pow(
      1.25 * sphere.mass * velocity * velocity / (std::sqrt(sphere.radius) * sphere.stiffness),
      0.4);
  const double time = depth / velocity;
  const double force = sphere.mass * velocity / time;
  const Y size = {depth, velocity, force * force / time};
  const auto field_of = [&](const Forces& forces) {
    return [&sphere, &extras, forces](const Y& y) -> Y {
      const double n = y[0];
      const double rate = forces.closing(n, y[1]);
      double slope = 0.0;
      if (extras.wave_radiation > 0.0 && n > 0.0) {
        slope = 1.5 * sphere.stiffness * std::sqrt(sphere.radius * n) * rate;
      }
      return {rate, forces.total(n, rate) / sphere.mass, slope * slope};
    };
  };
  const Forces in(sphere, extras, false);
  const Forces out(sphere, extras, true);
  Y y = {0.0, velocity, 0.0};
  ContactResult result;
  if (!integrate_until<3>(
          field_of(in), [&](const Y& at) { return in.closing(at[0], at[1]); }, y, 1e-4 * time,
          size)) {
    return result;
  }
  result.deepest = y[0];
  if (out.total(y[0], 0.0) >= 0.0) {  // held where it is
    result.square = well(sphere, y[0]);
    return result;
  }
  // It comes off the surface, or turns inward before.
  if (extras.plate_mobility == 0.0) y[1] = 0.0;
  bool turned = false;
  bool moving = false;
  const auto leaves = [&](const Y& at) {
    const double rate = out.closing(at[0], at[1]);
    moving = moving || rate < -1e-9 * velocity;
    if (moving && at[0] > 1e-12 * depth && rate >= 0.0) {
      turned = true;
      return -1.0;
    }
    return at[0];
  };
  const bool ended = integrate_until<3>(field_of(out), leaves, y, 1e-4 * time, size);
  if (!ended || turned || !(y[1] < 0.0)) {
    result.square = well(sphere, std::max(y[0], 0.0));
    return result;
  }
  result.square = y[1] * y[1];
  if (extras.wave_radiation > 0.0) {
    result.square -= 2.0 * extras.wave_radiation * half_space(base) * y[2] / sphere.mass;
  }
  result.rebounded = result.square > 0.0;
  return result;
}

namespace {

PlasticResult bare_plastic_contact(double mass, double radius, double stiffness,
                                   double yield_pressure, double velocity) {
  using Y = State<2>;
  // Peak pressure p of Hertz: p = 3 F / (2 pi a^2) = 3 K sqrt(n / R) / (2 pi).
  const double yield_depth = radius * std::pow(2.0 * pi * yield_pressure / (3.0 * stiffness), 2);
  const auto loading = [&](double n) {
    if (!(n > 0.0)) return 0.0;
    const double elastic = std::sqrt(radius) * stiffness * std::pow(std::min(n, yield_depth), 1.5);
    return elastic + pi * yield_pressure * radius * std::max(n - yield_depth, 0.0);
  };
  const double depth =
      std::pow(1.25 * mass * velocity * velocity / (std::sqrt(radius) * stiffness), 0.4);
  const double time = depth / velocity;
  const Y size = {depth, velocity};
  Y y = {0.0, velocity};
  const auto in = [&](const Y& at) -> Y { return {at[1], -loading(at[0]) / mass}; };
  integrate_until<2>(
      in, [](const Y& at) { return at[1]; }, y, 1e-4 * time, size);
  if (!(y[0] > yield_depth)) return {velocity * velocity, radius};
  const double deepest = y[0];
  const double peak = loading(deepest);
  const double area = radius * deepest;  // a^2
  const double flat = stiffness * std::pow(area, 1.5) / peak;
  const double left = deepest - area / flat;  // depth of the imprint
  const auto out = [&](const Y& at) -> Y {
    const double n = at[0] - left;
    return {at[1], n > 0.0 ? -std::sqrt(flat) * stiffness * n * std::sqrt(n) / mass : 0.0};
  };
  y = {deepest, 0.0};
  integrate_until<2>(
      out, [&](const Y& at) { return at[0] - left; }, y, 1e-4 * time, size);
  return {y[1] * y[1], flat};
}

}  // namespace

PlasticResult plastic_contact(double mass, double radius, double stiffness, double yield_pressure,
                              double velocity, double work_of_adhesion) {
  if (work_of_adhesion == 0.0) {
    return bare_plastic_contact(mass, radius, stiffness, yield_pressure, velocity);
  }
  const double E = 0.75 * stiffness;
  const double w = work_of_adhesion;
  // The sphere moves along the approach a^2 / R - sqrt(2 pi w a / E) of a contact of radius a.
  const auto slope = [&](double a, double curvature) {
    return 2.0 * a / curvature - std::sqrt(pi * w / (2.0 * E * a));
  };
  const auto peak = [&](double a) {
    return 2.0 * E * a / (pi * radius) - std::sqrt(2.0 * w * E / (pi * a));
  };
  // Force: the plateau p_Y out to the radius b, the pressure of the contact beyond, as rings.
  const auto push = [&](double a) {
    const double rise = 2.0 * E * a / (pi * radius);
    const double pull = std::sqrt(2.0 * w * E / (pi * a));
    double edge = 1.0;  // (1 - b^2 / a^2)^(1/2), from rise edge^2 - p_Y edge - pull = 0
    double plateau = 0.0;
    if (peak(a) > yield_pressure) {
      const double root = std::sqrt(yield_pressure * yield_pressure + 4.0 * rise * pull);
      edge = (yield_pressure + root) / (2.0 * rise);
      plateau = pi * a * a * (1.0 - edge * edge) * yield_pressure;
    }
    return plateau + 2.0 * pi * a * a * edge * (rise * edge * edge / 3.0 - pull);
  };
  using Y = State<2>;  // contact radius and speed
  const double touch = std::cbrt(2.0 * pi * w * radius * radius / E);
  const double depth =
      std::pow(1.25 * mass * velocity * velocity / (std::sqrt(radius) * stiffness), 0.4);
  const double wide = touch + std::sqrt(radius * depth);
  const double fall = std::sqrt(w * wide * wide / mass);  // speed that adhesion alone gives
  Y y = {touch, velocity};
  const auto in = [&](const Y& at) -> Y {
    return {at[1] / slope(at[0], radius), -push(at[0]) / mass};
  };
  integrate_until<2>(in, [](const Y& at) { return at[1]; }, y, 1e-4 * depth / velocity,
                     {wide, velocity + fall});
  const double widest = y[0];
  if (!(peak(widest) > yield_pressure)) return {velocity * velocity, radius};
  const double pulled = std::sqrt(8.0 * pi * w * E * widest * widest * widest);
  const double flat = 4.0 * E * std::pow(widest, 3) / (3.0 * (push(widest) + pulled));
  // Back to zero approach: Simpson's rule over the force, from where it is JKR's with R_p.
  const double open = std::cbrt(2.0 * pi * w * flat * flat / E);
  const auto power = [&](double a) {
    return (4.0 * E * a * a * a / (3.0 * flat) - std::sqrt(8.0 * pi * w * E * a * a * a)) *
           slope(a, flat);
  };
  constexpr int steps = 200;
  const double h = (widest - open) / steps;
  double sum = power(open) + power(widest);
  for (int i = 1; i < steps; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * power(open + i * h);
  return {2.0 * sum * h / 3.0 / mass, flat};
}

double work_at_rest(const Sphere& sphere) {
  const double at_rest =
      std::sqrt(2.0 * pi * sphere.adhesion_force * sphere.radius / sphere.stiffness);
  return sphere.stiffness * at_rest * at_rest * at_rest /
         (6.0 * pi * sphere.radius * sphere.radius);
}

double jkr_work_lost(double work_of_adhesion, double radius, double stiffness) {
  const double E = 0.75 * stiffness;
  const double w = work_of_adhesion;
  // Johnson, Kendall & Roberts (1971): force and approach of a contact of radius a.
  const auto force = [&](double a) {
    return 4.0 * E * a * a * a / (3.0 * radius) - std::sqrt(8.0 * pi * w * E * a * a * a);
  };
  const auto slope = [&](double a) {  // d delta / d a
    return 2.0 * a / radius - 0.5 * std::sqrt(2.0 * pi * w / (E * a));
  };
  const double unit = std::cbrt(pi * w * radius * radius / (2.0 * E));  // a where slope is 2^(-1)..
  // delta = 0 at a^3 = 2 pi w R^2 / E, d delta / d a = 0 at a^3 = pi w R^2 / (8 E).
  const double from = std::cbrt(4.0) * unit;
  const double to = std::cbrt(0.25) * unit;
  constexpr int steps = 2000;  // Simpson's rule: good to 1e-12
  const double h = (to - from) / steps;
  double sum = force(from) * slope(from) + force(to) * slope(to);
  for (int i = 1; i < steps; ++i) {
    const double a = from + i * h;
    sum += (i % 2 == 1 ? 4.0 : 2.0) * force(a) * slope(a);
  }
  return std::abs(sum * h / 3.0);
}

}  // namespace hidden
