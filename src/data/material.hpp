#pragma once

#include <optional>
#include <string>

#include "data/method.hpp"

namespace recoil {

/// An elastic solid, as a dataset states it.
struct Material {
  std::string name;
  double density = 0.0;                  ///< [kg/m3]; 0: not stated, for the surface only
  double youngs_modulus = 0.0;           ///< E [Pa]
  double poisson_ratio = 0.0;            ///< nu [1], -1 < nu <= 0.5
  std::optional<double> surface_energy;  ///< gamma [J/m2]; Gilman's estimate when absent
};

/// The two bodies of an impact, what the dataset states instead of deriving it, and the conditions
/// of all its points.
struct ImpactSystem {
  Material particle;
  Material surface;
  std::optional<double> stiffness_K;        ///< K [Pa], instead of eq. 6
  std::optional<double> adhesion_energy;    ///< W_A [J/m2], instead of 2 sqrt(gamma1 gamma2)
  std::optional<double> adhesion_force_f0;  ///< f0 [N/m] at `reference_diameter`, instead of eq. 12
  std::optional<double> reference_diameter;  ///< [m]
  std::optional<double> ambient_pressure;    ///< of the air around [Pa]; 0: vacuum, absent: unknown
  std::optional<double> temperature;         ///< [K]
  Method method = Method::unknown;           ///< how velocities were measured
};

}  // namespace recoil
