#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "data/system.hpp"
#include "impact/impact.hpp"

namespace recoil {

struct Mechanism;
template <class T>
struct Encounter;

/// The physically possible values of a parameter, with the reason.
struct PlausibleRange {
  double lower = 0.0;
  double upper = 0.0;
  std::string_view why;
};

/// A limit of a parameter that depends on the bodies, their size, the velocity or the gas, stated
/// as a range of a dimensionless quantity. The impact with the largest quantity decides.
struct PlausibleLimit {
  std::string_view quantity = {};  ///< name of the quantity
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  std::string_view why = {};
  bool sharp = false;  ///< values slightly beyond the limit are impossible, too
  /// The quantity [1] of a sphere before the impact; `own` are the parameters of the mechanism. It
  /// increases with the parameter that has this limit. Null: there is no limit.
  double (*of)(const Encounter<double>& sphere, std::span<const double> own) = nullptr;
};

struct Surroundings;

/// A condition that determines the value of a parameter.
struct StatedBy {
  Condition condition = Condition::ambient_pressure;
  /// The value [unit of the parameter] for the condition [its unit] in these surroundings; empty if
  /// the condition does not determine it. Null: the condition itself is the parameter.
  std::optional<double> (*value)(double stated, const Surroundings& at,
                                 const Conditions& all) = nullptr;
  /// The parameter is 0 if the condition is at most this, and otherwise not determined.
  std::optional<double> zero_up_to = {};
};

/// States that a parameter is 0 if the condition, which is 0 or 1, is 1.
StatedBy none_where(Condition condition);

/// The role of a parameter in the base model.
enum class ParameterRole {
  of_mechanism,       ///< none: it belongs to a mechanism
  hertz_damping,      ///< C_H
  adhesion_damping,   ///< C_A
  adhesion_force,     ///< f0: follows from the materials (eq. 12) unless a fit states it
  adhesion_energy,    ///< W, instead of f0, under other adhesion laws than the ring law
  material_constant,  ///< a constant of the bodies that is known with an error
  law_error,          ///< a coefficient of the error of the laws
};

/// A parameter of the base model or of a mechanism. Fit files and the slots of theta refer to this
/// description. One member for each statement; most have a default.
struct Parameter {
  std::string_view name;  ///< in fit files; unique
  std::string_view unit;
  std::string_view meaning;
  double null_value = 0.0;  ///< the value at which the mechanism has no effect
  double initial = 0.0;     ///< initial value of a fit
  double lower = 0.0;       ///< bounds; for a mechanism also the domain of its formula
  double upper = 0.0;
  PlausibleRange plausible = {};
  std::vector<double> starts = {};  ///< further initial values to try
  bool free = true;                 ///< fitted unless the fit file fixes it
  bool searched = true;             ///< a search for causes may free it if it is fixed
  bool log_scale = false;           ///< positive over several decades: its logarithm is fitted
  bool per_series = false;          ///< every series has its own value
  /// It is the relative scatter of single slow rebounds, and starts at the scatter of the points.
  bool is_scatter_of_rebounds = false;
  PlausibleLimit limit = {};             ///< in addition to `plausible`
  std::vector<StatedBy> stated_by = {};  ///< the first one that determines a value is used
  ParameterRole role = ParameterRole::of_mechanism;
  const Mechanism* mechanism = nullptr;  ///< its mechanism (set by the catalogue); null: base model

  bool is_damping() const {
    return role == ParameterRole::hertz_damping || role == ParameterRole::adhesion_damping;
  }
  bool is_adhesion() const {
    return role == ParameterRole::adhesion_force || role == ParameterRole::adhesion_energy;
  }
};

/// C_H, C_A and f0, in this order; W instead of f0 under other laws than the ring law.
const std::vector<Parameter>& base_parameters(AdhesionLaw law = AdhesionLaw::ring);

/// A value that a condition determines.
struct StatedValue {
  double value = 0.0;
  Condition by = Condition::ambient_pressure;
  bool operator==(const StatedValue&) const = default;
};
/// The value of a parameter that `conditions` determine; empty if they do not.
std::optional<StatedValue> stated_value(const Parameter& parameter, const Surroundings& at,
                                        const Conditions& conditions);

/// A constant of the materials as a parameter: "particle.youngs_modulus".
const Parameter& parameter_of(Body body, Constant constant);

/// The base parameters and those of the mechanisms `ids`, in the order in which the mechanisms act.
std::vector<const Parameter*> parameters_with(const std::vector<std::string>& ids,
                                              AdhesionLaw law = AdhesionLaw::ring);

}  // namespace recoil
