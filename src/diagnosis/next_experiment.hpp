#pragma once

#include <string>
#include <vector>

#include "core/names.hpp"
#include "data/system.hpp"
#include "diagnosis/other_target.hpp"

namespace recoil {

enum class ExperimentKind {
  points,     ///< more impacts, at another velocity and size
  condition,  ///< the same impacts under a changed condition, which takes a cause away
  target      ///< impacts of the same spheres on a block of another material
};
template <>
struct NamesOf<ExperimentKind> {
  static constexpr std::array<std::string_view, 3> names = {"points", "condition", "target"};
};

/// A place in an experiment of several.
struct ExperimentPlace {
  double diameter = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
  int events = 0;
};

/// Something to do that would tell one rival from another.
struct NextExperiment {
  ExperimentKind kind = ExperimentKind::points;
  std::string one, other;  ///< what it separates: names of candidates
  std::size_t dataset = 0;
  std::size_t series = 0;  ///< of that dataset: the one whose impacts are most like these
  double diameter = 0.0;   ///< [m]
  double velocity = 0.0;   ///< [m/s]
  /// Of the two predictions of e there; for a condition, under the change, which takes away what
  /// `one` says and leaves what `other` says [1].
  double difference = 0.0;
  int events = 0;                                     ///< impacts for expected odds of 99 to 1
  double log_odds = 0.0;                              ///< expected with so many, at least ln 99
  Condition condition = Condition::ambient_pressure;  ///< of kind `condition`
  double value = 0.0;                                 ///< what it is set to, in its unit
  std::string_view doing;                             ///< in a laboratory: "pump the chamber"
  /// Of kind `target`: on what, and where. `events` are all of them, `diameter`, `velocity` and
  /// `difference` belong to the place at which the two differ most.
  TargetMaterial material;
  std::vector<ExperimentPlace> places;
};

}  // namespace recoil
