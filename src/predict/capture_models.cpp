#include "predict/capture_models.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/numerics.hpp"

namespace recoil {

double dahneke_capture_velocity(double mass, double restitution, double incident_energy,
                                double rebound_energy) {
  const double square = restitution * restitution;
  return std::sqrt(
      std::max(0.0, 2.0 / (mass * square) * (rebound_energy - square * incident_energy)));
}

namespace {

using std::numbers::pi;

/// U(alpha) of the header, for alpha^3 = `cube`.
double stored(double cube) {
  const double alpha = std::cbrt(cube);
  return 8.0 / 15.0 * std::pow(alpha, 5.0) -
         4.0 / 3.0 * std::sqrt(2.0 * pi) * std::pow(alpha, 3.5) + pi * alpha * alpha;
}

}  // namespace

CaptureContact capture_contact(const ContactProperties& contact, double diameter) {
  const auto [equal, density] = contact.as_one_sphere(diameter, contact.particle_density);
  return {equal, density, 0.75 * contact.stiffness, contact.adhesion_energy};
}

JkrEnergies jkr_energies(const CaptureContact& contact) {
  const double unit =
      std::cbrt(std::pow(contact.adhesion_energy, 5.0) * std::pow(contact.radius(), 4.0) /
                (contact.reduced_modulus * contact.reduced_modulus));
  const double touch = stored(2.0 * pi);
  const double rest = stored(4.5 * pi);
  const double parting = stored(pi / 8.0);
  return {(touch - rest) * unit, (parting - rest) * unit};
}

double jkr_capture_velocity(const CaptureContact& contact) {
  return std::sqrt(2.0 * jkr_energies(contact).lost() / contact.mass());
}

namespace {

using std::numbers::pi;

/// Largest contact radius over the radius at touch. A sphere that needs a larger one to rebound is
/// captured at any velocity at which it remains a sphere.
constexpr double widest = 1e3;

/// The contact of an adhesive sphere that yields, as a function of the contact radius a [m].
class YieldingContact {
 public:
  YieldingContact(const CaptureContact& contact, double yield_pressure)
      : R_(contact.radius()),
        E_(contact.reduced_modulus),
        W_(contact.adhesion_energy),
        p_(yield_pressure) {}

  /// The contact radius at touch, at n = 0 [m].
  double at_touch() const { return std::cbrt(2.0 * pi * W_ * R_ * R_ / E_); }

  /// Work of loading from touch to `a` [J].
  double loading(double a) const {
    return work(at_touch(), a, R_, [&](double r) { return force(r); });
  }

  /// Work recovered from `a` until the contact separates, by JKR with the flattened radius [J];
  /// negative if separation costs more.
  double unloading(double a) const {
    const double flattened = 4.0 * E_ * a * a * a / (3.0 * (force(a) + adhesive(a)));
    const double parts = std::cbrt(pi * W_ * flattened * flattened / (8.0 * E_));
    if (!(parts < a)) return -std::numeric_limits<double>::infinity();
    return work(parts, a, flattened,
                [&](double r) { return 4.0 * E_ * r * r * r / (3.0 * flattened) - adhesive(r); });
  }

 private:
  double adhesive(double a) const { return std::sqrt(8.0 * pi * W_ * E_ * a * a * a); }

  /// Force of the pressure c_1 s - c_2 / s, s = (1 - r^2 / a^2)^(1/2), limited to p_Y: the JKR
  /// force minus the integral of the excess pressure, over s from where it begins to 1.
  double force(double a) const {
    const double elastic = 4.0 * E_ * a * a * a / (3.0 * R_) - adhesive(a);
    const double c1 = 2.0 * E_ * a / (pi * R_);
    const double c2 = std::sqrt(2.0 * W_ * E_ / (pi * a));
    if (c1 - c2 <= p_) return elastic;
    const double s = (p_ + std::sqrt(p_ * p_ + 4.0 * c1 * c2)) / (2.0 * c1);
    const double cut_off = c1 * (1.0 - s * s * s) / 3.0 - c2 * (1.0 - s) - 0.5 * p_ * (1.0 - s * s);
    return elastic - 2.0 * pi * a * a * cut_off;
  }

  /// Integral of F dn along n = a^2 / radius - (2 pi W a / E*)^(1/2), in panels proportional to a.
  template <class Force>
  double work(double from, double to, double radius, Force force_at) const {
    static const std::vector<QuadratureNode> nodes = gauss_legendre(8);
    constexpr int panels = 24;
    const double growth = std::pow(to / from, 1.0 / panels);
    double sum = 0.0;
    double a = from;
    for (int panel = 0; panel < panels; ++panel) {
      const double width = a * (growth - 1.0);
      for (const QuadratureNode& node : nodes) {
        const double r = a + width * node.at;
        sum += node.weight * width * force_at(r) *
               (2.0 * r / radius - std::sqrt(pi * W_ / (2.0 * E_ * r)));
      }
      a *= growth;
    }
    return sum;
  }

  double R_, E_, W_, p_;
};

}  // namespace

double thornton_ning_plastic_velocity(const CaptureContact& contact, double yield_pressure) {
  if (!(contact.adhesion_energy > 0.0)) return 0.0;
  const YieldingContact sphere(contact, yield_pressure);
  // Starts from the first contact that recovers more work than its separation costs.
  constexpr double step = 1.05;
  double low = sphere.at_touch();
  double high = low * step;
  while (!(sphere.unloading(high) > 0.0) || !(sphere.loading(high) > 0.0)) {
    low = high;
    high *= step;
    if (high > widest * sphere.at_touch()) return std::nan("");
  }
  const double work_scale = sphere.loading(high);
  double a = high;
  if (sphere.unloading(low) > -1e3 * work_scale) {
    a = find_root([&](double at) { return sphere.unloading(at) / work_scale; }, low, high);
  }
  return std::sqrt(2.0 * sphere.loading(std::isfinite(a) ? a : high) / contact.mass());
}

double wall_capture_velocity(double mass, double restitution, double energy_difference) {
  return std::sqrt(std::max(0.0, -2.0 * energy_difference / (mass * restitution * restitution)));
}

}  // namespace recoil
