#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "diagnosis/kept_pieces.hpp"
#include "diagnosis/search.hpp"

namespace recoil {

/// `candidate` refitted from `near` under the errors of laws, with what it gains and leaves; of its
/// starts `tries` are followed (`refit_candidate`).
CandidateResult try_one(const SearchBase& base, Candidate candidate, std::span<const double> near,
                        int tries);

/// Can the points show what `candidate` adds? Its parameters need as many distinct impacts (size
/// and velocity; series, where the mechanism knows series), and more than the base model moves. A
/// batch takes two series.
bool can_be_seen(const SearchBase& base, const Candidate& candidate);

/// What a fitted candidate is, gains and leaves.
CandidateResult examine(const SearchBase& base, Candidate candidate, Refit refit);

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

}  // namespace recoil
