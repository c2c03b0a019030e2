#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/names.hpp"
#include "diagnosis/candidate.hpp"
#include "diagnosis/held_out.hpp"

namespace recoil {

/// The estimate of a parameter of an added mechanism.
struct FoundParameter {
  std::string label;
  std::string unit;
  double value = 0.0;
  /// Standard error, including the errors of the laws; 0 if it is fixed or at a bound.
  double sd = 0.0;
  double null_value = 0.0;
  std::optional<Condition> stated_by;  ///< a condition of the data states its value
  bool implausible = false;
  /// Plausible, or outside by at most half the range (a factor of two for `log_scale`): limits of
  /// plausibility are not sharp.
  bool near_plausible = true;
  double lower = 0.0, upper = 0.0;        ///< the range outside of which it lies
  std::string_view range_why = {};        ///< the reason for that range
  const PlausibleLimit* limit = nullptr;  ///< the limit that it exceeds; null: only the range
  double quantity = 0.0;                  ///< the limited quantity at this value [1]

  bool plausible() const { return !implausible; }
};

inline constexpr double tolerated_level = 0.01;  ///< a smaller p-value means that structure is left

/// The reason why a candidate is not accepted as a cause.
enum class SetAside {
  description,       ///< a description explains nothing
  gains_too_little,  ///< the criterion does not decrease: the gain is less than the cost of the
                     ///< parameters
  chance,            ///< chance gives the best of all candidates as much too often
  not_possible,      ///< a parameter is implausible
  batch_is_size,  ///< every series has its own diameter, and the offsets are a smooth function of
                  ///< it
  within_a_step,  ///< the error of a height may be due to rounding
  leaves_structure,    ///< the residuals still show structure
  predicts_no_better,  ///< it does not predict held-out sizes or targets better than the base
  one_suffices,        ///< one mechanism of a pair would suffice
  second_adds_little,  ///< one mechanism of a pair contributes little, and structure is left
  at_limit,            ///< a parameter rests on a bound of its allowed range
  far_behind           ///< a pair that was behind others at the screening and was not followed
};
constexpr auto names_of_values(SetAside) {
  return name_list("description", "gains_too_little", "chance", "not_possible", "batch_is_size",
                   "within_a_step", "leaves_structure", "predicts_no_better", "one_suffices",
                   "second_adds_little", "at_limit", "far_behind");
}

/// How well points like these distinguish a cause from the rival that is hardest to tell from it
/// (`separate`).
struct Separation {
  std::string rival;         ///< name of that rival
  double lambda = 0.0;       ///< least chi2 of the rival on points of the cause without noise [1]
  double probability = 0.0;  ///< that the criterion of the rival is worse by the margin [1]
};

/// One mechanism, or two at once, tested as an explanation.
struct CandidateResult {
  Candidate candidate;
  Refit refit;
  std::vector<double> exact_theta;  ///< theta of its refit with exact laws; empty: not computed
  MechanismKind kind = MechanismKind::physics;
  std::vector<FoundParameter> parameters;
  double delta_aicc = 0.0;        ///< criterion minus that of the base model: negative is better
  std::optional<double> p_value;  ///< see `diagnose`; nullopt for a pair
  double remaining_p = 0.0;       ///< p-value of the structure that it leaves, `quick_structure`
  /// The remaining part of the base model's misfit beyond the noise [1]; 1 if no errors are stated.
  double remaining_part = 1.0;
  std::optional<HeldOutGain> gain;  ///< if it was computed
  /// The increase of the criterion if the parameters are kept within their allowed ranges; computed
  /// if a best value lies outside by less than its error, else 0. (If two parameters are strongly
  /// correlated, a standard error alone does not show whether the limit matters.)
  double cost_of_possible = 0.0;
  bool plausible = true;  ///< all of its parameters are plausible
  /// A parameter lies outside of its allowed range by less than its error.
  bool only_by_error = false;
  bool near_plausible = true;  ///< see `FoundParameter`
  std::optional<SetAside> set_aside;
  /// With exact laws, and with laws that err as is usual. Only for the first possible causes, and
  /// if there is a rival.
  std::optional<Separation> separation, separation_allowed;

  bool explains() const { return !set_aside; }
};

/// Is it neither a description nor a batch effect that is equivalent to a law of size?
inline bool may_be_a_cause(const CandidateResult& c) {
  return c.kind != MechanismKind::description && c.set_aside != SetAside::batch_is_size;
}

}  // namespace recoil
