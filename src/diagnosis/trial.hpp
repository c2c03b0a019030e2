#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "core/resumable.hpp"
#include "diagnosis/candidate_result.hpp"
#include "diagnosis/diagnosis_options.hpp"
#include "diagnosis/search.hpp"

namespace recoil {

/// The kinds of kept results besides the pieces of the calibration, whose numbers begin at
/// `DiagnosisOptions::first_piece`.
enum class KeptPiece {
  single,  ///< a single mechanism of the catalogue
  look,    ///< the first look at a pair
  pair     ///< the final result of a pair
};

/// The number of piece `k` of its kind, distinct from those of the calibration.
std::size_t number_of(const DiagnosisOptions& options, KeptPiece kind, std::size_t k);

/// The kept part of a refit: everything but the discrepancy, which is not needed later.
Json json_of(const Refit& refit);
/// Reads a kept refit.
/// @throws std::exception unless it is one of `candidate` to this number of points
Refit refit_of(const Json& json, const Candidate& candidate, std::size_t points);

/// @throws std::exception unless `row` begins with `names`
void require_names(const Json& row, const std::vector<std::string>& names);

/// Refits `candidate` from `near` under the errors of laws and computes its gain; follows `tries`
/// starts (`refit_candidate`).
CandidateResult try_one(const SearchBase& base, Candidate candidate, std::span<const double> near,
                        int tries);

/// Can the points determine what `candidate` adds? The number of distinct impacts (size and
/// velocity, and series if the mechanism can differ between series) must be at least that of the
/// moving parameters of the base plus those of the mechanism. A batch effect needs two series.
bool can_be_seen(const SearchBase& base, const Candidate& candidate);

/// The properties and the gain of a fitted candidate.
CandidateResult examine(const SearchBase& base, Candidate candidate, Refit refit);

/// Sets the p-value of the structure that `result` leaves.
void find_what_is_left(const SearchBase& base, CandidateResult& result);

/// Replaces `result` by a fit with released parameters if its criterion is better by more than 2.
void try_released(const SearchBase& base, CandidateResult& result, int tries);

/// Computes `cost_of_possible` if a value is allowed only within its error, and judges the
/// parameters by it.
void judge_possible_values(const SearchBase& base, CandidateResult& result, int tries);

/// The result of `make` for `added`, or the kept one of piece `k` of its kind.
CandidateResult kept_candidate(const SearchBase& base, KeptPiece kind, std::size_t k,
                               const std::vector<std::string>& added,
                               const std::function<CandidateResult()>& make);

/// `theta` with free slots clamped to their bounds.
std::vector<double> within_bounds(const ImpactModel& model, std::vector<double> theta);

/// Sorts by the criterion, best first, and removes candidates that could not be fitted.
void sort_by_criterion(std::vector<CandidateResult>& candidates);

/// Refits the base with every mechanism of the catalogue that `spec` lacks, with structure and
/// plausibility; best first. Mechanisms that cannot be fitted are omitted.
std::vector<CandidateResult> try_singles(const SearchBase& base);

/// Fits every two of `singles` that could be causes, within their plausible ranges, from the fits
/// of either; best first. Two mechanisms that both spread the impacts are not combined, as their
/// effects are alike.
std::vector<CandidateResult> try_pairs(const SearchBase& base,
                                       const std::vector<CandidateResult>& singles);

}  // namespace recoil
