#pragma once

#include <string>
#include <vector>

#include "estimate/model.hpp"
#include "impact/groups.hpp"
#include "impact/impact.hpp"
#include "predict/validity.hpp"

namespace recoil {

/// The allowed range of a velocity [m/s] and of a diameter [um], on the command line and in Python.
inline constexpr std::pair<double, double> velocity_limits = {1e-7, 1e4};
inline constexpr std::pair<double, double> diameter_limits_um = {1e-3, 1e6};

/// One impact of a model: the measured e as a fit predicts it, with mechanisms and averaged over
/// sizes that the dataset states, and the impact of the base model at the contact of one sphere,
/// with the conditions that the mechanisms produce.
struct SimulatedImpact {
  PointConditions asked;             ///< dataset, diameter [m], incident velocity [m/s]
  double restitution_squared = 0.0;  ///< as measured; below zero for a capture, see ImpactResult
  bool extended = false;             ///< true: mechanisms act, or e averages over sizes
  ImpactConditions conditions;       ///< at the contact
  double diameter = 0.0;             ///< diameter of the sphere at the contact [m]
  double density = 0.0;              ///< density of the sphere [kg/m3]
  ImpactGroups groups;
  ImpactScales scales;
  ImpactResult impact;  ///< impact of the base model, with budget and gradient
  /// Energy that the jumps into and out of contact lose without damping [m V^2].
  double jumps = 0.0;
  WholeImpactEnergy whole;  ///< energy budget with mechanisms
  std::vector<ImpactMoment> history;
  std::vector<Validity> validity;

  /// True if the contact yields. Only its elastic rebound is simulated: `impact` lacks the largest
  /// penetration and force and the contact time of the whole impact, and `history` is empty.
  bool yields = false;

  bool captured() const { return !(restitution_squared > 0.0); }
};

/// Simulates one impact with the model's initial values.
/// @throws ComputationError if it cannot be solved
SimulatedImpact simulate_at(const ImpactModel& model, const std::vector<Dataset>& datasets,
                            const PointConditions& at);

/// A column of the history of an impact, with the unit in its name: times [ns], lengths [nm],
/// velocities [m/s], forces [uN]. Positive forces push the sphere away from the surface.
struct HistoryColumn {
  std::string name;
  std::vector<double> values;
};
std::vector<HistoryColumn> history_columns(const SimulatedImpact& simulated);

}  // namespace recoil
