#include "diagnosis/singles.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "core/parallel.hpp"
#include "diagnosis/trial.hpp"
#include "estimate/observation.hpp"

namespace recoil {
namespace {

constexpr int tries_alone = 4;

/// One mechanism of the catalogue; without a usable refit where it cannot be fitted.
CandidateResult try_single(const SearchBase& base, const Mechanism& mechanism,
                           Candidate candidate) {
  if (candidate.free_count >= static_cast<int>(base.fitted.data.points.size()) - 1) return {};
  const std::vector<PointConditions>& impacts = candidate.impacts;
  if (std::all_of(impacts.begin(), impacts.end(), [&](const PointConditions& at) {
        return is_taken_away(candidate.model, mechanism, at);
      })) {
    return {};
  }
  const std::vector<double> near =
      carried_over(base.candidate.model, base.refit.theta, candidate.model);
  CandidateResult result = try_one(base, std::move(candidate), near, tries_alone);
  try_released(base, result, tries_alone);
  hold_to_what_is_possible(base, result, tries_alone);
  return result;
}

}  // namespace

std::vector<CandidateResult> try_singles(const SearchBase& base) {
  std::vector<const Mechanism*> untried;
  for (const Mechanism* mechanism : mechanisms_that_may_act(base.spec, base.candidate.model)) {
    // Counts of captures have told the base model already how the impacts differ.
    if (mechanism->spreads() && base.fitted.data.noise.event_spread > 0.0) continue;
    untried.push_back(mechanism);
  }
  std::vector<CandidateResult> results(untried.size());
  parallel_over(untried.size(), base.options.threads, [&](std::size_t k) {
    const std::vector<std::string> added = {std::string(untried[k]->info.id)};
    results[k] = kept_candidate(base, KeptPiece::single, k, added, [&] {
      return try_single(base, *untried[k], make_candidate(base.spec, base.datasets, added));
    });
  });
  sort_by_criterion(results);
  return results;
}

}  // namespace recoil
