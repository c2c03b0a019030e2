#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "diagnosis/candidate_result.hpp"
#include "diagnosis/diagnosis_options.hpp"
#include "diagnosis/law_errors.hpp"
#include "diagnosis/structure.hpp"

namespace recoil {

/// What every candidate is compared with: the base model and the sample with its weights.
struct SearchBase {
  const FitSpec& spec;
  const std::vector<Dataset>& datasets;
  FitResult fitted;     ///< its `data` are what every candidate is fitted to
  LawErrors laws;       ///< what every model is allowed to be wrong by
  Candidate candidate;  ///< the base itself: nothing added
  Refit refit;
  double criterion = 0.0;
  double noise_scale = 1.0;  ///< of the base: 1 where standard deviations are stated
  const DiagnosisOptions& options;
};

/// No cause is named for what the errors of the material constants can do: a diagnosis lets the
/// points move the constants, also where the fit itself holds them.
FitSpec with_constants_adjusted(FitSpec spec);

SearchBase search_base(const FitSpec& spec, const std::vector<Dataset>& datasets,
                       const FitResult& fitted, const DiagnosisOptions& options);

/// Replicate `index` of the sample under the base model, its losses wrong by a smooth factor of the
/// size that `laws` allows.
Observations simulate_base(const SearchBase& base, std::uint64_t index);

/// The structure in replicate `index`, refitted; none without a fit. Taken from what is kept,
/// where it is there.
std::optional<PerValue<StructureQuestion, double>> structure_of_sample(
    const SearchBase& base, const StructureStatistics& statistics, std::uint64_t index);

/// The row of that piece of the calibration: 1 and the statistics, or 0 where there was no fit.
std::vector<double> calibration_row(
    const std::optional<PerValue<StructureQuestion, double>>& answer);

/// Is a single candidate one under which the spheres of a point differ?
bool spreads(const CandidateResult& single);

/// What the best of `candidates` gains over the base, in its criterion, on replicate `index`;
/// -infinity where nothing can be fitted.
double largest_gain(const SearchBase& base, const std::vector<CandidateResult>& candidates,
                    std::uint64_t index);

/// Fills the p-values of `candidates`: (1 + number of simulated data sets in which the best of all
/// candidates gains as much) / (1 + number of data sets). The data sets end early once chance has
/// given the best candidate as much five times (Besag & Clifford 1991, Biometrika 78, 301-304).
/// @param tick called once per data set
void calibrate(const SearchBase& base, std::vector<CandidateResult>& candidates,
               const std::function<void()>& tick);

}  // namespace recoil
