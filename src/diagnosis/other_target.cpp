#include "diagnosis/other_target.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "data/contact.hpp"
#include "mechanism/catalogue.hpp"

namespace recoil {
namespace {

constexpr double worth_changing = 1.2;  // factor of K or W_A

/// The two bodies with another surface, everything derived.
ImpactSystem with_surface(const ImpactSystem& system, const TargetMaterial& material) {
  ImpactSystem other = system;
  other.surface = {std::string(material.name), material.density, material.youngs_modulus,
                   material.poisson_ratio, std::nullopt};
  other.stiffness_K.reset();
  other.adhesion_energy.reset();
  other.adhesion_force_f0.reset();
  std::erase_if(other.errors,
                [](const ConstantError& error) { return error.body != Body::particle; });
  return other;
}

double reference_of(const Dataset& dataset) {
  if (dataset.system.reference_diameter) return *dataset.system.reference_diameter;
  const std::vector<double> diameters = distinct_diameters(dataset);
  return diameters[diameters.size() / 2];
}

/// What changes from target to target.
struct Change {
  double stiffness = 1.0;  ///< factor of K
  double energy = 1.0;     ///< of W_A, both surfaces' energies being Gilman's
};

Change change_to(const Dataset& dataset, const TargetMaterial& material) {
  const ContactProperties here = derive_contact(dataset.system, reference_of(dataset));
  const ContactProperties there =
      derive_contact(with_surface(dataset.system, material), reference_of(dataset));
  const double modulus = dataset.system.surface.youngs_modulus;
  return {there.stiffness_derived / here.stiffness_derived,
          std::sqrt(material.youngs_modulus / modulus)};
}

bool is_great(double factor) { return std::max(factor, 1.0 / factor) > worth_changing; }

/// What takes away those effects that a thin or rough target has.
void make_thick_and_polished(Conditions& conditions) {
  for (const Mechanism& mechanism : mechanism_catalogue()) {
    const auto& away = mechanism.info.taken_away;
    if (!away) continue;
    const bool of_target = away->condition == Condition::target_thickness ||
                           away->condition == Condition::surface_rms_roughness;
    if (of_target) conditions.set(away->condition, away->value);
  }
}

}  // namespace

const std::vector<TargetMaterial>& target_materials() {
  // CRC Handbook of Chemistry and Physics (hard metal with 6 % cobalt, alumina as single crystal,
  // carbon steel, vitreous silica); poly(methyl methacrylate): Brandrup, Polymer Handbook.
  static const std::vector<TargetMaterial> all = {
      {"tungsten carbide", 620e9, 0.22, 14900.0},
      {"sapphire", 400e9, 0.28, 3980.0},
      {"steel", 210e9, 0.29, 7850.0},
      {"fused silica", 73e9, 0.17, 2200.0},
      {"acrylic glass", 3.1e9, 0.37, 1190.0},
  };
  return all;
}

std::vector<TargetMaterial> other_targets(const Dataset& dataset) {
  std::vector<TargetMaterial> found;
  for (const TargetMaterial& material : target_materials()) {
    if (material.youngs_modulus < dataset.system.particle.youngs_modulus) continue;
    const Change change = change_to(dataset, material);
    const bool adheres =
        derive_contact(dataset.system, reference_of(dataset)).adhesion_energy > 0.0;
    if (is_great(change.stiffness) || (adheres && is_great(change.energy))) {
      found.push_back(material);
    }
  }
  return found;
}

Dataset on_target(const Dataset& dataset, const TargetMaterial& material) {
  const ImpactSystem& here = dataset.system;
  const Change change = change_to(dataset, material);
  Dataset other;
  other.id = dataset.id + "-on-" + std::string(material.name);
  std::replace(other.id.begin(), other.id.end(), ' ', '-');
  other.provenance = dataset.provenance;
  other.columns = dataset.columns;
  other.mixed_sizes = dataset.mixed_sizes;
  other.series = {std::string(material.name)};
  other.series_conditions.resize(1);
  other.system = with_surface(here, material);
  if (here.stiffness_K) other.system.stiffness_K = *here.stiffness_K * change.stiffness;
  if (here.adhesion_energy) other.system.adhesion_energy = *here.adhesion_energy * change.energy;
  if (here.adhesion_force_f0) {
    other.system.adhesion_force_f0 =
        *here.adhesion_force_f0 * std::cbrt(change.energy * change.energy * change.stiffness);
  }
  other.system.reference_diameter = reference_of(dataset);
  other.system.conditions = dataset.points.empty()
                                ? here.conditions
                                : conditions_of(dataset, dataset.points.front().series);
  make_thick_and_polished(other.system.conditions);
  return other;
}

}  // namespace recoil
