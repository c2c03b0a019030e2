#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "diagnosis/judge.hpp"
#include "diagnosis/trial.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

constexpr int tries_in_pairs = 2;
// A pair is followed if its criterion at the first look is within `followed_within` of the best,
// or within the fraction `followed_part` of the gain of the best.
constexpr double followed_within = 30.0;
constexpr double followed_part = 0.2;
// Least part of the misfit that each of a pair must explain if structure is left.
constexpr double carried_part = 0.1;

/// Does a free parameter of an added mechanism rest on a bound? Exponents may.
bool rests_on_the_edge(const CandidateResult& result) {
  for (std::size_t j = 0; j < result.refit.theta.size(); ++j) {
    const ParameterSlot& slot = result.candidate.model.slots[j];
    // A released parameter may rest on a bound.
    const bool own = result.candidate.adds(slot) && slot.parameter->free;
    if (own && slot.free && !result.refit.moving[j]) return true;
  }
  return false;
}

/// The first look at a pair: no released parameters, and the errors of laws are applied only at the
/// end of descents without them.
struct FirstLook {
  const CandidateResult* first = nullptr;
  const CandidateResult* second = nullptr;
  Candidate both{};
  Refit refit{};
  /// An upper limit of the change of the criterion: a pair is no worse than the better mechanism
  /// alone.
  double delta_aicc = INFINITY;
};

std::vector<std::string> names_of(const FirstLook& look) {
  return {look.first->candidate.added.front(), look.second->candidate.added.front()};
}

/// Fits the pair by descents from the fits of either alone.
void look_at(const SearchBase& base, FirstLook& look) {
  const Observations& data = base.fitted.data;
  if (look.both.free_count >= static_cast<int>(data.points.size()) - 2) return;
  if (!can_be_seen(base, look.both)) return;
  for (const CandidateResult* from : {look.first, look.second}) {
    const std::vector<double> near = within_bounds(
        look.both.model, carried_over(from->candidate.model, from->refit.theta, look.both.model));
    Refit refit = refit_candidate(look.both, data, near, 1);
    if (refit.usable && !(look.refit.usable && look.refit.chi2 <= refit.chi2)) {
      look.refit = std::move(refit);
    }
  }
  look.delta_aicc = std::min(look.first->delta_aicc, look.second->delta_aicc);
  const Refit seen = under_law_errors(look.both, data, look.refit, base.laws);
  if (!seen.usable) return;
  look.delta_aicc = std::min(
      look.delta_aicc, corrected_criterion(data, seen, look.both.free_count) - base.criterion);
}

/// Reads the first look from the kept rows, or computes it.
void look_once(const SearchBase& base, std::size_t k, FirstLook& look) {
  const std::vector<std::string> names = names_of(look);
  look.both = make_candidate(base.spec, base.datasets, names, false, true);
  const auto make = [&] {
    look_at(base, look);
    return std::pair(look.refit, look.delta_aicc);
  };
  const auto write = [&](const auto& seen) {
    return Json::array({names, json_of(seen.first), row_json({seen.second})});
  };
  const auto read = [&](const Json& row) {
    require_names(row, names);
    return std::pair(refit_of(row.at(1), look.both, base.fitted.data.points.size()),
                     row_numbers(row.at(2)).at(0));
  };
  std::tie(look.refit, look.delta_aicc) = kept_or_made(
      base.options.kept.get(), number_of(base.options, KeptPiece::look, k), make, write, read);
}

/// The criterion up to which a pair is followed. A pair that is further behind at the first look
/// does not become one of the best: of 460 pairs for wall1990-molybdenum and wall1990-silicon, the
/// later steps improved none by more than a third of its change of the criterion, and none of the
/// best ten by more than a twentieth.
double worth_following(const std::vector<FirstLook>& looks) {
  double best = 0.0;
  for (const FirstLook& look : looks) best = std::min(best, look.delta_aicc);
  return best + std::max(followed_within, followed_part * -best);
}

/// The final result of a pair.
CandidateResult try_both(const SearchBase& base, FirstLook look, bool follow) {
  const CandidateResult& first = *look.first;
  const CandidateResult& second = *look.second;
  const Observations& data = base.fitted.data;
  if (!follow) {
    Refit refit = under_law_errors(look.both, data, std::move(look.refit), base.laws);
    CandidateResult result = examine(base, std::move(look.both), std::move(refit));
    find_what_is_left(base, result);
    result.set_aside = SetAside::far_behind;
    return result;
  }
  Refit refit = with_law_errors(look.both, data, std::move(look.refit), base.laws);
  CandidateResult result = examine(base, std::move(look.both), std::move(refit));
  try_released(base, result, tries_in_pairs);
  find_what_is_left(base, result);
  // Each of the two must contribute.
  const double better = std::min(first.delta_aicc, second.delta_aicc);
  const bool possible = first.delta_aicc < second.delta_aicc ? first.plausible : second.plausible;
  if (possible && !(result.delta_aicc < better - base.options.margin_in_pairs)) {
    result.set_aside = SetAside::one_would_do;
  }
  const double better_part = std::min(first.remaining_part, second.remaining_part);
  if (result.remaining_p < tolerated_level && better_part - result.remaining_part < carried_part) {
    result.set_aside = SetAside::one_hardly_takes_part;
  }
  if (rests_on_the_edge(result)) {
    result.set_aside = SetAside::at_the_edge;
  }
  return result;
}

}  // namespace

std::vector<CandidateResult> try_pairs(const SearchBase& base,
                                       const std::vector<CandidateResult>& singles) {
  std::vector<const CandidateResult*> causes;
  for (const CandidateResult& single : singles) {
    const bool batch = find_mechanism(single.candidate.added.front())->is_batch();
    if (single.kind == MechanismKind::description) continue;
    if (batch && series_are_sizes(base.fitted.data)) continue;
    causes.push_back(&single);
  }
  std::vector<FirstLook> looks;
  for (std::size_t a = 0; a < causes.size(); ++a) {
    for (std::size_t b = a + 1; b < causes.size(); ++b) {
      if (spreads(*causes[a]) && spreads(*causes[b])) continue;
      looks.push_back({causes[a], causes[b], {}, {}});
    }
  }
  Progress progress("pairs of causes", 2 * looks.size());
  parallel_over(looks.size(), base.options.threads, [&](std::size_t k) {
    look_once(base, k, looks[k]);
    progress.advance();
  });
  const double worth = worth_following(looks);
  std::vector<CandidateResult> results(looks.size());
  parallel_over(looks.size(), base.options.threads, [&](std::size_t k) {
    const bool follow = looks[k].delta_aicc <= worth;
    results[k] = kept_candidate(base, KeptPiece::pair, k, names_of(looks[k]),
                                [&] { return try_both(base, std::move(looks[k]), follow); });
    progress.advance();
  });
  sort_by_criterion(results);
  return results;
}

}  // namespace recoil
