#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "estimate/fit_spec.hpp"
#include "estimate/model.hpp"

namespace recoil {

/// The assumptions of a plan. The defaults are guesses; replace them by known values.
struct PlanOptions {
  /// Range of possible incident velocities [m/s]; 0: that of the existing points, or from 0.8 times
  /// the smallest to 30 times the largest capture velocity.
  double slowest = 0.0, fastest = 0.0;
  std::vector<double> diameters;  ///< [m]; empty: those of the existing points
  double scatter = 0.05;          ///< sd of e of one impact, over e: 0.05 to 0.1 is usual [1]
  double floor = 0.01;            ///< the part of that sd that does not depend on e [1]
  double spread = 0.05;           ///< relative sd of the capture velocity from impact to impact [1]
  int events = 20;                ///< impacts averaged in one point
  /// Total number of impacts; 0: as many as the wanted error needs for all quantities that
  /// `most_planned_impacts` determine so well.
  int impacts = 0;
  double error = 0.1;  ///< wanted relative standard error of every quantity [1]
  /// Share of the points that are evenly spaced, to reveal a wrong model [1].
  double checks = 0.25;
};

inline constexpr int most_planned_impacts = 10000;  ///< limit if the wanted error decides

/// Points to be measured at one velocity and diameter.
struct PlannedSetting {
  std::size_t dataset = 0;
  double diameter = 0.0;     ///< [m]
  double velocity = 0.0;     ///< incident velocity [m/s]
  int points = 0;            ///< number of points, each of PlanOptions::events impacts
  double restitution = 0.0;  ///< expected mean e of the rebounds [1]
  double sd = 0.0;        ///< sd of that mean over all points [1]; 0 if hardly any sphere rebounds
  double captured = 0.0;  ///< expected captured share of the impacts [1]
};

/// A part of the best experiment for a single quantity.
struct LearntAt {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
  double share = 0.0;     ///< share of the impacts of that experiment [1]
};

/// A parameter, or the capture velocity of one diameter.
struct PlannedQuantity {
  std::string label;  ///< name of a parameter; empty for a capture velocity
  std::string unit;
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< of a capture velocity [m]
  double value = 0.0;     ///< assumed value, or derived from the assumed parameters [unit]
  /// Relative standard error under the plan: the median over the draws, and the 95 % quantile [1].
  double error = 0.0, worst_error = 0.0;
  /// The median for equally many points evenly spaced in ln V [1].
  double plain_error = 0.0;
  /// Impacts for the wanted error: in the proportions of the plan, evenly spaced (both as the
  /// median over the draws), and if this were the only quantity and the assumed values were right.
  /// nullopt if no number is enough.
  std::optional<double> impacts, plain_impacts, alone_impacts;
  std::vector<LearntAt> learnt_at;  ///< the largest share first

  bool is_parameter() const { return !label.empty(); }
};

/// A plan and the errors that it is expected to give.
struct ExperimentPlan {
  PlanOptions options;            ///< with the velocities and diameters that were used
  std::string fit;                ///< id of the fit file
  std::vector<Dataset> datasets;  ///< with one point for each setting
  ImpactModel model;
  std::vector<double> theta;  ///< assumed parameters [slots]
  int draws = 0;              ///< number of draws of the parameters that it was chosen for
  std::vector<PlannedSetting> settings;
  std::vector<PlannedQuantity> quantities;
  int points = 0;
  int impacts = 0;
  bool reached = false;  ///< every quantity has the wanted error in at least half of the draws
  /// A lower bound of the efficiency: the lower bound of the mean sum of relative variances
  /// (`mean_sum_of`) for any plan, over that of this plan [1].
  double efficiency = 0.0;
};

/// The datasets of a planned experiment: materials and conditions, with one series and one point
/// for each diameter. Its velocity and restitution are not used. f0 keeps its reference diameter;
/// if none is stated, it is the median of the existing points, or else of the planned diameters.
/// @param diameters [m]; empty: those of each dataset's own points
/// @throws InputError if no diameter is known
std::vector<Dataset> datasets_to_plan(std::vector<Dataset> datasets,
                                      const std::vector<double>& diameters);

/// The points (V, d) that minimise the sum of the relative variances of all free parameters and of
/// the capture velocity of every diameter, chosen from 48 velocities of each diameter. Variances
/// are linearised at each of `draws`, and the plan minimises their geometric mean over the draws
/// (`mean_sum_of`): it also serves if the assumed values are wrong. The share `checks` of the
/// points is evenly spaced in ln V.
/// @param datasets of `datasets_to_plan`
/// @param draws values of theta [slots]: first the assumed ones, see `drawn_values`. A further draw
/// is left out if no experiment determines its parameters, or if they are many: with more than four
/// diameters, only so many are taken that draws times places are 40000, but at least 25.
/// @param options plan options; velocities are needed if `datasets` had no points of their own
/// @throws InputError if no parameter is free or no velocity is known
/// @throws ComputationError if no number of points determines a parameter
ExperimentPlan plan_experiment(const FitSpec& spec, std::vector<Dataset> datasets,
                               const std::vector<std::vector<double>>& draws, PlanOptions options);

}  // namespace recoil
