#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/names.hpp"
#include "diagnosis/candidate.hpp"
#include "diagnosis/held_out.hpp"

namespace recoil {

/// Why a parameter cannot have its value.
enum class Implausible {
  outside_range,  ///< of what the catalogue gives for it
  beyond_limit    ///< of a dimensionless quantity that it stands for
};
template <>
struct NamesOf<Implausible> {
  static constexpr std::array<std::string_view, 2> names = {"outside_range", "beyond_limit"};
};

/// A parameter of an added mechanism as it was fitted.
struct FoundParameter {
  std::string label;
  std::string unit;
  double value = 0.0;
  /// Standard error, the errors of the laws included; 0 where it is fixed or rests on a bound.
  double sd = 0.0;
  double null_value = 0.0;
  std::optional<Condition> stated_by;      ///< a condition of the data says its value
  std::optional<Implausible> implausible;  ///< none where its value is possible
  /// Plausible, or no further outside than half the range, or a factor of two: limits of what is
  /// plausible are not sharp.
  bool near_plausible = true;
  double lower = 0.0, upper = 0.0;        ///< the range that it lies outside of
  std::string_view range_why = {};        ///< why that is the range
  const PlausibleLimit* limit = nullptr;  ///< the limit that it lies beyond
  double quantity = 0.0;                  ///< what is limited, at this value [1]

  bool plausible() const { return !implausible; }
};

inline constexpr double tolerated_level = 0.01;  ///< structure below this p-value is left behind

/// Why a candidate is not taken for a cause.
enum class SetAside {
  description,            ///< it explains nothing
  gains_too_little,       ///< less than its parameters cost
  chance,                 ///< gives the best of all candidates as much, too often
  not_possible,           ///< a parameter is implausible
  batch_is_size,          ///< every series has its own diameter, and offsets run smoothly with it
  within_a_step,          ///< an error of a height no larger than rounding may make it
  leaves_structure,       ///< behind
  predicts_no_better,     ///< sizes or targets that were held out
  one_would_do,           ///< of the two of a pair
  one_hardly_takes_part,  ///< of the two of a pair, and structure is left behind
  at_the_edge,            ///< a parameter rests on the edge of what is possible
  far_behind              ///< the best at a first look: a pair that was not followed any further
};
template <>
struct NamesOf<SetAside> {
  static constexpr std::array<std::string_view, 12> names = {
      "description",   "gains_too_little",      "chance",           "not_possible",
      "batch_is_size", "within_a_step",         "leaves_structure", "predicts_no_better",
      "one_would_do",  "one_hardly_takes_part", "at_the_edge",      "far_behind"};
};

/// One mechanism, or several at once, tried as an explanation.
struct CandidateResult {
  Candidate candidate;
  Refit refit;
  MechanismKind kind = MechanismKind::physics;
  std::vector<FoundParameter> parameters;
  double delta_aicc = 0.0;        ///< criterion less that of the base model: negative is better
  std::optional<double> p_value;  ///< see `diagnose`; none for several at once
  double remaining_p = 0.0;       ///< of the structure that it leaves, `quick_structure`
  /// Of the base model's misfit beyond the noise, what is left [1]; 1 where no errors are stated.
  double remaining_part = 1.0;
  std::optional<HeldOutGain> gain;  ///< where worth computing
  /// By how much the criterion rises where the parameters are kept within what is possible; asked
  /// where the best value lies outside by less than its error, and else 0. A standard error says
  /// little of a limit where two parameters trade for each other.
  double cost_of_possible = 0.0;
  bool plausible = true;       ///< all of its parameters are
  bool only_by_error = false;  ///< one lies outside of what is possible, by less than its error
  bool near_plausible = true;  ///< see `FoundParameter`
  std::optional<SetAside> set_aside;

  bool explains() const { return !set_aside; }
};

}  // namespace recoil
