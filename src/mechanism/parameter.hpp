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

/// Values that a parameter can physically have, and why.
struct PlausibleRange {
  double lower = 0.0;
  double upper = 0.0;
  std::string_view why;
};

/// What no catalogue can know in a parameter's own unit, as it depends on the bodies, their size,
/// the velocity or the gas: a dimensionless quantity of an impact, and what it can be. The impact
/// with the largest quantity counts.
struct PlausibleLimit {
  std::string_view quantity = {};  ///< in words
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  std::string_view why = {};
  bool sharp = false;  ///< nothing lies even somewhat beyond
  /// The quantity [1] of a sphere as it arrives, `own` being the parameters of the mechanism. It
  /// rises with the parameter that has this limit. Null: there is no limit.
  double (*of)(const Encounter<double>& sphere, std::span<const double> own) = nullptr;
};

struct Surroundings;

/// The condition that says what a parameter is, where it is stated.
struct StatedBy {
  Condition condition = Condition::ambient_pressure;
  /// The value [unit of the parameter] under the condition [its unit] in these surroundings; empty
  /// where the condition leaves it open. Null: the condition is the parameter.
  std::optional<double> (*value)(double stated, const Surroundings& at,
                                 const Conditions& all) = nullptr;
};

/// States that a strength is 0 where `condition`, a yes-or-no one, is yes.
StatedBy none_where(Condition condition);

/// What a parameter is to the base model.
enum class ParameterRole {
  of_mechanism,       ///< nothing: it belongs to a mechanism
  hertz_damping,      ///< C_H
  adhesion_damping,   ///< C_A
  adhesion_force,     ///< f0: follows from the materials (eq. 12) unless a fit says otherwise
  adhesion_energy,    ///< W, in the place of f0 under another adhesion law than the ring's
  material_constant,  ///< a constant of the bodies that is known with an error
};

/// One parameter that a fit may have, of the base model or of a mechanism. It is described here and
/// nowhere else: the statement of a fit file and the slots of theta point to it. An entry states
/// what differs from the defaults.
struct Parameter {
  std::string_view name;  ///< as a fit file has it; unique
  std::string_view unit;
  std::string_view meaning;
  double null_value = 0.0;  ///< here a mechanism vanishes
  double initial = 0.0;     ///< where a fit starts
  double lower = 0.0;       ///< bounds; of a mechanism also the domain of the formula
  double upper = 0.0;
  PlausibleRange plausible = {};
  std::vector<double> starts = {};  ///< further ones worth trying
  bool free = true;                 ///< fitted unless the fit file says otherwise
  bool searched = true;             ///< where it is not free, a search for causes may free it
  bool log_scale = false;           ///< positive over several decades: its logarithm is fitted
  bool per_series = false;          ///< one value for every series
  /// The relative scatter of single slow rebounds: starts at what the points state of it.
  bool is_scatter_of_rebounds = false;
  PlausibleLimit limit = {};             ///< beside `plausible`
  std::vector<StatedBy> stated_by = {};  ///< the first that says something counts
  ParameterRole role = ParameterRole::of_mechanism;
  const Mechanism* mechanism = nullptr;  ///< to which it belongs (set by the catalogue); null for
                                         ///< the base model

  bool is_damping() const {
    return role == ParameterRole::hertz_damping || role == ParameterRole::adhesion_damping;
  }
  bool is_adhesion() const {
    return role == ParameterRole::adhesion_force || role == ParameterRole::adhesion_energy;
  }
};

/// C_H, C_A and f0, in this order; under another law than the ring's W stands for f0.
const std::vector<Parameter>& base_parameters(AdhesionLaw law = AdhesionLaw::ring);

/// What `conditions` say of a parameter, and which of them does.
struct StatedValue {
  double value = 0.0;
  Condition by = Condition::ambient_pressure;
  bool operator==(const StatedValue&) const = default;
};
/// Empty where they leave it open.
std::optional<StatedValue> stated_value(const Parameter& parameter, const Surroundings& at,
                                        const Conditions& conditions);

/// A constant of the materials as a parameter: "particle.youngs_modulus".
const Parameter& parameter_of(Body body, Constant constant);

/// Those and the parameters of the mechanisms `ids`, in the order in which the mechanisms act.
std::vector<const Parameter*> parameters_with(const std::vector<std::string>& ids,
                                              AdhesionLaw law = AdhesionLaw::ring);

}  // namespace recoil
