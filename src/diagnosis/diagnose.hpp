#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "diagnosis/diagnosis_result.hpp"

namespace recoil {

struct DiagnosedData;

/// What the fitted model of `spec` gets wrong, and why.
///
/// 1. The residuals are tested for structure (`StructureStatistics`); the p-value comes from data
///    sets simulated by the fitted model and refitted.
/// 2. Unless the model is adequate, every mechanism of the catalogue is added and the whole model
///    refitted, with the weights of the base fit. The p-value of a candidate is the part of data
///    sets simulated by the base model in which the best of all candidates gains as much, to first
///    order.
/// 3. A candidate explains the data when that p-value is no more than `chance`, it leaves no
///    structure (or none to speak of beside what it took), its parameters are possible, and it
///    predicts blocks that were held out better than the base does. A description never explains.
/// 4. What is possible and fits no worse than the best explanation, but for `margin`, is its rival,
///    also where its parameters lie somewhat beyond the range of what is plausible, as such limits
///    are not sharp. One explanation alone is named; several are not
///    separable; none sends the search to pairs, unless even the best single one gains no more than
///    chance gives, as chance gives more to the best of so many pairs; if they fail too the
///    structure is unexplained. One diameter names nothing: the size dependence, which tells one
///    cause from another, was not seen.
/// 5. Where errors that were not stated (`unstated_errors`) leave nothing and fit better than the
///    best single explanation by more than `margin`, or about as well as the best of the pairs, no
///    cause is told; where they would do as well, they are `rival_errors`.
/// Where the fit holds uncertain constants of the materials (Materials::propagated), the base model
/// is fitted again with constants that the points move.
/// @param base the fit of `spec` to `datasets`. @pre base.usable
/// @param base_intervals its intervals [slots], where they are known already; else they are found
/// @throws ComputationError when the fit cannot be repeated from its own answer.
Diagnosis diagnose(const FitSpec& spec, const std::vector<Dataset>& datasets, const FitResult& base,
                   const DiagnosisOptions& options,
                   const std::vector<IntervalSet>& base_intervals = {});

/// The same with the fit made first.
/// @throws ComputationError when the base model has no usable fit, too.
Diagnosis diagnose(const FitSpec& spec, const std::vector<Dataset>& datasets,
                   const DiagnosisOptions& options);

/// The fit file of a diagnosis with the extended model, as a text that `parse_fit` reads: the same
/// datasets (seen from `folder`), noise and uncertainty, the mechanisms that were found, every
/// parameter starting at its estimate. Without a cause it is the fit file as it was.
std::string extended_toml(const Diagnosis& diagnosis, const std::filesystem::path& folder);

/// The simulated data sets that calibrate a diagnosis, as numbered pieces: their residuals say how
/// much structure chance leaves, and what causes gain by chance; once more for the data without
/// outlying points, where there are any. The other steps of a diagnosis (every mechanism, pairs,
/// held-out points) are no pieces: they have few and unequal ones.
class Calibration {
 public:
  /// @throws ComputationError when the base model has no usable fit
  Calibration(const FitSpec& spec, const std::vector<Dataset>& datasets,
              const DiagnosisOptions& options);
  ~Calibration();

  std::size_t pieces() const;

  /// `calibration_row` of a piece. Called from any thread.
  std::vector<double> run(std::size_t piece) const;

  /// The numbers that the pieces start from, to the last digit.
  std::string digits() const;

 private:
  std::vector<std::unique_ptr<DiagnosedData>> data_;  // all points; those that do not lie off
};

}  // namespace recoil
