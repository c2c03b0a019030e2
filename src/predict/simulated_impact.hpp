#pragma once

#include <string>
#include <vector>

#include "estimate/model.hpp"
#include "impact/groups.hpp"
#include "impact/impact.hpp"
#include "predict/validity.hpp"

namespace recoil {

/// What a velocity [m/s] and a diameter [um] of one impact may be, on the command line and in
/// Python.
inline constexpr std::pair<double, double> velocity_limits = {1e-7, 1e4};
inline constexpr std::pair<double, double> diameter_limits_um = {1e-3, 1e6};

/// One impact of a model: e as measured, mechanisms included, and the impact of the base model at
/// the contact, where the mechanisms leave the sphere.
struct SimulatedImpact {
  PointConditions asked;             ///< dataset, diameter [m], incident velocity [m/s]
  double restitution_squared = 0.0;  ///< as measured; below zero for a capture, see ImpactResult
  bool extended = false;             ///< mechanisms act
  ImpactConditions conditions;       ///< at the contact
  double diameter = 0.0;             ///< of the sphere, at the contact [m]
  double density = 0.0;              ///< of the sphere [kg/m3]
  ImpactGroups groups;
  ImpactScales scales;
  ImpactResult impact;  ///< of the base model, with budget and gradient
  double jumps = 0.0;   ///< what the contact loses in jumping in and out, without damping [m V^2]
  WholeImpactEnergy whole;  ///< with mechanisms
  std::vector<ImpactMoment> history;
  std::vector<Validity> validity;

  /// The contact yields. Only its elastic rebound is simulated: `impact` has neither the largest
  /// penetration and push nor the contact time of the whole impact, and `history` is empty.
  bool yields = false;

  bool captured() const { return !(restitution_squared > 0.0); }
};

/// Simulates one impact with the model's initial values.
/// @throws ComputationError when it has no answer
SimulatedImpact simulate_at(const ImpactModel& model, const std::vector<Dataset>& datasets,
                            const PointConditions& at);

/// The forces against time: columns with units in their names, times [ns], lengths [nm], velocities
/// [m/s], forces [uN], positive ones push the sphere away from the surface.
struct HistoryColumn {
  std::string name;
  std::vector<double> values;
};
std::vector<HistoryColumn> history_columns(const SimulatedImpact& simulated);

}  // namespace recoil
