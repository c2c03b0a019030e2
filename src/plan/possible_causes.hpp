#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "estimate/fit_spec.hpp"
#include "estimate/observation.hpp"
#include "mechanism/mechanism.hpp"
#include "plan/plan_result.hpp"
#include "plan/possible_points.hpp"

namespace recoil {

/// The settings and what could be added to them, under the base model.
struct PlanGround {
  std::vector<PointConditions> at;  ///< the settings first
  Eigen::Index settings = 0;
  Eigen::VectorXd weight;     ///< root of the information about e^2: of a setting as it is planned,
                              ///< of one impact elsewhere
  Eigen::VectorXd once;       ///< of one impact everywhere, over `weight`
  Eigen::VectorXd square;     ///< e^2
  Eigen::MatrixXd slopes;     ///< X, weighted
  Eigen::VectorXd known;      ///< prior precision of its columns
  Eigen::MatrixXd functions;  ///< `smooth_functions`
  Eigen::MatrixXd errors;     ///< of the base model, weighted
};

/// The settings of `plan`, then 24 velocities (0.7 times the slowest to 1.5 times the fastest) of
/// its sizes, of 0.6 times the smallest and of 1.6 times the largest one, in every dataset.
PlanGround ground_of(const FitSpec& spec, const ExperimentPlan& plan);

/// Where the settings of `plan` are.
std::vector<PointConditions> settings_of(const ExperimentPlan& plan);

/// @param at the settings of `plan` first
PlanGround ground_at(const FitSpec& spec, const ExperimentPlan& plan,
                     const PlannedParameters& parameters, std::vector<PointConditions> at);

/// What one mechanism does at one strength to all places of a PlanGround.
struct Effect {
  double strength = 0.0;
  Eigen::VectorXd change;    ///< of e^2, weighted as PlanGround::weight
  Eigen::MatrixXd released;  ///< slopes in its fixed parameters, over half of what they can be
  double largest = 0.0;      ///< change of e at a setting [1]
};

/// How often `of` goes into `effect` at the settings.
double amplitude(const PlanGround& ground, const Effect& effect, const Effect& of);

/// A mechanism and what it may do.
struct PossibleCause {
  const Mechanism* mechanism = nullptr;
  const Parameter* parameter = nullptr;
  double lower = 0.0, upper = 0.0;
  bool stated = false;
  Effect typical;
  std::vector<Effect> others;      ///< at further strengths
  double least = 0.0, most = 0.0;  ///< what the amplitude of `typical` can be, over itself
};

/// None where the conditions take it away, or it cannot be of any size.
std::optional<PossibleCause> possible_cause(const FitSpec& spec, const ExperimentPlan& plan,
                                            const PlanGround& ground, const Mechanism& mechanism);

/// `cause` at the same strengths on another ground. A strength that is the last dataset's own is
/// not known there.
PossibleCause carried_to(const PossibleCause& cause, const FitSpec& spec,
                         const ExperimentPlan& plan, const PlanGround& ground);

}  // namespace recoil
