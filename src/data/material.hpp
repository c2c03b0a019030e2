#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/names.hpp"
#include "data/condition.hpp"
#include "data/method.hpp"

namespace recoil {

/// To what a material constant belongs.
enum class Body {
  particle,
  surface,
  pair  ///< of both: what a dataset states instead of deriving it
};
template <>
struct NamesOf<Body> {
  static constexpr std::array<std::string_view, 3> names = {"particle", "surface", "pair"};
};

/// What of a body, or of a pair of them, may be known with an error only.
enum class Constant {
  density,            ///< [kg/m3]
  youngs_modulus,     ///< [Pa]
  poisson_ratio,      ///< [1]
  surface_energy,     ///< [J/m2]
  gilman_factor,      ///< surface energy over Gilman's estimate of it, where none is stated [1]
  stiffness_K,        ///< of a pair [Pa]
  adhesion_energy,    ///< of a pair [J/m2]
  adhesion_force_f0,  ///< of a pair, at the reference diameter [N/m]
};
template <>
struct NamesOf<Constant> {
  static constexpr std::array<std::string_view, 8> names = {
      "density",       "youngs_modulus", "poisson_ratio",   "surface_energy",
      "gilman_factor", "stiffness_K",    "adhesion_energy", "adhesion_force_f0"};
};

/// Is a constant positive, and its error a factor? All are but Poisson's ratio.
constexpr bool is_positive(Constant constant) { return constant != Constant::poisson_ratio; }

/// The error that a dataset states of one of its constants.
struct ConstantError {
  Body body = Body::particle;
  Constant constant = Constant::density;
  double sd = 0.0;  ///< one standard deviation, in the constant's own unit, > 0
};

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
  Conditions conditions;                     ///< of all points that do not state their own
  Method method = Method::unknown;           ///< how velocities were measured
  std::vector<ConstantError> errors;         ///< of the constants that state one; others are exact

  /// What is stated of a constant, in its own unit; of gilman_factor 1.
  std::optional<double> value_of(Body body, Constant constant) const;
  /// The standard deviation that is stated of a constant, in its own unit; 0: exact.
  double error_of(Body body, Constant constant) const;
};

}  // namespace recoil
