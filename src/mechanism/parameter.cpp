#include "mechanism/parameter.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

/// The place where `rises` changes from false at `lower` to true at `upper`, by bisection down to
/// neighbouring numbers, in a range that may span eighteen decades.
template <class Rises>
double change(const Rises& rises, double lower, double upper) {
  constexpr int halvings = 1100;  // more than the exponents of a double
  for (int i = 0; i < halvings; ++i) {
    const double middle = lower + 0.5 * (upper - lower);
    if (middle <= lower || middle >= upper) break;
    (rises(middle) ? upper : lower) = middle;
  }
  return upper;
}

}  // namespace

const std::vector<Parameter>& base_parameters(AdhesionLaw law) {
  // Initial values: C_H V = 0.03 at 10 m/s gives 1 - e = (2/3) C_H V = 0.02, and this C_A gives a
  // capture velocity of about 1 m/s for ammonium fluorescein of 4.9 um; both are near the results
  // of Wall et al. (1990). A fit starts with f0 from eq. 12 unless it states another value; the
  // number here is the magnitude of Table 1 of Li, Dunn & Brach (1999).
  static const std::vector<Parameter> all = {
      {.name = "C_H",
       .unit = "s/m",
       .meaning = "Hertz damping",
       .initial = 3e-3,
       .upper = 1.0,
       .role = ParameterRole::hertz_damping},
      {.name = "C_A",
       .unit = "s/m",
       .meaning = "adhesion damping",
       .initial = 3e-2,
       .upper = 10.0,
       .role = ParameterRole::adhesion_damping},
      {.name = "f0",
       .unit = "N/m",
       .meaning = "adhesion force per length of the contact's edge",
       .initial = 10.0,
       .lower = 1e-6,
       .upper = 1e6,
       .free = false,
       .log_scale = true,
       .role = ParameterRole::adhesion_force},
  };
  // 0.1 J/m2: between clean polymers (0.05) and Gilman's estimates for metals (1).
  static const std::vector<Parameter> by_energy = {
      all[0],
      all[1],
      {.name = "W",
       .unit = "J/m2",
       .meaning = "work of adhesion",
       .initial = 0.1,
       .lower = 1e-6,
       .upper = 100.0,
       .free = false,
       .log_scale = true,
       .role = ParameterRole::adhesion_energy},
  };
  return traits(law).by_force ? all : by_energy;
}

const Parameter& parameter_of(Body body, Constant constant) {
  struct Entry {
    Body body;
    Constant constant;
    Parameter parameter;
  };
  const auto entry = [](Body of, Constant which, std::string_view name, std::string_view unit,
                        std::string_view meaning) {
    return Entry{of,
                 which,
                 {.name = name,
                  .unit = unit,
                  .meaning = meaning,
                  .free = false,
                  .log_scale = is_positive(which),
                  .role = ParameterRole::material_constant}};
  };
  using enum Constant;
  static const std::vector<Entry> all = {
      entry(Body::particle, density, "particle.density", "kg/m3", "density of the sphere"),
      entry(Body::particle, youngs_modulus, "particle.youngs_modulus", "Pa",
            "Young's modulus of the sphere"),
      entry(Body::particle, poisson_ratio, "particle.poisson_ratio", "1",
            "Poisson's ratio of the sphere"),
      entry(Body::particle, surface_energy, "particle.surface_energy", "J/m2",
            "surface energy of the sphere"),
      entry(Body::particle, gilman_factor, "particle.gilman_factor", "1",
            "surface energy of the sphere / Gilman's estimate"),
      entry(Body::surface, density, "surface.density", "kg/m3", "density of the surface"),
      entry(Body::surface, youngs_modulus, "surface.youngs_modulus", "Pa",
            "Young's modulus of the surface"),
      entry(Body::surface, poisson_ratio, "surface.poisson_ratio", "1",
            "Poisson's ratio of the surface"),
      entry(Body::surface, surface_energy, "surface.surface_energy", "J/m2",
            "surface energy of the surface"),
      entry(Body::surface, gilman_factor, "surface.gilman_factor", "1",
            "surface energy of the surface / Gilman's estimate"),
      entry(Body::pair, stiffness_K, "stiffness_K", "Pa", "stiffness of the contact"),
      entry(Body::pair, adhesion_energy, "adhesion_energy", "J/m2", "work of adhesion"),
      entry(Body::pair, adhesion_force_f0, "adhesion_force_f0", "N/m",
            "adhesion force per length of the contact's edge")};
  const auto found = std::ranges::find_if(
      all, [&](const Entry& one) { return one.body == body && one.constant == constant; });
  assert(found != all.end());
  return found->parameter;
}

std::optional<StatedValue> stated_value(const Parameter& parameter, const Surroundings& at,
                                        const Conditions& conditions) {
  for (const StatedBy& by : parameter.stated_by) {
    const auto condition = conditions.of(by.condition);
    if (!condition) continue;
    std::optional<double> value = condition;
    if (by.zero_up_to) {
      value = *condition <= *by.zero_up_to ? std::optional(0.0) : std::nullopt;
    } else if (by.value != nullptr) {
      value = by.value(*condition, at, conditions);
    }
    if (!value) continue;
    return StatedValue{std::clamp(*value, parameter.lower, parameter.upper), by.condition};
  }
  return std::nullopt;
}

StatedBy none_where(Condition condition) {
  return {condition, [](double stated, const Surroundings&, const Conditions&) {
            return stated > 0.0 ? std::optional<double>(0.0) : std::nullopt;
          }};
}

std::vector<const Parameter*> parameters_with(const std::vector<std::string>& ids,
                                              AdhesionLaw law) {
  std::vector<const Parameter*> parameters;
  for (const Parameter& parameter : base_parameters(law)) parameters.push_back(&parameter);
  for (const Mechanism* mechanism : chain_of(ids)) {
    for (const Parameter& parameter : mechanism->info.parameters) parameters.push_back(&parameter);
  }
  return parameters;
}

AllowedValues allowed_values(const Parameter& parameter, std::size_t k, std::span<const double> own,
                             std::span<const Encounter<double>> spheres) {
  AllowedValues allowed{parameter.plausible.lower, parameter.plausible.upper};
  const PlausibleLimit& limit = parameter.limit;
  if (limit.of == nullptr || spheres.empty()) return allowed;
  std::vector<double> values(own.begin(), own.end());
  const auto quantity = [&](double value) {
    values[k] = value;
    double largest = -std::numeric_limits<double>::infinity();
    for (const Encounter<double>& sphere : spheres) {
      largest = std::max(largest, limit.of(sphere, values));
    }
    return largest;
  };
  allowed.quantity = quantity(own[k]);
  const double lower = allowed.lower;
  const double upper = allowed.upper;
  if (quantity(upper) > limit.upper) {
    allowed.upper_by_limit = true;
    allowed.upper = change([&](double v) { return quantity(v) > limit.upper; }, lower, upper);
  }
  if (quantity(lower) < limit.lower) {
    allowed.lower_by_limit = true;
    allowed.lower =
        quantity(upper) < limit.lower
            ? upper
            : change([&](double v) { return quantity(v) >= limit.lower; }, lower, upper);
    allowed.lower = std::min(allowed.lower, allowed.upper);
  }
  return allowed;
}

}  // namespace recoil
