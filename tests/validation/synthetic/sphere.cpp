#include "validation/synthetic/sphere.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "validation/synthetic/runge_kutta.hpp"
#include "validation/truth/elastoplastic_truth.hpp"

namespace recoil::hidden {
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

PlasticResult plastic_contact(double mass, double radius, double stiffness, double yield_pressure,
                              double velocity, double work_of_adhesion) {
  const ElastoplasticImpact impact = elastoplastic_impact(
      {0.75 * stiffness, radius, mass, work_of_adhesion, 0.0, yield_pressure}, velocity);
  return {velocity * velocity * (1.0 - impact.plastic_share), impact.unloading_radius};
}

double work_at_rest(const Sphere& sphere) {
  const double at_rest =
      std::sqrt(2.0 * pi * sphere.adhesion_force * sphere.radius / sphere.stiffness);
  return sphere.stiffness * at_rest * at_rest * at_rest /
         (6.0 * pi * sphere.radius * sphere.radius);
}

namespace {

constexpr double first_coefficient = 1.5 * 1.15344;  // of b

/// (K sqrt(R) / m)^(2/5) V^(1/5) [1/s]: one over the time of a Hertz contact, but for a factor.
double contact_rate(const Sphere& s, double velocity) {
  return std::pow(s.stiffness * std::sqrt(s.radius) / s.mass, 0.4) * std::pow(velocity, 0.2);
}

}  // namespace

const std::vector<std::string_view>& effects_with_other_law() {
  static const std::vector<std::string_view> ids = {"plastic_yield", "bulk_viscoelastic",
                                                    "plate_flexure", "gas_film"};
  return ids;
}

bool is_law_of_dry_contact(std::string_view effect) {
  return effect == "plastic_yield" || effect == "bulk_viscoelastic" || effect == "plate_flexure";
}

double jackson_restitution(const Sphere& s, double yield_pressure, double velocity) {
  const double depth = s.radius * std::pow(2.0 * pi * yield_pressure / (3.0 * s.stiffness), 2);
  const double energy = 0.4 * s.stiffness * std::sqrt(s.radius) * std::pow(depth, 2.5);
  const double u = velocity / std::sqrt(2.0 * energy / s.mass);
  if (!(u > 1.0)) return 1.0;
  constexpr double middle = 60.0;
  if (u <= middle) return 1.0 - 0.1 * std::log(u) * std::pow((u - 1.0) / (middle - 1.0), 0.156);
  const double strain = yield_pressure / (1.6 * 0.75 * s.stiffness);
  const double e = 1.0 - 0.1 * std::log(middle) -
                   0.11 * std::log(u / middle) * std::pow(u - middle, 2.36 * strain);
  return std::max(e, 0.0);
}

double largest_by_other_law(std::string_view effect, const Sphere& s, double velocity) {
  const double rate = contact_rate(s, velocity);
  if (effect == "bulk_viscoelastic") return 0.3 / (first_coefficient * rate);
  if (effect == "plate_flexure") return 0.25 / (s.mass * rate);
  return INFINITY;
}

double ramirez_restitution(const Sphere& s, double relaxation, double velocity) {
  const double b = first_coefficient * relaxation * contact_rate(s, velocity);
  return 1.0 - b + 0.6 * b * b;
}

double boettcher_restitution(const Sphere& s, double plate_mobility, double velocity) {
  return std::exp(-1.719 * s.mass * plate_mobility * contact_rate(s, velocity));
}

double speed_lost_in_film(double mu, const Sphere& s, double gap, double path) {
  return 6.0 * pi * mu * s.radius * s.radius / s.mass * std::log(gap / path);
}

}  // namespace recoil::hidden
