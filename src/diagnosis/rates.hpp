#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "diagnosis/diagnosis_result.hpp"

namespace recoil {

struct SearchBase;

/// What a diagnosis of points like these would have shown, by data sets that are simulated with the
/// points, noise and captures of `diagnosis` and then diagnosed: where a cause that was named or
/// listed acts as it was found, where it has half that effect, and where nothing acts beside the
/// base model. At a part s of the effect of a cause
///   e^2 = e_0^2 + s (e_1^2 - e_0^2),
/// with e_1 of the model with the cause and e_0 of the same without it. The pieces are numbered;
/// each is a pure function of its number and the seed of the diagnosis.
class DesignRates {
 public:
  /// @param datasets how many are simulated of each cause and strength
  /// @pre `diagnosis` outlives it
  DesignRates(const Diagnosis& diagnosis, int datasets);

  ~DesignRates();

  std::size_t pieces() const;

  /// Diagnoses one data set: {1 if anything is seen, if the cause alone is named, if it is listed
  /// or named beside another, if something else is named}. Called from any thread.
  std::vector<double> run(std::size_t piece) const;

  /// @param rows of all pieces
  OwnDesign count(const std::vector<std::vector<double>>& rows) const;

  /// The numbers that the pieces start from, to the last digit.
  std::string digits() const;

 private:
  struct Truth {
    std::string id;  ///< empty: nothing acts
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
