#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/names.hpp"
#include "data/condition.hpp"
#include "diagnosis/candidate_result.hpp"

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
  /// Of the two predictions of e there; for a condition, what changing it does to e if the cause
  /// that it takes away acts, and does not if another one does [1].
  double difference = 0.0;
  int events = 0;         ///< impacts for expected odds of 99 to 1
  double log_odds = 0.0;  ///< expected with so many: events difference^2 / (2 sd^2), at least ln 99
  Condition condition = Condition::ambient_pressure;  ///< of kind `condition`
  double value = 0.0;                                 ///< what it is set to, in its unit
  std::string_view doing;                             ///< in a laboratory: "pump the chamber"
};

/// For every two of `rivals` (the best four): the impacts at which their predictions differ most
/// per standard deviation of one event (over the grid of `next_measurements`), and, where the
/// catalogue knows a condition that takes a mechanism away which only one of them has, the change
/// of that condition, watched where the mechanism does most. The least effort first, an effort
/// being the number of impacts, and of a changed condition `effort_of_a_change` more.
///
/// The expected log odds of the right one of two after n impacts, whose e scatters by sd, is
/// n difference^2 / (2 sd^2), the Kullback-Leibler divergence (Box & Hill 1967, Technometrics 9,
/// 57-71). What takes more than a million impacts is left out.
std::vector<NextExperiment> next_experiments(const FitResult& base,
                                             const std::vector<const CandidateResult*>& rivals);

inline constexpr int effort_of_a_change = 100;  ///< impacts

}  // namespace recoil
