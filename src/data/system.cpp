#include "data/system.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/units.hpp"
#include "data/json_document.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

double bounded(const JsonNode& node, const Range& range) {
  const double value = node.number();
  if (range.contains(value)) return value;
  node.fail(fmt::format("{} = {:g}{}", node.name(), value, unit_suffix(range.unit)),
            range.sentence(), range.hint_for(value));
}

/// A larger relative standard deviation states nothing about a constant [1].
constexpr double largest_relative_error = 3.0;

/// The standard deviation of { "value": ..., "sd": ... } or { "value": ..., "relative_sd": ... }.
double stated_sd(const JsonNode& node, double value) {
  const auto sd = node.find("sd");
  const auto relative = node.find("relative_sd");
  if (sd && relative) {
    relative->fail(fmt::format("{} has both sd and relative_sd", node.name()),
                   "one of them is enough", "remove one of them");
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

/// Reads a constant that may state its error: a number, or an object with `value` and error.
template <class Read>
double uncertain_constant(const JsonNode& node, Body body, Constant which, ImpactSystem& system,
                          const Read& read) {
  if (!node.is_object()) return read(node);
  node.allow_only({"value", "sd", "relative_sd"});
  const double value = read(node.require("value", "an error needs its value", "add the value"));
  const double sd = stated_sd(node, value);
  if (sd > 0.0) system.errors.push_back({body, which, sd});
  return value;
}

double poisson_ratio(const JsonNode& node) {
  const double value = node.number();
  if (value > -1.0 && value <= 0.5) return value;
  node.fail(fmt::format("{} = {:g}", node.name(), value),
            "an isotropic elastic solid has -1 < nu <= 0.5", "0.3 is usual for a metal");
}

Material read_material(const JsonNode& recoil, Body body, ImpactSystem& system) {
  const JsonNode node = recoil.require(
      to_string(body), "the stiffness and adhesion of the contact depend on both bodies",
      "state its material, youngs_modulus and poisson_ratio");
  std::vector<std::string> keys = {"material",       "density",  "youngs_modulus", "poisson_ratio",
                                   "surface_energy", "hardness", "yield_strength"};
  if (body == Body::surface) keys.insert(keys.end(), {"relative_permittivity", "diameter"});
  if (body == Body::particle) keys.emplace_back("temperature");  // checked, but not used
  node.allow_only(keys);
  const auto within = [&](const JsonNode& stated, Constant which, const Range& range) {
    return uncertain_constant(stated, body, which, system,
                              [&](const JsonNode& value) { return bounded(value, range); });
  };
  Material material;
  if (const auto name = node.find("material")) material.name = printable(name->string());
  if (const auto density = node.find("density")) {
    material.density = within(*density, Constant::density, limits::density);
  } else if (body == Body::particle) {
    node.require("density", "the mass of the particle follows from it", "give it in kg/m3");
  }
  material.youngs_modulus = within(
      node.require("youngs_modulus", "the contact's stiffness follows from it", "give it in Pa"),
      Constant::youngs_modulus, limits::youngs_modulus);
  material.poisson_ratio = uncertain_constant(
      node.require("poisson_ratio", "the contact's stiffness follows from it", "0.3 is usual"),
      body, Constant::poisson_ratio, system, poisson_ratio);
  if (const auto energy = node.find("surface_energy")) {
    material.surface_energy = within(*energy, Constant::surface_energy, limits::surface_energy);
  }
  if (const auto diameter = node.find("diameter")) {
    system.surface_diameter = bounded(*diameter, limits::diameter);
    node.require("density", "a surface with a diameter is a sphere, and its mass follows from it",
                 "give it in kg/m3, or leave out the diameter of a flat");
    // The reduced mass of two spheres is no power of their densities.
    for (const ConstantError& error : system.errors) {
      if (error.constant != Constant::density) continue;
      node.fail("two spheres, one with an uncertain density",
                "the error of a density is carried for a sphere on a flat alone",
                "state the densities without errors");
    }
  }
  const auto optional = [&](const char* key, const Range& range) -> std::optional<double> {
    const auto stated = node.find(key);
    return stated ? std::optional(bounded(*stated, range)) : std::nullopt;
  };
  optional("temperature", limits::temperature);
  material.hardness = optional("hardness", limits::strength);
  material.yield_strength = optional("yield_strength", limits::strength);
  material.relative_permittivity = optional("relative_permittivity", limits::permittivity);
  return material;
}

void read_overrides(const JsonNode& recoil, ImpactSystem& system) {
  const auto of_pair = [&](Constant which, const Range& range) -> std::optional<double> {
    const auto node = recoil.find(to_string(which));
    if (!node) return std::nullopt;
    return uncertain_constant(*node, Body::pair, which, system,
                              [&](const JsonNode& value) { return bounded(value, range); });
  };
  system.stiffness_K = of_pair(Constant::stiffness_K, limits::stiffness_K);
  system.adhesion_energy = of_pair(Constant::adhesion_energy, limits::adhesion_energy);
  system.adhesion_force_f0 = of_pair(Constant::adhesion_force_f0, limits::adhesion_force_f0);
  if (const auto diameter = recoil.find("reference_diameter")) {
    system.reference_diameter = bounded(*diameter, limits::reference_diameter);
  }
  if (system.adhesion_force_f0 && !system.reference_diameter) {
    throw InputError(recoil.find("adhesion_force_f0")->where_key(),
                     "'adhesion_force_f0' without 'reference_diameter'",
                     "f0 depends on the size of the particle",
                     "add the diameter in m to which it belongs");
  }
}

Conditions read_conditions(const JsonNode& node) {
  node.allow_only(all_names<Condition>());
  Conditions conditions;
  for (const Condition condition : values_of<Condition>()) {
    const auto stated = node.find(to_string(condition));
    if (!stated) continue;
    const ConditionInfo& info = info_of(condition);
    const double value = bounded(*stated, info);
    if (info.yes_or_no && value != std::trunc(value)) {
      stated->fail(fmt::format("{} = {:g}", name_of(condition), value), "", std::string(info.hint));
    }
    conditions.set(condition, value);
  }
  return conditions;
}

template <NamedEnum Enum>
Enum known_word(const JsonNode& node, const std::string& what, const std::string& why) {
  const std::string word = node.string();
  if (const auto known = value_named<Enum>(word)) return *known;
  node.fail(fmt::format("unknown {} {}", what, quote(word)), why,
            did_you_mean(word, all_names<Enum>()));
}

}  // namespace

std::string Range::sentence() const {
  if (unit == "rad") {
    return fmt::format("it has to lie between {:g} and {:g} deg", in_degrees(lower),
                       in_degrees(upper));
  }
  return fmt::format("it has to lie between {:g} and {:g}{}", lower, upper, unit_suffix(unit));
}

std::string Range::hint_for(double value) const {
  return std::string(value < lower && !hint_below.empty() ? hint_below : hint);
}

const ConditionInfo& info_of(Condition condition) {
  static constexpr std::array<ConditionInfo, count_of<Condition>> all = {{
      {limits::pressure, "pressure of the surrounding air, 0 in vacuum"},
      {limits::humidity, "relative humidity of the air"},
      {limits::temperature, "temperature of the air"},
      {limits::thickness, "thickness of the target, where it is a plate"},
      {limits::height, "height of the measuring plane above the surface"},
      {{0.0, 1.0, "1", "1 means neutralised, 0 that they were not"},
       "1 where the charge of the spheres was removed, else 0",
       true},
      {limits::roughness, "root mean square roughness of the surface"},
      {{0.0, 1.0, "1", "1 means checked, 0 that it was not"},
       "1 where the readings were checked against a known velocity or height, else 0",
       true},
      {{0.0, 1.0, "1", "1 means checked, 0 that they were not"},
       "1 where the diameters were checked against a standard, else 0",
       true},
      {limits::film,
       "thickness of a liquid film, on sphere and surface together; 0 where both are dry"},
      {{0.0, 1.0, "1", "1 means of one size, 0 that they were not"},
       "1 where the spheres of a point were sieved or measured one by one, else 0",
       true},
  }};
  return all[static_cast<std::size_t>(condition)];
}

Conditions Conditions::or_else(const Conditions& others) const {
  Conditions both = *this;
  for (std::size_t k = 0; k < values_.size(); ++k) {
    if (!both.values_[k]) both.values_[k] = others.values_[k];
  }
  return both;
}

std::optional<double> ImpactSystem::value_of(Body body, Constant constant) const {
  const Material& material = body == Body::surface ? surface : particle;
  const std::array<std::optional<double>, count_of<Constant>> values = {material.density,
                                                                        material.youngs_modulus,
                                                                        material.poisson_ratio,
                                                                        material.surface_energy,
                                                                        1.0,
                                                                        stiffness_K,
                                                                        adhesion_energy,
                                                                        adhesion_force_f0};
  return values[static_cast<std::size_t>(constant)];
}

double ImpactSystem::error_of(Body body, Constant constant) const {
  for (const ConstantError& stated : errors) {
    if (stated.body == body && stated.constant == constant) return stated.sd;
  }
  return 0.0;
}

Provenance read_provenance(const JsonNode& recoil) {
  return known_word<Provenance>(
      recoil.require("provenance", "every result says where its points come from",
                     "write measured, digitised, reconstruction or synthetic"),
      "provenance", "");
}

ImpactSystem read_system(const JsonNode& recoil) {
  recoil.allow_only({"provenance", "particle", "surface", "stiffness_K", "adhesion_energy",
                     "adhesion_force_f0", "reference_diameter", "conditions", "method",
                     "mixed_sizes"});
  ImpactSystem system;
  system.particle = read_material(recoil, Body::particle, system);
  system.surface = read_material(recoil, Body::surface, system);
  read_overrides(recoil, system);
  if (const auto conditions = recoil.find("conditions")) {
    system.conditions = read_conditions(*conditions);
  }
  if (const auto method = recoil.find("method")) {
    system.method = known_word<Method>(*method, "method", "it states how velocities were measured");
  }
  return system;
}

}  // namespace recoil
