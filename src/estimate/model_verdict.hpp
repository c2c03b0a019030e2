#pragma once

#include <cstddef>
#include <optional>

#include "core/names.hpp"
#include "estimate/law_average.hpp"

namespace recoil {

/// Whether the model describes the points.
enum class ModelVerdict {
  fits,                       ///< with exact laws and the constants within their stated errors
  fits_with_moved_constants,  ///< the same, if a constant is more than one standard deviation away
  fits_within_law_error,      ///< only if the laws may be wrong
  does_not_fit,
  untested,  ///< the points cannot test it
};
constexpr auto names_of_values(ModelVerdict) {
  return name_list("fits", "fits_with_moved_constants", "fits_within_law_error", "does_not_fit",
                   "untested");
}

/// The verdict on the model with its evidence. Every text about whether a model fits follows from
/// it.
struct ModelJudgement {
  ModelVerdict verdict = ModelVerdict::untested;
  /// Of chi2 with exact laws and the constants where they fit best, their deviations included [1];
  /// empty if no standard deviations are stated, or without degrees of freedom.
  std::optional<double> p_value;
  std::optional<LawErrorEstimate> laws;  ///< if the fit was averaged over their error
  std::optional<std::size_t> moved;      ///< the constant farthest from its stated value
};

/// Do the points test how e depends on V and d: are there more pairs of velocity and size than free
/// parameters? If not, they only test their own scatter.
bool tests_the_curve(const FitResult& fitted);

/// The verdict on a fit.
///
/// If an error of the laws is seen (`LawErrorEstimate::seen`), the model fits within it unless the
/// points contradict even the fit with this error (p < 0.01). Otherwise the p-value decides, with
/// the same limit. Without stated standard deviations the noise takes what the laws do not explain
/// unless it is smooth, so that only an error of the laws can be seen.
/// @param level of the interval of the error of the laws
ModelJudgement judge_model(const FitResult& fitted, double level = 0.95);

}  // namespace recoil
