#include "predict/capture_jkr.hpp"

#include <cmath>
#include <numbers>

namespace recoil {
namespace {

using std::numbers::pi;

/// U of the header, for alpha^3 = `cube`.
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

}  // namespace recoil
