#include "diagnosis/singles.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/parallel.hpp"
#include "diagnosis/trial.hpp"
#include "estimate/observation.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"

namespace recoil {
namespace {

constexpr int tries_alone = 4;

constexpr double least_effect = 0.01;  // of a standard deviation of the point it moves most

/// Can the mechanism move any residual by `least_effect`, with its parameters at their start and
/// each at either end of what it can be?
bool can_matter(const SearchBase& base, const Mechanism& mechanism, const Candidate& candidate,
                const std::vector<double>& near) {
  const ImpactModel& model = candidate.model;
  const Observations& data = base.fitted.data;
  const std::vector<Prediction> plain =
      predict(model, without_mechanism(model, near, mechanism), candidate.impacts, false);
  const auto moves = [&](const std::vector<double>& theta) {
    const std::vector<Prediction> acted = predict(model, theta, candidate.impacts, false);
    for (std::size_t i = 0; i < acted.size(); ++i) {
      if (!acted[i].usable() || !plain[i].usable()) return true;  // only a fit can tell
      const double r = weighted_residual(data.points[i], acted[i].restitution_squared).value;
      const double before = weighted_residual(data.points[i], plain[i].restitution_squared).value;
      if (std::abs(r - before) >= least_effect) return true;
    }
    return false;
  };
  if (moves(near)) return true;
  for (std::size_t j = 0; j < near.size(); ++j) {
    const ParameterSlot& slot = model.slots[j];
    if (slot.stated || !candidate.adds(slot)) continue;
    const AllowedValues allowed = allowed_values(candidate, near, j);
    for (const double end : {allowed.upper, allowed.lower}) {
      std::vector<double> theta = near;
      theta[j] = std::clamp(end, slot.lower, slot.upper);
      if (moves(theta)) return true;
    }
  }
  return false;
}

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
  if (!can_be_seen(base, candidate) || !can_matter(base, mechanism, candidate, near)) return {};
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
