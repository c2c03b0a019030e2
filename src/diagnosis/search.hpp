#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "diagnosis/candidate_result.hpp"
#include "diagnosis/diagnosis_options.hpp"
#include "diagnosis/exact_fits.hpp"
#include "diagnosis/law_errors.hpp"
#include "diagnosis/structure.hpp"

namespace recoil {

/// The base model and the sample with its weights, with which every candidate is compared.
struct SearchBase {
  const FitSpec& spec;
  const std::vector<Dataset>& datasets;
  FitResult fitted;          ///< every candidate is fitted to its `data`
  LawErrors laws{};          ///< the allowed errors of every model
  Candidate candidate;       ///< the base model, without added mechanisms
  Refit exact{};             ///< the refit with exact laws
  Refit first{};             ///< under the smallest error of the laws
  Refit refit{};             ///< under the likeliest
  double criterion = 0.0;    ///< averaged over the errors of the laws
  double noise_scale = 1.0;  ///< noise scale of the base; 1 if standard deviations are stated
  Samples noise;             ///< white noise, for `quick_structure`
  const DiagnosisOptions& options;
  std::shared_ptr<ExactFits> exact_fits = std::make_shared<ExactFits>();
};

/// `spec` with material constants that the points move, even if the fit holds them, so that no
/// cause is named for the errors of the constants.
FitSpec with_constants_adjusted(FitSpec spec);

SearchBase search_base(const FitSpec& spec, const std::vector<Dataset>& datasets,
                       const FitResult& fitted, const DiagnosisOptions& options);

/// The search of `allowed` with exact laws: the same points, weights and fits of candidates.
/// @param spec that of `allowed` with a law_error of 0
SearchBase with_exact_laws(const SearchBase& allowed, const FitSpec& spec,
                           const DiagnosisOptions& options);

/// The Jacobian of the residuals at `theta`, whitened by the covariance of `base.refit` [at least
/// points x slots]; zero if the residuals cannot be computed.
std::vector<double> jacobian_at(const SearchBase& base, const Candidate& candidate,
                                const std::vector<double>& theta);

/// Simulates new readings of the sample if the true e^2 is `squares`, with the loss 1 - e^2
/// multiplied by a smooth random factor 1 + g with sd `bend` of g [1]. `index` numbers the draws.
WeightedData simulate_points(const SearchBase& base, std::span<const double> squares, double bend,
                             std::uint64_t index);

/// Replicate `index` of the sample under the base model, whose losses have a smooth error of the
/// smallest size that `laws` allows.
WeightedData simulate_base(const SearchBase& base, std::uint64_t index);

/// The residuals of the refit of replicate `index`, whitened like those of `base.first` [points];
/// nullopt if the refit fails. Uses the kept result if there is one.
std::optional<std::vector<double>> residuals_of_sample(const SearchBase& base, std::uint64_t index);

/// The row of a piece of the calibration: 1 and the residuals, or 0 if the refit failed.
std::vector<double> calibration_row(const std::optional<std::vector<double>>& residuals);

/// The gain of each candidate over the base in the criterion, on every replicate [replicates x
/// candidates], to first order. With Q an orthonormal basis of the Jacobian columns of its own free
/// parameters, orthogonal to those of the base, the sum of squares of the residuals r decreases by
/// |Q' r|^2 (the score test of Rao 1948, Proc. Camb. Phil. Soc. 44, 50-57).
/// @param residuals residuals of the replicates [points x replicates]
Eigen::MatrixXd gains_by_chance(const SearchBase& base,
                                const std::vector<CandidateResult>& candidates,
                                const Eigen::MatrixXd& residuals);

/// Sets the p-values of `candidates`: (1 + number of replicates in which the best of all candidates
/// gains as much) / (1 + number of replicates).
void calibrate(const SearchBase& base, std::vector<CandidateResult>& candidates,
               const Eigen::MatrixXd& residuals);

}  // namespace recoil
