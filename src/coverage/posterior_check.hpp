#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "core/names.hpp"
#include "data/dataset.hpp"
#include "estimate/fit.hpp"
#include "uncertainty/fit_alternatives.hpp"
#include "uncertainty/posterior.hpp"
#include "uncertainty/uncertainty_options.hpp"

namespace recoil {

/// Posterior simulation-based calibration: can the posterior of a fit be believed at its own points
/// (Saeilynoja, Schmitt, Buerkner & Vehtari 2025, arXiv 2502.03279)? Every data set repeats the
/// measurement at parameters drawn from the posterior. They are then one draw of the posterior
/// given both, the measured points and the repeated ones, and their rank among its draws is
/// uniform.
struct PosteriorStudy {
  std::shared_ptr<const FitResult> fitted;
  std::vector<FitAlternative> alternatives;  ///< of `noise_alternatives`
  std::vector<Dataset> datasets;
  PosteriorResult posterior;
  std::uint64_t seed = 0;
  int steps = 2000;  ///< of the path through the truth
  /// The repeated measurement number `index` at the parameters and with the noise of `truth`;
  /// `simulate_at` of coverage_truth.hpp. Thread-safe.
  std::function<std::vector<Dataset>(const FitResult& truth, std::uint64_t index)> simulate;
};

/// Fits, and samples the posterior.
/// @throws ComputationError if the fit is not usable
PosteriorStudy posterior_study(const FitSpec& spec, const std::vector<Dataset>& datasets,
                               const UncertaintyOptions& options);

/// Ranks are from 0 to this number: the share of the second posterior below the truth, in steps of
/// 1 %.
inline constexpr int most_rank = 99;

/// One repeated measurement.
struct PosteriorTrial {
  std::vector<int> ranks;  ///< of the free parameters; empty: no posterior of both was found
  RECOIL_FIELDS(ranks)
};

/// Repetition number `index`; a pure function of it. The fit to both starts at the estimate and
/// estimates the noise anew; the error of the laws keeps its size, and the variance function is the
/// one that fits both best. The ranks are the `shares_below` of `steps`: uniform also where the
/// chain moves slowly, but slow chains see less.
PosteriorTrial repeat_measurement(const PosteriorStudy& study, std::uint64_t index);

enum class PosteriorVerdict { believed, not_believed, unknown };
constexpr auto names_of_values(PosteriorVerdict) {
  return name_list("believed", "not_believed", "unknown");
}

/// The ranks of one parameter.
struct RankedParameter {
  std::string parameter;  ///< slot label
  double p_value = 1.0;   ///< probability that uniform ranks are as uneven anywhere [1]
  /// Standard deviation of the truth about the posterior, over that of the posterior, with its 95 %
  /// limits: above 1 the intervals are too narrow [1]. From normal scores of the ranks.
  double error_ratio = 1.0, ratio_lower = 0.0, ratio_upper = 0.0;
  double shift = 0.0;     ///< mean of truth minus posterior [standard deviations]
  double shift_sd = 0.0;  ///< its standard error
  int held = 0;           ///< number of central 90 % intervals that contain the truth
};

/// Why there is no verdict.
enum class NoVerdict { none, no_posterior, few_sets, noise_in_doubt, model_rejected, open_ranks };
constexpr auto names_of_values(NoVerdict) {
  return name_list("none", "no_posterior", "few_sets", "noise_in_doubt", "model_rejected",
                   "open_ranks");
}

struct PosteriorCheck {
  int sets = 0;    ///< with ranks
  int failed = 0;  ///< without
  PosteriorVerdict verdict = PosteriorVerdict::unknown;
  NoVerdict because = NoVerdict::none;
  double p_value = 1.0;  ///< smallest of the parameters times their number, at most 1 [1]
  std::vector<RankedParameter> parameters;
};

/// The posterior is not believed below this p-value [1].
inline constexpr double rejected_posterior = 0.01;

/// The posterior is not believed if `p_value` is below `rejected_posterior`, and the verdict is
/// open below 0.05. It is also open if the simulation cannot tell: without a posterior, with ranks
/// in fewer than 50 or nine of ten sets, if the stated noise is in doubt, and if the points reject
/// the model, because the repeated measurement obeys both.
PosteriorCheck judge_posterior(const PosteriorStudy& study,
                               const std::vector<PosteriorTrial>& trials);

/// The probability, for each list of ranks 0 to `most_rank`, that as many uniform ranks leave
/// their expectation as far anywhere: simultaneous bands (Saeilynoja, Buerkner & Vehtari 2022,
/// Stat. Comput. 32, 32) by simulation. All lists are equally long.
std::vector<double> rank_p_values(const std::vector<std::vector<int>>& ranks);

/// All repetitions, and their verdict. Deterministic in (seed, number of data sets).
PosteriorCheck check_posterior(const PosteriorStudy& study, int datasets, int threads);

}  // namespace recoil
