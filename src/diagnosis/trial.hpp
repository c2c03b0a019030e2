#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "diagnosis/candidate_result.hpp"
#include "diagnosis/diagnosis_options.hpp"
#include "diagnosis/search.hpp"

namespace recoil {

/// The kinds of kept results besides the pieces of the calibration, whose numbers begin at
/// `DiagnosisOptions::first_piece`.
enum class KeptPiece {
  single,     ///< a single mechanism of the catalogue
  screening,  ///< the screening of a pair
  pair        ///< the final result of a pair
};

/// The number of piece `k` of its kind, distinct from those of the calibration.
std::uint64_t number_of(const DiagnosisOptions& options, KeptPiece kind, std::size_t k);

/// Refits `candidate` from `near` under the errors of laws and computes its gain; follows `tries`
/// starts (`refit_candidate`).
CandidateResult try_one(const SearchBase& base, Candidate candidate, std::span<const double> near,
                        int tries);

/// Can the points determine what `candidate` adds? The number of distinct impacts (size and
/// velocity, and series if the mechanism can differ between series) must be at least that of the
/// moving parameters of the base plus those of the mechanism. A batch effect needs two series.
bool can_be_seen(const SearchBase& base, const Candidate& candidate);

/// Refits the base with every mechanism of the catalogue that `spec` lacks, with structure and
/// plausibility; best first. Mechanisms that cannot be fitted are omitted.
std::vector<CandidateResult> try_singles(const SearchBase& base);

/// Fits every two of `singles` that could be causes, within their plausible ranges, from the fits
/// of either; best first. Two mechanisms that both spread the impacts are not combined, as their
/// effects are alike.
std::vector<CandidateResult> try_pairs(const SearchBase& base,
                                       const std::vector<CandidateResult>& singles);

}  // namespace recoil
