#include "data/inherited_system.hpp"

#include <algorithm>
#include <optional>

#include "core/error.hpp"
#include "data/contact.hpp"
#include "data/json_document.hpp"
#include "data/system.hpp"

namespace recoil {
namespace {

/// Nothing when a key is unknown or a value is impossible.
std::optional<ImpactSystem> readable_system(const Json& system) {
  try {
    const JsonDocument document(system.dump(-1, ' ', false, Json::error_handler_t::replace), "");
    return read_system(document.root());
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

std::vector<LeftOverride> leave_out_contradictions(Json& system,
                                                   const std::vector<std::string>& own) {
  std::vector<LeftOverride> left;
  std::optional<ImpactSystem> kept = readable_system(system);
  if (!kept) return left;
  // No derived value but that of f0 depends on the diameter, and f0 is not stated without one.
  const double diameter = kept->reference_diameter.value_or(1e-6);
  const auto leave_out = [&](const char* key, std::optional<double> ImpactSystem::*stated,
                             double ContactProperties::*derived) {
    const std::optional<double> value = (*kept).*stated;
    const double other = derive_contact(*kept, diameter).*derived;
    if (std::find(own.begin(), own.end(), key) != own.end()) return false;
    if (!value || *value == 0.0 || !contradicts(*value, other)) return false;
    left.push_back({key, *value, other});
    system.erase(key);
    ((*kept).*stated).reset();
    return true;
  };
  leave_out("stiffness_K", &ImpactSystem::stiffness_K, &ContactProperties::stiffness_derived);
  leave_out("adhesion_energy", &ImpactSystem::adhesion_energy,
            &ContactProperties::adhesion_energy_derived);
  if (leave_out("adhesion_force_f0", &ImpactSystem::adhesion_force_f0,
                &ContactProperties::adhesion_force_derived)) {
    system.erase("reference_diameter");
  }
  return left;
}

}  // namespace recoil
