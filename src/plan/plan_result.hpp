#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/names.hpp"
#include "data/dataset.hpp"
#include "data/system.hpp"
#include "diagnosis/next_experiment.hpp"
#include "diagnosis/odds.hpp"
#include "estimate/model.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {

/// What is planned with. The defaults are assumptions, to be replaced by what one knows.
struct PlanOptions {
  /// Incident velocities within reach [m/s]; 0: from 0.8 times the smallest to 30 times the largest
  /// capture velocity, or those of the points that there are.
  double slowest = 0.0, fastest = 0.0;
  std::vector<double> diameters;  ///< [m]; empty: those of the points that there are
  double scatter = 0.05;          ///< sd of the e of one impact, over e: 0.05 to 0.1 is usual [1]
  double floor = 0.01;            ///< and the part of it that does not depend on e [1]
  double spread = 0.05;           ///< relative sd of the capture velocity from impact to impact [1]
  int events = 20;                ///< impacts of one point
  int impacts = 0;                ///< of the plan; 0: as many as the wanted error takes
  double error = 0.1;             ///< wanted relative standard error of everything [1]
  double checks = 0.25;  ///< share of the points that are spread evenly, to see a wrong model [1]
};

inline constexpr int most_planned_impacts = 10000;  ///< where the wanted error decides

/// Points to be made at one velocity and size.
struct PlannedSetting {
  std::size_t dataset = 0;
  double diameter = 0.0;     ///< [m]
  double velocity = 0.0;     ///< [m/s]
  int points = 0;            ///< of PlanOptions::events impacts each
  double restitution = 0.0;  ///< expected mean e of the rebounds [1]
  double sd = 0.0;           ///< of the mean of all of them; 0 where hardly one comes back [1]
  double captured = 0.0;     ///< expected share [1]
};

/// What an experiment is to determine.
enum class PlannedKind { parameter, capture_velocity };
template <>
struct NamesOf<PlannedKind> {
  static constexpr std::array<std::string_view, 2> names = {"parameter", "capture_velocity"};
};

/// Where the best experiment for one quantity alone would go.
struct LearntAt {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
  double share = 0.0;     ///< of its impacts [1]
};

struct PlannedQuantity {
  PlannedKind kind = PlannedKind::parameter;
  std::string label;  ///< of a parameter
  std::string unit;
  std::size_t dataset = 0;
  double diameter = 0.0;     ///< of a capture velocity [m]
  double value = 0.0;        ///< assumed, or what follows [unit]
  double error = 0.0;        ///< relative standard error under the plan [1]
  double plain_error = 0.0;  ///< under as many points, evenly spaced in ln V [1]
  /// Impacts for the wanted error: in the proportions of the plan, in those of the plain one, and
  /// if nothing else were asked. None where no number of them would do.
  std::optional<double> impacts, plain_impacts, alone_impacts;
  std::vector<LearntAt> learnt_at;  ///< the largest share first
};

/// What would tell a cause from what is said beside it.
struct PlanRemedy {
  ExperimentKind kind = ExperimentKind::points;
  std::size_t dataset = 0;
  double diameter = 0.0;                              ///< [m]
  double velocity = 0.0;                              ///< [m/s]
  int impacts = 0;                                    ///< for expected odds of 99 to 1
  Condition condition = Condition::ambient_pressure;  ///< of kind `condition`
  double value = 0.0;                                 ///< what it is set to, in its unit
  std::string_view doing;                             ///< in a laboratory: "pump the chamber"
  /// Of kind `target`: on what, and where; `impacts` are all of them, `diameter` and `velocity`
  /// those of the first place.
  TargetMaterial material;
  std::vector<ExperimentPlace> places;
};

/// A rival that the plan does not tell from a cause.
struct Confusion {
  std::string id;
  double log_odds = 0.0;             ///< that are to be expected against it
  std::optional<PlanRemedy> remedy;  ///< none: nothing within reach tells them apart
};

/// A mechanism that may act, and whether the plan would find it out.
struct PlannedCause {
  std::string id;
  MechanismKind kind = MechanismKind::physics;
  std::string parameter;  ///< its strength
  std::string unit;
  double strength = 0.0;             ///< assumed
  double lower = 0.0, upper = 0.0;   ///< what it can be
  bool stated = false;               ///< a condition of the dataset says what it is
  double change = 0.0;               ///< largest change of e in the plan [1]
  double log_odds = 0.0;             ///< to be expected against the base model, refitted
  std::optional<double> seen_from;   ///< the strength from which on it is seen
  std::optional<PlanRemedy> remedy;  ///< where it is not seen
  int rivals = 0;                    ///< other causes with which it was compared
  std::vector<Confusion> confused;   ///< those of them from which it is not told

  bool seen() const { return log_odds >= wanted_log_odds; }
};

/// Two causes to be told apart, by their ids; the second is empty where the first is to be seen.
using CausePair = std::pair<std::string, std::string>;

/// Something to do on top of the plan, and all that it would show or tell apart.
struct PlanStep {
  PlanRemedy remedy;
  std::vector<CausePair> tells;
};

/// What is expected of the causes under a plan.
struct PlannedCauses {
  std::vector<PlannedCause> causes;  ///< the most visible first
  std::vector<PlanStep> steps;       ///< few that together do what can be done
  std::vector<CausePair> beyond;     ///< what nothing within reach would show or tell apart
};

/// A plan and what it is expected to bring.
struct ExperimentPlan {
  PlanOptions options;            ///< with the velocities and diameters that were used
  std::string fit;                ///< id of the fit file
  std::vector<Dataset> datasets;  ///< with one point for each setting
  ImpactModel model;
  std::vector<double> theta;  ///< as assumed [slots]
  std::vector<PlannedSetting> settings;
  std::vector<PlannedQuantity> quantities;
  int points = 0;
  int impacts = 0;
  bool reached = false;     ///< all quantities have the wanted error
  double efficiency = 0.0;  ///< at least: the sum of the variances that no plan undercuts, over
                            ///< that of this one [1]
  double law_error = 0.0;   ///< of a mechanism, as allowed for among the causes [1]
  PlannedCauses expected;
};

}  // namespace recoil
