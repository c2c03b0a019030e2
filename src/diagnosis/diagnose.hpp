#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "diagnosis/diagnosis_result.hpp"

namespace recoil {

struct DiagnosedData;

/// Finds systematic errors of the fitted model of `spec`, and their causes.
///
/// 1. The residuals are tested for structure (`StructureStatistics`); the p-value comes from
///    data sets that are simulated with the fitted model and refitted.
/// 2. Unless the model is adequate, every mechanism of the catalogue is added and the whole
///    model is refitted with the weights of the base fit. The p-value of a candidate is the
///    fraction of data sets simulated with the base model in which the best of all candidates
///    gains as much, to first order.
/// 3. A candidate explains the data if that p-value is at most `chance`, it leaves no
///    structure (or little compared with what it explains), its parameters are plausible, and
///    it predicts held-out blocks better than the base does. A description never explains.
/// 4. A possible cause that is within `margin` of the best explanation is its rival, even if
///    its parameters lie somewhat outside the plausible range, as such limits are not sharp.
///    A single explanation is named; several are not separable. Without an explanation the
///    search tries pairs, unless even the best single cause gains no more than chance
///    explains (chance gives more to the best of many pairs). If pairs fail too, the
///    structure is unexplained. With one diameter no cause is named, because the size
///    dependence, which distinguishes causes, was not measured.
/// 5. If unstated errors (`unstated_errors`) leave no structure and fit better than the best
///    single explanation by more than `margin`, or about as well as the best pair, no cause
///    is named; if they fit about as well, they are `rival_errors`.
///
/// If the fit holds uncertain material constants (Materials::propagated), the base model is
/// refitted with constants that the points move.
/// @param base the fit of `spec` to `datasets`. @pre base.usable
/// @param base_intervals its intervals [slots], if known; else they are computed
/// @throws ComputationError if the fit cannot be repeated from its own result
Diagnosis diagnose(const FitSpec& spec, const std::vector<Dataset>& datasets, const FitResult& base,
                   const DiagnosisOptions& options,
                   const std::vector<IntervalSet>& base_intervals = {});

/// The same, after fitting the base model.
/// @throws ComputationError also if that fit is not usable
Diagnosis diagnose(const FitSpec& spec, const std::vector<Dataset>& datasets,
                   const DiagnosisOptions& options);

/// The fit file of a diagnosis with the extended model, as a text for `parse_fit`: the same
/// datasets (relative to `folder`), noise and uncertainty, the mechanisms that were found, and
/// every parameter at its estimate. Without a cause it has the original model.
/// @throws InputError if the fit file is no longer valid TOML
std::string extended_toml(const Diagnosis& diagnosis, const std::filesystem::path& folder);

/// The simulated data sets that calibrate a diagnosis, as numbered pieces. Their residuals show how
/// much structure chance leaves and how much causes gain by chance. If there are outlying points,
/// the same number of pieces follows for the data without them. The other steps of a diagnosis
/// (mechanisms, pairs, held-out points) are not divided into pieces, because their parts are few
/// and unequal.
class Calibration {
 public:
  /// @throws ComputationError if the base model has no usable fit
  Calibration(const FitSpec& spec, const std::vector<Dataset>& datasets,
              const DiagnosisOptions& options);
  ~Calibration();

  std::size_t pieces() const;

  /// `calibration_row` of a piece. Thread-safe.
  std::vector<double> run(std::size_t piece) const;

  /// The numbers on which the pieces depend, with all digits.
  std::string digits() const;

 private:
  // All points; then without the outlying ones, if any.
  std::vector<std::unique_ptr<DiagnosedData>> data_;
};

}  // namespace recoil
