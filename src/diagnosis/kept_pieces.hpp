#pragma once

#include <string>
#include <vector>

#include "core/json.hpp"
#include "core/kept_rows.hpp"
#include "diagnosis/candidate_result.hpp"
#include "diagnosis/diagnosis_options.hpp"

namespace recoil {

/// The parts of a diagnosis that are kept beside the pieces of its calibration, which have numbers
/// of their own from `DiagnosisOptions::first_piece` on.
enum class KeptPiece {
  single,  ///< a mechanism of the catalogue alone
  look,    ///< the first look at two of them
  pair     ///< two of them in the end
};

/// The number of piece `k` of its kind; others than those of the calibration.
std::size_t number_of(const DiagnosisOptions& options, KeptPiece kind, std::size_t k);

/// A refit but for what its residuals share, which nobody asks for afterwards.
Json json_of(const Refit& refit);
/// And back. @throws std::exception for another thing than a refit of `candidate` to so many points
Refit refit_of(const Json& json, const Candidate& candidate, std::size_t points);

/// @throws std::exception unless `row` begins with `names`
void require_names(const Json& row, const std::vector<std::string>& names);

}  // namespace recoil
