#include "mechanism/parameter.hpp"

#include "mechanism/catalogue.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {

const std::vector<Parameter>& base_parameters(AdhesionLaw law) {
  // Starts: C_H V = 0.03 costs 1 - e = 2/3 C_H V = 0.02 at 10 m/s, and this C_A makes the model
  // capture ammonium fluorescein of 4.9 um below about 1 m/s, both near what Wall et al. (1990)
  // saw. f0 starts at eq. 12 of its dataset unless the fit says otherwise; its number here is only
  // the magnitude of Table 1 of Li, Dunn & Brach (1999).
  static const std::vector<Parameter> all = {
      {.name = "C_H",
       .unit = "s/m",
       .meaning = "Hertz damping",
       .initial = 3e-3,
       .lower = 0.0,
       .upper = 1.0,
       .role = ParameterRole::hertz_damping},
      {.name = "C_A",
       .unit = "s/m",
       .meaning = "adhesion damping",
       .initial = 3e-2,
       .lower = 0.0,
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
  return law == AdhesionLaw::ring ? all : by_energy;
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

}  // namespace recoil
