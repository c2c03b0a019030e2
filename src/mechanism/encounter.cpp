#include "mechanism/encounter.hpp"

#include <cmath>
#include <numbers>

#include "core/numerics.hpp"

namespace recoil {
namespace {

/// Integral of f over [0, pi/2] by the midpoint rule. It converges faster than any power, because
/// the integrands are periodic and smooth.
template <class F>
double over_quarter_turn(F f) {
  constexpr int count = 400;
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += f((i + 0.5) * std::numbers::pi / (2.0 * count));
  return sum * std::numbers::pi / (2.0 * count);
}

}  // namespace

double half_space_radiation(double poisson_ratio) {
  // Wave numbers in units of that of transverse waves; g is that of longitudinal ones.
  const double g2 = (1.0 - 2.0 * poisson_ratio) / (2.0 * (1.0 - poisson_ratio));
  const double g = std::sqrt(g2);
  // k < g: both waves carry energy away. k = g sin(t).
  const double both = over_quarter_turn([&](double t) {
    const double k = g * std::sin(t);
    const double l = g * std::cos(t);
    const double square = (2.0 * k * k - 1.0) * (2.0 * k * k - 1.0);
    return k * l * l / (square + 4.0 * k * k * l * std::sqrt(1.0 - k * k));
  });
  // g < k < 1: transverse waves only. k^2 = g^2 + (1 - g^2) sin^2 t.
  const double transverse = over_quarter_turn([&](double t) {
    const double s = std::sin(t);
    const double c = std::cos(t);
    const double k2 = g2 + (1.0 - g2) * s * s;
    const double l2 = (1.0 - g2) * s * s;
    const double q = std::sqrt(1.0 - g2) * c;
    const double fourth = std::pow(2.0 * k2 - 1.0, 4);
    // k dk = (1 - g^2) s c dt
    return 4.0 * k2 * l2 * q * (1.0 - g2) * s * c / (fourth + 16.0 * k2 * k2 * l2 * q * q);
  });
  // k > 1: the pole of the Rayleigh wave, R(k) = (2 k^2 - 1)^2 - 4 k^2 sqrt((k^2-g^2)(k^2-1)).
  const auto rayleigh = [&](double k2) {
    return (2.0 * k2 - 1.0) * (2.0 * k2 - 1.0) - 4.0 * k2 * std::sqrt((k2 - g2) * (k2 - 1.0));
  };
  double high = 4.0;  // a Rayleigh wave is slower than c_T / 2 only for nu < -0.9
  while (rayleigh(high) > 0.0) high *= 2.0;
  const double k2 = find_root(rayleigh, 1.0, high);
  const double root = std::sqrt((k2 - g2) * (k2 - 1.0));
  // dR / d(k^2); dR/dk is 2 k times that.
  const double slope =
      4.0 * (2.0 * k2 - 1.0) - 4.0 * root - 2.0 * k2 * (2.0 * k2 - 1.0 - g2) / root;
  const double surface = std::numbers::pi * std::sqrt(k2 - g2) / (2.0 * std::abs(slope));
  return both + transverse + surface;
}

double half_space_mobility(double youngs_modulus, double poisson_ratio, double density) {
  const double mu = youngs_modulus / (2.0 * (1.0 + poisson_ratio));
  return half_space_radiation(poisson_ratio) /
         (2.0 * std::numbers::pi * mu * std::sqrt(mu / density));
}

Surroundings surroundings_of(const ImpactSystem& system, const ContactProperties& contact) {
  Surroundings s;
  s.density = contact.particle_density;
  s.stiffness = contact.stiffness;
  s.reduced_modulus = 0.75 * contact.stiffness;
  s.reference_diameter = contact.reference_diameter;
  s.surface_diameter = contact.surface_diameter;
  if (contact.surface_diameter > 0.0) {
    s.surface_mass = sphere_mass(contact.surface_diameter, contact.surface_density);
  }
  s.adhesion_energy = contact.adhesion_energy;
  s.elastomer = system.particle.is_elastomer() || system.surface.is_elastomer();
  s.method = system.method;
  // Waves travel in the surface. If it states no density, the sphere's is used.
  const Material& surface = system.surface;
  s.wave_mobility =
      half_space_mobility(surface.youngs_modulus, surface.poisson_ratio,
                          surface.density > 0.0 ? surface.density : system.particle.density);
  s.shear_speed = std::sqrt(surface.youngs_modulus / (2.0 * (1.0 + surface.poisson_ratio)) /
                            (surface.density > 0.0 ? surface.density : system.particle.density));
  if (const auto eps = surface.relative_permittivity) s.image_factor = (*eps - 1.0) / (*eps + 1.0);
  s.conditions = system.conditions;
  // Zener, C. (1941), Phys. Rev. 59, 669-673.
  s.plate_impedance = 4.0 / std::sqrt(3.0) *
                      std::sqrt(surface.youngs_modulus * surface.density /
                                (1.0 - surface.poisson_ratio * surface.poisson_ratio));
  return s;
}

}  // namespace recoil
