#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <optional>
#include <span>
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
  Samples noise;             ///< white, for `quick_structure`
  const DiagnosisOptions& options;
};

/// No cause is named for what the errors of the material constants can do: a diagnosis lets the
/// points move the constants, also where the fit itself holds them.
FitSpec with_constants_adjusted(FitSpec spec);

SearchBase search_base(const FitSpec& spec, const std::vector<Dataset>& datasets,
                       const FitResult& fitted, const DiagnosisOptions& options);

/// The sample with readings drawn anew, where the truth is e^2 = `squares` and 1 - e^2 is wrong by
/// a smooth factor of the size `bend` [1]. The draws are numbered by `index`.
Observations simulate_points(const SearchBase& base, std::span<const double> squares, double bend,
                             std::uint64_t index);

/// Replicate `index` of the sample under the base model, its losses wrong by a smooth factor of the
/// size that `laws` allows.
Observations simulate_base(const SearchBase& base, std::uint64_t index);

/// The residuals of replicate `index`, refitted, whitened like those of `base.refit` [points]; none
/// without a fit. Taken from what is kept, where it is there.
std::optional<std::vector<double>> residuals_of_sample(const SearchBase& base, std::uint64_t index);

/// The row of that piece of the calibration: 1 and the residuals, or 0 where there was no fit.
std::vector<double> calibration_row(const std::optional<std::vector<double>>& residuals);

/// Is a single candidate one under which the spheres of a point differ?
bool spreads(const CandidateResult& single);

/// What each of `candidates` gains over the base, in its criterion, on every replicate
/// [replicates x candidates], to first order: with Q an orthonormal basis of the columns that its
/// own free parameters have in the Jacobian of its fit, freed of those of the base, the sum of the
/// squares of the residuals r falls by |Q' r|^2 (the score test of Rao 1948, Proc. Camb. Phil. Soc.
/// 44, 50-57).
/// @param residuals of the replicates [points x replicates]
Eigen::MatrixXd gains_by_chance(const SearchBase& base,
                                const std::vector<CandidateResult>& candidates,
                                const Eigen::MatrixXd& residuals);

/// Fills the p-values of `candidates`: (1 + number of replicates in which the best of all
/// candidates gains as much) / (1 + number of replicates).
void calibrate(const SearchBase& base, std::vector<CandidateResult>& candidates,
               const Eigen::MatrixXd& residuals);

}  // namespace recoil
