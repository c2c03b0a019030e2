#include "data/system.hpp"

#include <fmt/format.h>

#include <cmath>

#include "data/limits.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

/// What a physical constant may be, and what a value outside of it usually means.
struct Allowed {
  double lower;
  double upper;
  std::string unit;
  std::string hint;
};

double bounded(const JsonNode& node, const Allowed& range) {
  const double value = node.number();
  if (value >= range.lower && value <= range.upper) return value;
  node.fail(
      fmt::format("{} = {:g} {}", node.name(), value, range.unit),
      fmt::format("it has to lie between {:g} and {:g} {}", range.lower, range.upper, range.unit),
      range.hint);
}

std::optional<double> bounded_if_any(const JsonNode& parent, const std::string& key,
                                     const Allowed& range) {
  if (const auto node = parent.find(key)) return bounded(*node, range);
  return std::nullopt;
}

// A factor of e^3 either way as one standard deviation is no knowledge of a constant.
constexpr double largest_relative_error = 3.0;

/// The `sd` of { "value": ..., "sd": ... } or { "value": ..., "relative_sd": ... }.
double stated_sd(const JsonNode& node, double value) {
  const auto sd = node.find("sd");
  const auto relative = node.find("relative_sd");
  if (sd && relative) {
    relative->fail(fmt::format("{} has both sd and relative_sd", node.name()),
                   "either of them is enough", "remove one of them");
  }
  if (!sd && !relative) {
    node.fail(fmt::format("{} is an object without sd or relative_sd", node.name()),
              "an exact value is a bare number",
              "add its standard deviation, or write the number alone");
  }
  const JsonNode& place = sd ? *sd : *relative;
  const double number = place.number();
  const double size = sd ? number : number * std::abs(value);
  if (!(number >= 0.0)) {
    place.fail(fmt::format("{} = {:g}", place.name(), number),
               "a standard deviation is not negative", "leave out the minus sign");
  }
  if (size > largest_relative_error * std::abs(value)) {
    place.fail(
        fmt::format("{} = {:g}", place.name(), number),
        fmt::format("it is more than {:g} times the value {:g}", largest_relative_error, value),
        sd ? "give it in the unit of the value" : "20 % is written 0.2");
  }
  return size;
}

/// A constant that may state its error: `read` takes its value, a bare number or `value`.
template <class Read>
double uncertain_constant(const JsonNode& node, Body body, Constant which, ImpactSystem& system,
                          const Read& read) {
  if (!node.is_object()) return read(node);
  node.allow_only({"value", "sd", "relative_sd"});
  const double value =
      read(node.require("value", "an error without a value means nothing", "add the value"));
  const double sd = stated_sd(node, value);
  if (sd > 0.0) system.errors.push_back({body, which, sd});
  return value;
}

const Allowed& density_range() {
  static const Allowed range{limits::lowest_density, limits::highest_density, "kg/m3",
                             "give it in kg/m3: 1 g/cm3 is 1000 kg/m3"};
  return range;
}

const Allowed& surface_energy_range() {
  static const Allowed range{0.0, limits::highest_surface_energy, "J/m2",
                             "give it in J/m2: 1 mJ/m2 is 1e-3 J/m2"};
  return range;
}

double poisson_ratio(const JsonNode& node) {
  const double value = node.number();
  if (value > -1.0 && value <= 0.5) return value;
  node.fail(fmt::format("{} = {:g}", node.name(), value),
            "an isotropic elastic solid has -1 < nu <= 0.5", "0.3 is usual for a metal");
}

Material read_material(const JsonNode& recoil, Body body, ImpactSystem& system) {
  const bool needs_density = body == Body::particle;
  const JsonNode node =
      recoil.require(to_string(body), "both bodies decide how stiff and sticky the contact is",
                     "state its material, youngs_modulus and poisson_ratio");
  node.allow_only({"material", "density", "youngs_modulus", "poisson_ratio", "surface_energy"});
  Material material;
  const auto within = [&](const JsonNode& stated, Constant which, const Allowed& range) {
    return uncertain_constant(stated, body, which, system,
                              [&](const JsonNode& value) { return bounded(value, range); });
  };
  if (const auto name = node.find("material")) material.name = printable(name->string());
  if (const auto density = node.find("density")) {
    material.density = within(*density, Constant::density, density_range());
  } else if (needs_density) {
    node.require("density", "the mass of the particle follows from it", "give it in kg/m3");
  }
  const Allowed modulus{limits::lowest_modulus, limits::highest_modulus, "Pa",
                        "give it in Pa: 1 GPa is 1e9 Pa"};
  material.youngs_modulus = within(
      node.require("youngs_modulus", "the contact's stiffness follows from it", "give it in Pa"),
      Constant::youngs_modulus, modulus);
  material.poisson_ratio = uncertain_constant(
      node.require("poisson_ratio", "the contact's stiffness follows from it", "0.3 is usual"),
      body, Constant::poisson_ratio, system, poisson_ratio);
  if (const auto energy = node.find("surface_energy")) {
    material.surface_energy = within(*energy, Constant::surface_energy, surface_energy_range());
  }
  return material;
}

void read_overrides(const JsonNode& recoil, ImpactSystem& system) {
  const auto of_pair = [&](Constant which, const Allowed& range) -> std::optional<double> {
    const auto node = recoil.find(to_string(which));
    if (!node) return std::nullopt;
    return uncertain_constant(*node, Body::pair, which, system,
                              [&](const JsonNode& value) { return bounded(value, range); });
  };
  system.stiffness_K =
      of_pair(Constant::stiffness_K, {limits::lowest_stiffness, limits::highest_stiffness, "Pa",
                                      "give it in Pa: 1 GPa is 1e9 Pa"});
  system.adhesion_energy = of_pair(Constant::adhesion_energy,
                                   {0.0, limits::highest_adhesion_energy, "J/m2",
                                    "give it in J/m2: 1 mJ/m2 is 1e-3 J/m2; 0 means no adhesion"});
  system.adhesion_force_f0 =
      of_pair(Constant::adhesion_force_f0,
              {0.0, limits::highest_adhesion_force, "N/m", "give it in N/m; 0 means no adhesion"});
  system.reference_diameter = bounded_if_any(
      recoil, "reference_diameter",
      {limits::smallest_diameter, limits::largest_diameter, "m", "give it in m: 1 um is 1e-6 m"});
  if (system.adhesion_force_f0 && !system.reference_diameter) {
    throw InputError(recoil.find("adhesion_force_f0")->where_key(),
                     "'adhesion_force_f0' without 'reference_diameter'",
                     "f0 depends on the size of the particle",
                     "add the diameter in m to which it belongs");
  }
}

void read_conditions(const JsonNode& conditions, ImpactSystem& system) {
  conditions.allow_only(all_names<Condition>());
  for (const Condition condition : values_of<Condition>()) {
    const ConditionInfo& info = info_of(condition);
    const std::string name(name_of(condition));
    const Allowed range{info.lower, info.upper, std::string(info.unit), std::string(info.hint)};
    const auto stated = bounded_if_any(conditions, name, range);
    if (!stated) continue;
    if (info.yes_or_no && *stated != std::trunc(*stated)) {
      conditions.find(name)->fail(fmt::format("{} = {:g}", name, *stated), "",
                                  std::string(info.hint));
    }
    system.conditions.set(condition, *stated);
  }
}

}  // namespace

Provenance read_provenance(const JsonNode& recoil) {
  const JsonNode node = recoil.require("provenance", "every result says where its points come from",
                                       "write measured, digitised, reconstruction or synthetic");
  const std::string word = node.string();
  if (const auto provenance = value_named<Provenance>(word)) return *provenance;
  node.fail(fmt::format("unknown provenance {}", quote(word)), "",
            did_you_mean(word, all_names<Provenance>()));
}

ImpactSystem read_system(const JsonNode& recoil) {
  recoil.allow_only({"provenance", "particle", "surface", "stiffness_K", "adhesion_energy",
                     "adhesion_force_f0", "reference_diameter", "conditions", "method",
                     "mixed_sizes"});
  ImpactSystem system;
  system.particle = read_material(recoil, Body::particle, system);
  system.surface = read_material(recoil, Body::surface, system);
  read_overrides(recoil, system);
  if (const auto conditions = recoil.find("conditions")) read_conditions(*conditions, system);
  if (const auto method = recoil.find("method")) {
    const std::string word = method->string();
    const auto known = value_named<Method>(word);
    if (!known) {
      method->fail(fmt::format("unknown method {}", quote(word)),
                   "it says how velocities were measured", did_you_mean(word, all_names<Method>()));
    }
    system.method = *known;
  }
  return system;
}

}  // namespace recoil
