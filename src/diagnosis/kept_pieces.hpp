#pragma once

#include <exception>
#include <optional>
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

/// Numbers, every digit of them; infinite ones, which JSON does not have, as words.
Json row_json(const std::vector<double>& row);
/// And back. @throws Json::exception, std::exception for another thing
std::vector<double> row_of(const Json& json);

/// A refit but for what its residuals share, which nobody asks for afterwards.
Json json_of(const Refit& refit);
/// And back. @throws std::exception for another thing than a refit of `candidate` to so many points
Refit refit_of(const Json& json, const Candidate& candidate, std::size_t points);

/// @throws std::exception unless `row` begins with `names`
void require_names(const Json& row, const std::vector<std::string>& names);

/// What came of piece `number`: what is kept, as `read` understands it, or what `make` gives, which
/// is kept as `write` says it.
template <class Make, class Write, class Read>
auto kept_or_made(const DiagnosisOptions& options, std::size_t number, const Make& make,
                  const Write& write, const Read& read) {
  if (options.kept) {
    if (const std::optional<Json> row = options.kept->find(number)) {
      try {
        return read(*row);
      } catch (const std::exception&) {  // a damaged row: the piece is run again
      }
    }
  }
  auto made = make();
  if (options.kept) options.kept->put(number, write(made));
  return made;
}

}  // namespace recoil
