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

/// The parts of a diagnosis that are kept beside the pieces of its calibration, which have numbers
/// of their own from `DiagnosisOptions::first_piece` on.
enum class KeptPiece {
  single,  ///< a mechanism of the catalogue alone
  look,    ///< the first look at two of them
  pair     ///< two of them in the end
};

/// The number of piece `k` of its kind; others than those of the calibration.
std::size_t number_of(const DiagnosisOptions& options, KeptPiece kind, std::size_t k);

/// What is kept of a refit: all but the discrepancy, which is not needed afterwards.
Json json_of(const Refit& refit);
/// The refit again. @throws std::exception unless it is one of `candidate` to so many points
Refit refit_of(const Json& json, const Candidate& candidate, std::size_t points);

/// @throws std::exception unless `row` begins with `names`
void require_names(const Json& row, const std::vector<std::string>& names);

/// `candidate` refitted from `near` under the errors of laws, with what it gains; of its starts
/// `tries` are followed (`refit_candidate`).
CandidateResult try_one(const SearchBase& base, Candidate candidate, std::span<const double> near,
                        int tries);

/// Can the points show what `candidate` adds? Its parameters need as many distinct impacts (size
/// and velocity; series, where the mechanism knows series), and more than the base model moves. A
/// batch takes two series.
bool can_be_seen(const SearchBase& base, const Candidate& candidate);

/// What a fitted candidate is and gains.
CandidateResult examine(const SearchBase& base, Candidate candidate, Refit refit);

/// Sets the p-value of the structure that `result` leaves.
void find_what_is_left(const SearchBase& base, CandidateResult& result);

/// The same with released parameters, if that is worth it.
void try_released(const SearchBase& base, CandidateResult& result, int tries);

/// Finds `cost_of_possible` where an error alone makes a value possible, and judges by it.
void hold_to_what_is_possible(const SearchBase& base, CandidateResult& result, int tries);

/// What `make` gives for `added`, or what is kept of it as piece `k` of its kind.
CandidateResult kept_candidate(const SearchBase& base, KeptPiece kind, std::size_t k,
                               const std::vector<std::string>& added,
                               const std::function<CandidateResult()>& make);

/// Theta with what is free within its bounds.
std::vector<double> within_bounds(const ImpactModel& model, std::vector<double> theta);

/// The best first; what cannot be fitted is left out.
void sort_by_criterion(std::vector<CandidateResult>& candidates);

/// Every mechanism of the catalogue that `spec` does not have, refitted, with its structure and its
/// plausibility; the best first. Mechanisms that cannot be fitted are left out.
std::vector<CandidateResult> try_singles(const SearchBase& base);

/// Every two of `singles` that could be causes, within their plausible ranges, fitted from the fit
/// of either; the best first. Two spreads at once are not tried: one looks like the other.
std::vector<CandidateResult> try_pairs(const SearchBase& base,
                                       const std::vector<CandidateResult>& singles);

}  // namespace recoil
