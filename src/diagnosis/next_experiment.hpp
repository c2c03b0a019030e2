#pragma once

#include <string>

#include "core/names.hpp"
#include "data/condition.hpp"

namespace recoil {

enum class ExperimentKind {
  points,    ///< more impacts, at another velocity and size
  condition  ///< the same impacts under a changed condition, which takes a cause away
};
template <>
struct NamesOf<ExperimentKind> {
  static constexpr std::array<std::string_view, 2> names = {"points", "condition"};
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
};

}  // namespace recoil
