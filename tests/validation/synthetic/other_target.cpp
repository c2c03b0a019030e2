#include "validation/synthetic/other_target.hpp"

#include <cmath>

#include "core/random.hpp"
#include "validation/synthetic/purpose.hpp"

namespace hidden {
namespace {

constexpr std::uint64_t draw_of_target = 2000;  // of the streams of an experiment

/// K [Pa] of the moduli alone.
double stiffness_of_moduli(Base base) {
  base.stated_stiffness = 0.0;
  return base.stiffness();
}

}  // namespace

Elsewhere move_to(const OtherTarget& target, const Base& base, const Effects& effects,
                  std::uint64_t seed) {
  recoil::RandomStream random(seed, hidden_purpose,
                              draw_of_target + static_cast<std::uint64_t>(target.modulus / 1e8));
  Elsewhere there;
  there.target = target;
  there.expected = base;
  Base& b = there.expected;
  b.surface_modulus = target.modulus;
  b.surface_ratio = target.ratio;
  b.surface_density = target.density;
  const double stiffer = stiffness_of_moduli(b) / stiffness_of_moduli(base);
  const double stickier = b.adhesion_energy() / base.adhesion_energy();
  b.stated_stiffness = base.stated_stiffness * stiffer;
  // Contact at rest: a^3 = 6 pi W r^2 / K, 2 pi f0 = K a^2 / r.
  b.adhesion_force = base.adhesion_force * std::pow(stickier, 2.0 / 3.0) * std::cbrt(stiffer);
  const double work = std::exp(log_sd_of_work * random.normal());
  there.base = b;
  there.base.adhesion_force *= std::pow(work, 2.0 / 3.0);
  there.base.C_H *= std::exp(log_sd_of_damping * random.normal());
  there.base.C_A *= std::exp(log_sd_of_damping * random.normal());
  there.effects = effects;
  Effects& e = there.effects;
  for (double* energy : {&e.jkr_work, &e.contact.hysteresis_energy, &e.contact.crack_energy}) {
    *energy *= stickier * work;
  }
  e.contact.plate_mobility = 0.0;
  e.asperity_energy = 0.0;
  const double size = size_of_offsets(effects);  // every batch there is a new one
  for (double& offset : e.series_offset) offset = size * random.normal();
  return there;
}

}  // namespace hidden
