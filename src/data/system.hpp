#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/names.hpp"
#include "data/limits.hpp"

namespace recoil {

class JsonNode;

/// The origin of points. It accompanies everything computed from them.
enum class Provenance { measured, digitised, reconstruction, synthetic };
constexpr auto names_of_values(Provenance) {
  return name_list("measured", "digitised", "reconstruction", "synthetic");
}

/// How velocities were measured, which determines the possible errors of measurement.
enum class Method { unknown, velocimeter, drop_heights, bounce_intervals, video };
constexpr auto names_of_values(Method) {
  return name_list("unknown", "velocimeter", "drop_heights", "bounce_intervals", "video");
}

/// A condition of the experiment besides velocities, diameters and materials.
enum class Condition {
  ambient_pressure,       ///< of the surrounding air; 0 is vacuum [Pa]
  relative_humidity,      ///< [1]
  temperature,            ///< [K]
  target_thickness,       ///< [m]
  probe_height,           ///< of the measuring plane above the surface [m]
  neutralised,            ///< 0 or 1: the charge of the spheres is removed
  surface_rms_roughness,  ///< [m]
  velocities_calibrated,  ///< 0 or 1: readings were checked against a known velocity or height
  sizes_calibrated,       ///< 0 or 1: the diameters were checked against a standard
  film_thickness,         ///< of a liquid on both bodies together; 0: they are dry [m]
  sizes_equal             ///< 0 or 1: the spheres of a point were sieved or measured one by one
};
constexpr auto names_of_values(Condition) {
  return name_list("ambient_pressure", "relative_humidity", "temperature", "target_thickness",
                   "probe_height", "neutralised", "surface_rms_roughness", "velocities_calibrated",
                   "sizes_calibrated", "film_thickness", "sizes_equal");
}

/// The values of a condition.
struct ConditionInfo : Range {
  std::string_view meaning;
  bool yes_or_no = false;  ///< only 0 or 1 is accepted
};
const ConditionInfo& info_of(Condition condition);

/// The stated conditions of impacts.
class Conditions {
 public:
  std::optional<double> of(Condition condition) const {
    return values_[static_cast<std::size_t>(condition)];
  }
  void set(Condition condition, double value) {
    values_[static_cast<std::size_t>(condition)] = value;
  }
  /// These conditions, completed by those of `others`.
  Conditions or_else(const Conditions& others) const;
  bool operator==(const Conditions&) const = default;
  /// An arbitrary order, for maps.
  bool operator<(const Conditions& other) const { return values_ < other.values_; }

 private:
  std::array<std::optional<double>, count_of<Condition>> values_;
};

/// The body that a material constant belongs to.
enum class Body {
  particle,
  surface,
  pair  ///< both: a constant of the contact that the dataset states directly
};
constexpr auto names_of_values(Body) { return name_list("particle", "surface", "pair"); }

/// A constant that may be known with an error.
enum class Constant {
  density,            ///< [kg/m3]
  youngs_modulus,     ///< [Pa]
  poisson_ratio,      ///< [1]
  surface_energy,     ///< [J/m2]
  gilman_factor,      ///< surface energy over Gilman's estimate of it, where it is not stated [1]
  stiffness_K,        ///< of a pair [Pa]
  adhesion_energy,    ///< of a pair [J/m2]
  adhesion_force_f0,  ///< of a pair, at the reference diameter [N/m]
};
constexpr auto names_of_values(Constant) {
  return name_list("density", "youngs_modulus", "poisson_ratio", "surface_energy", "gilman_factor",
                   "stiffness_K", "adhesion_energy", "adhesion_force_f0");
}

/// True for all constants except Poisson's ratio: they are positive, and their errors are factors.
constexpr bool is_positive(Constant constant) { return constant != Constant::poisson_ratio; }

/// The error that a dataset states for one of its constants.
struct ConstantError {
  Body body = Body::particle;
  Constant constant = Constant::density;
  double sd = 0.0;  ///< one standard deviation, in the constant's own unit, > 0
};

/// An elastic solid, as a dataset states it.
struct Material {
  std::string name;
  double density = 0.0;                       ///< [kg/m3]; 0: not stated, for the surface only
  double youngs_modulus = 0.0;                ///< E [Pa]
  double poisson_ratio = 0.0;                 ///< nu [1], -1 < nu <= 0.5
  std::optional<double> surface_energy;       ///< gamma [J/m2]; Gilman's estimate when absent
  std::optional<double> hardness = {};        ///< [Pa]
  std::optional<double> yield_strength = {};  ///< in uniaxial tension or compression [Pa]
  std::optional<double> relative_permittivity = {};  ///< of the surface [1]; absent: a conductor

  /// The mean pressure at which a contact flows: the hardness, else 2.8 times the yield strength
  /// (Tabor 1951, The Hardness of Metals), else empty [Pa].
  std::optional<double> yield_pressure() const {
    if (hardness) return hardness;
    if (yield_strength) return 2.8 * *yield_strength;
    return std::nullopt;
  }
  /// True for an elastomer or a foam, which does not yield: Young's modulus below 0.1 GPa, while
  /// that of other polymers is larger (Ashby, M. F. 2011, Materials Selection in Mechanical Design,
  /// 4th ed., figure 4.3). A material with a stated strength yields.
  bool is_elastomer() const { return !yield_pressure() && youngs_modulus < 1e8; }
};

/// The two bodies of an impact, the constants of the contact that the dataset states directly, and
/// the conditions of all points.
struct ImpactSystem {
  Material particle;
  Material surface;
  std::optional<double> surface_diameter;    ///< of a second, free sphere [m]; a flat without it
  std::optional<double> stiffness_K;         ///< K [Pa], instead of eq. 6
  std::optional<double> adhesion_energy;     ///< W_A [J/m2], instead of 2 sqrt(gamma1 gamma2)
  std::optional<double> adhesion_force_f0;   ///< f0 [N/m] at `reference_diameter`, not by eq. 12
  std::optional<double> reference_diameter;  ///< [m]
  Conditions conditions;                     ///< of all points that do not state their own
  Method method = Method::unknown;           ///< how velocities were measured
  std::vector<ConstantError> errors;         ///< of the constants that state one; others are exact

  /// The stated value of a constant, in its own unit; 1 for gilman_factor.
  std::optional<double> value_of(Body body, Constant constant) const;
  /// The stated standard deviation of a constant, in its own unit; 0: exact.
  double error_of(Body body, Constant constant) const;
};

/// The `provenance` of the object under the key `recoil` of datapackage.json.
/// @throws InputError at the value, or when it is missing.
Provenance read_provenance(const JsonNode& recoil);

/// The materials, overrides and conditions of the object under the key `recoil`. Unknown keys are
/// refused. @throws InputError at a key or value that is missing or physically impossible
ImpactSystem read_system(const JsonNode& recoil);

}  // namespace recoil
