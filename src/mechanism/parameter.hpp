#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "impact/impact.hpp"

namespace recoil {

struct Mechanism;

/// Values that a parameter can physically have, and why.
struct PlausibleRange {
  double lower = 0.0;
  double upper = 0.0;
  std::string_view why;
};

/// What a parameter can at most be, as a share of the reduced modulus E* of the bodies: what no
/// catalogue can know in Pa.
struct ModulusLimit {
  double share = std::numeric_limits<double>::infinity();
  std::string_view why = {};
};

/// What a parameter is to the base model.
enum class ParameterRole {
  of_mechanism,      ///< nothing: it belongs to a mechanism
  hertz_damping,     ///< C_H
  adhesion_damping,  ///< C_A
  adhesion_force,    ///< f0: follows from the materials (eq. 12) unless a fit says otherwise
  adhesion_energy,   ///< W, in the place of f0 under another adhesion law than the ring's
};

/// One parameter that a fit may have, of the base model or of a mechanism. It is described here and
/// nowhere else: the statement of a fit file and the slots of theta point to it.
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
  bool log_scale = false;           ///< positive over several decades: its logarithm is fitted
  bool per_series = false;          ///< one value for every series
  /// The relative scatter of single slow rebounds: starts at what the points state of it.
  bool is_scatter_of_rebounds = false;
  ModulusLimit modulus_limit = {};
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

/// Those and the parameters of the mechanisms `ids`, in the order in which the mechanisms act.
std::vector<const Parameter*> parameters_with(const std::vector<std::string>& ids,
                                              AdhesionLaw law = AdhesionLaw::ring);

}  // namespace recoil
