#pragma once

#include <memory>
#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "diagnosis/diagnosis_options.hpp"
#include "estimate/fit_spec.hpp"

namespace recoil {

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

  /// What the pieces begin with, to the last digit.
  std::string digits() const;

 private:
  struct Side;  // one set of data
  std::vector<std::unique_ptr<Side>> sides_;
};

}  // namespace recoil
