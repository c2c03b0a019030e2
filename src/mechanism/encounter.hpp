#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "data/contact.hpp"
#include "data/system.hpp"
#include "experiment/flight.hpp"
#include "impact/impact.hpp"
#include "mechanism/dual.hpp"
#include "mechanism/survivors_mean.hpp"

namespace recoil {

/// Constants and conditions that all impacts of one dataset share: one member for each that some
/// mechanism asks for.
struct Surroundings {
  double density = 0.0;             ///< of the sphere [kg/m3]
  double stiffness = 0.0;           ///< K [Pa]
  double reduced_modulus = 0.0;     ///< E* = (3/4) K [Pa]
  double reference_diameter = 0.0;  ///< of f0 [m]
  double surface_diameter = 0.0;    ///< of a second sphere [m]; 0: a flat
  double surface_mass = 0.0;        ///< of that sphere [kg]
  double adhesion_energy = 0.0;     ///< W_A of the two bodies, see `ContactProperties` [J/m2]
  double wave_mobility = 0.0;       ///< D of `elastic_waves`, for a half-space [m s / N]
  double plate_impedance = 0.0;     ///< Z / H^2 of `plate_flexure` [kg/(s m2)]; 0: unknown density
  double shear_speed = 0.0;         ///< c_T of the surface [m/s]
  bool elastomer = false;           ///< a body does not yield, see `Material::is_elastomer`
  double image_factor = 1.0;        ///< (eps - 1) / (eps + 1) of the surface [1]; 1: a conductor
  Conditions conditions;            ///< of series that are not in `of_series`
  std::vector<Conditions> of_series;
  Method method = Method::unknown;  ///< how velocities were measured
  AdhesionLaw adhesion = AdhesionLaw::ring;
  AdhesionDampingPhase phase = AdhesionDampingPhase::rebound;  ///< in which C_A acts
  double separation = equilibrium_separation;                  ///< z_0 of `maugis` [m]
  MixedSizes sizes;  ///< the distribution over which every point averages, if any

  std::optional<double> stated(Condition condition, std::size_t series) const {
    return (series < of_series.size() ? of_series[series] : conditions).of(condition);
  }
};

/// An elastic half-space under a point force F(t) radiates the power D F'(t)^2 if F changes slowly
/// compared with the time of a wave across the contact. This is D [m s / N]:
///   D = c(nu) / (2 pi mu c_T),   mu = E / (2 (1 + nu)),   c_T = sqrt(mu / rho),
/// with c the imaginary part of the compliance at the point (longitudinal, transverse and Rayleigh
/// waves; c(1/4) = 0.931). Miller, G. F. & Pursey, H. (1955), Proc. R. Soc. A 233, 55-69; used for
/// impacts by Hunter, S. C. (1957), J. Mech. Phys. Solids 5, 162-171.
double half_space_mobility(double youngs_modulus, double poisson_ratio, double density);

/// c(nu) of `half_space_mobility`, -1 < nu <= 0.5.
double half_space_radiation(double poisson_ratio);

/// @param contact derived from `system`
Surroundings surroundings_of(const ImpactSystem& system, const ContactProperties& contact);

/// The state of one sphere on its way to the surface and back, which the mechanisms change. `T` is
/// double, or a dual number with derivatives.
///
/// On the way in, `velocity` is the velocity at the present place between measuring plane and
/// contact. After the contact, `square` is v^2 on the way out. For a sphere that does not come back
/// it is negative: minus twice the missing energy per mass. One member for each quantity that some
/// mechanism reads or changes.
template <class T>
struct Encounter {
  const Surroundings* at = nullptr;
  std::size_t series = static_cast<std::size_t>(-1);  ///< it determines the conditions
  T density;                                          ///< of the sphere [kg/m3]
  T stiffness;                                        ///< K [Pa]
  T adhesion_energy;                                  ///< W_A of the two bodies [J/m2]
  T wave_mobility;                                    ///< D of `elastic_waves` [m s / N]
  T measured_velocity;                                ///< V in the dataset [m/s]
  T diameter;                                         ///< of the sphere, which gives its mass [m]
  T contact_radius;            ///< radius of curvature of the unloading contact [m]
  T velocity;                  ///< inward [m/s]
  T adhesion_force;            ///< f0 at this sphere's diameter [N/m]
  T hertz_damping;             ///< C_H [s/m]
  T adhesion_damping;          ///< C_A [s/m]
  T relaxation;                ///< of a dashpot -(3/2) relaxation sqrt(contact_radius n) K n' [s]
  T square;                    ///< v^2 on the way out [m2/s2]
  double flow_pressure = 0.0;  ///< pressure at which the contact yielded [Pa]; 0: it did not yield
  double flow_radius = 0.0;    ///< largest radius of the yielding contact [m]

  /// R* of the bodies without flattening; on a flat the sphere's radius [m].
  T radius() const { return relative_radius(diameter, at->surface_diameter); }
  /// m* of the relative motion; on a flat the sphere's mass [kg].
  T mass() const {
    return reduced_mass(diameter * diameter * diameter * (density * (std::numbers::pi / 6.0)),
                        at->surface_mass);
  }
  T reduced_modulus() const { return stiffness * 0.75; }
  /// The surrounding air at 1 Pa: density per pressure, and free path times pressure.
  Air air() const {
    return {1.0, at->stated(Condition::temperature, series).value_or(Air().temperature)};
  }
  /// The slip correction of Stokes drag in air of this pressure, 1 / (1 + Kn (1.257 + 0.4 exp(-1.1
  /// / Kn))), Kn = free path / radius (Davies 1945).
  T slip(const T& pressure) const {
    const T y = pressure * radius() / air().free_path();
    return y / (y + 1.257 + 0.4 * exponential(-1.1 * y));
  }
  /// n_c = (m V^2 / (K sqrt(R)))^(2/5), see ImpactScales [m].
  T scale() const {
    return power(mass() * velocity * velocity / (sqrt(contact_radius) * stiffness), 0.4);
  }
  /// The group beta = B A^(-3/5) V^(-4/5) = B / (A n_c), where B / A = 2 pi f0 / K.
  T beta() const { return adhesion_force / (scale() * stiffness) * (2.0 * std::numbers::pi); }
  /// Maugis's lambda.
  T range() const {
    return adhesion_force / stiffness * maugis_parameter_per_force(1.0, at->separation);
  }
  /// a^2 of the contact at the deepest point of the undamped impact [m2].
  T contact_square() const {
    if (at->adhesion == AdhesionLaw::ring) return contact_radius * deepest();
    return contact_radius * scale() * under_law(&DeepestContact::square);
  }
  /// Elastic energy at the deepest point of the undamped impact [J].
  T stored_energy() const {
    if (at->adhesion == AdhesionLaw::ring) {
      const T n = deepest();
      return stiffness * 0.4 * n * n * sqrt(contact_radius * n);
    }
    return mass() * velocity * velocity * under_law(&DeepestContact::stored);
  }
  /// Contact time of an elastic sphere without adhesion, 2 sqrt(pi) Gamma(7/5) / Gamma(9/10) n_max
  /// / V [s] (Hertz).
  T hertz_contact_time() const { return 2.943275 * hertz_penetration() / velocity; }
  /// Largest penetration of an elastic sphere without adhesion, (5/4)^(2/5) n_c [m].
  T hertz_penetration() const { return scale() * std::pow(1.25, 0.4); }
  /// v^2 of an undamped sphere at penetration n [m2/s2]:
  ///   V^2 + (8/3) pi sqrt(R) f0 n^(3/2) / m - (4/5) K sqrt(R) n^(5/2) / m.
  T undamped_square(const T& n) const {
    const T root = sqrt(contact_radius * n) / mass();
    return velocity * velocity + n * root * adhesion_force * (8.0 / 3.0 * std::numbers::pi) -
           n * n * root * (stiffness * 0.8);
  }
  /// Largest penetration of an undamped sphere under the ring law [m], the zero of
  /// `undamped_square`. Damping on the way in would reduce it by a share of about C_H V / 5.
  T deepest() const {
    const Encounter<double> plain = without_slopes();
    // The function is concave above the root, so that Newton's method cannot overshoot from there.
    double n = plain.hertz_penetration() +
               10.0 / 3.0 * std::numbers::pi * plain.adhesion_force / plain.stiffness;
    for (int step = 0; step < 30; ++step) {
      const double next = n - plain.undamped_square(n) / plain.square_slope(n);
      const bool done = std::abs(next - n) <= 1e-14 * n;
      n = next;
      if (done) break;
    }
    // One more step carries the derivatives.
    return T(n) - undamped_square(T(n)) / plain.square_slope(n);
  }
  Encounter<double> without_slopes() const {
    Encounter<double> plain;
    plain.at = at;
    plain.series = series;
    plain.density = value_of(density);
    plain.stiffness = value_of(stiffness);
    plain.adhesion_energy = value_of(adhesion_energy);
    plain.wave_mobility = value_of(wave_mobility);
    plain.measured_velocity = value_of(measured_velocity);
    plain.diameter = value_of(diameter);
    plain.contact_radius = value_of(contact_radius);
    plain.velocity = value_of(velocity);
    plain.adhesion_force = value_of(adhesion_force);
    plain.hertz_damping = value_of(hertz_damping);
    plain.adhesion_damping = value_of(adhesion_damping);
    plain.relaxation = value_of(relaxation);
    plain.square = value_of(square);
    plain.flow_pressure = flow_pressure;
    plain.flow_radius = flow_radius;
    return plain;
  }
  /// d undamped_square / d n.
  T square_slope(const T& n) const {
    const T root = sqrt(contact_radius * n) / mass();
    return root * adhesion_force * (4.0 * std::numbers::pi) - n * root * (stiffness * 2.0);
  }
  /// Makes the sphere larger by `factor`; f0 ~ R*^(1/3).
  void resize(const T& factor) {
    const T before = radius();
    diameter *= factor;
    const T growth = radius() / before;
    contact_radius *= growth;
    adhesion_force *= power(growth, 1.0 / 3.0);
  }
  /// Takes `energy` [J] from the sphere.
  void dissipate(const T& energy) { square -= 2.0 * energy / mass(); }

 private:
  /// A quantity at the deepest point under another law than the ring law, with its derivatives.
  T under_law(DeepestContact::Quantity DeepestContact::*which) const {
    const T b = beta();
    const T r = range();
    const DeepestContact contact = deepest_contact(at->adhesion, value_of(b), value_of(r));
    const DeepestContact::Quantity& quantity = contact.*which;
    T sum(quantity.value);
    add_slopes(sum, quantity.by_beta, b);
    add_slopes(sum, quantity.by_range, r);
    return sum;
  }
};

/// A sphere with the diameter [m] and velocity [m/s] of the dataset, before any mechanism acts, and
/// without adhesion and damping.
template <class T>
Encounter<T> plain_sphere(const Surroundings& at, const T& diameter, const T& velocity,
                          std::size_t series) {
  Encounter<T> e{};
  e.at = &at;
  e.series = series;
  e.density = T(at.density);
  e.stiffness = T(at.stiffness);
  e.adhesion_energy = T(at.adhesion_energy);
  e.wave_mobility = T(at.wave_mobility);
  e.measured_velocity = velocity;
  e.diameter = diameter;
  e.contact_radius = e.radius();
  e.velocity = velocity;
  return e;
}

/// The values of one point, averaged over its spheres, which mechanisms of selection and reading
/// change.
template <class T>
struct Observed {
  T square;    ///< e^2, continued below zero [1]
  T velocity;  ///< measured incident velocity [m/s]
};

/// A smooth approximation of max(y, 0) with a transition of this width.
template <class T>
T positive_part(const T& y, const T& width) {
  return 0.5 * (y + sqrt(y * y + width * width));
}

/// (sqrt(x) + shift)^2 for rebounds, x >> width^2, and x for spheres that do not come back, x < 0,
/// with a smooth transition over |x| ~ width^2. At x >> width^2 the relative error of `shift` is
/// below (width^2 / x)^2 / 2.
template <class T>
T shifted_if_seen(const T& x, const T& shift, const T& width) {
  const T w4 = width * width * (width * width);
  const T hypotenuse = sqrt(x * x + w4);
  const T sum = value_of(x) >= 0.0 ? (hypotenuse + x) * 0.5 : w4 * 0.5 / (hypotenuse - x);
  const T seen = sum / hypotenuse;  // from 0 to 1
  return x + 2.0 * shift * (sqrt(sum) * seen) + shift * shift * (seen * seen);
}

}  // namespace recoil
