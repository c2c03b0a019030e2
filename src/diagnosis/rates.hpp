#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "diagnosis/diagnosis_result.hpp"

namespace recoil {

struct SearchBase;

/// The rates of the answers of a diagnosis of points like these, from data sets that are simulated
/// with the points, noise and captures of `diagnosis` and then diagnosed: with each named or listed
/// cause at its estimated strength and at half of it, and with the base model alone. At the
/// fraction s of the effect of a cause
///   e^2 = e_0^2 + s (e_1^2 - e_0^2),
/// with e_1 from the model with the cause and e_0 from the same model without it. The pieces are
/// numbered; each is a pure function of its number and the seed of the diagnosis.
class DesignRates {
 public:
  /// @param datasets number of data sets for each cause and strength
  /// @pre `diagnosis` outlives it
  DesignRates(const Diagnosis& diagnosis, int datasets);

  ~DesignRates();

  std::size_t pieces() const;

  /// Diagnoses one data set. @return four numbers, each 1 or 0: the model is not adequate; the
  /// cause alone is named; it is listed, or named with another; only another cause is named.
  /// Thread-safe.
  std::vector<double> run(std::size_t piece) const;

  /// @param rows results of all pieces
  OwnDesign count(const std::vector<std::vector<double>>& rows) const;

  /// The numbers on which the pieces depend, with all digits.
  std::string digits() const;

 private:
  struct Truth {
    std::string id;  ///< empty: no cause acts
    double strength = 0.0;
    std::vector<double> squares;  ///< e^2 [points]
  };

  const Diagnosis& diagnosis_;
  DiagnosisOptions options_;
  std::unique_ptr<const SearchBase> base_;
  std::size_t datasets_;
  std::vector<Truth> truths_;
};

}  // namespace recoil
