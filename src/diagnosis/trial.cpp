#include "diagnosis/trial.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "core/json.hpp"
#include "core/kept_rows.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "diagnosis/judge.hpp"
#include "diagnosis/law_errors.hpp"
#include "estimate/observation.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

constexpr int tries_alone = 4;
constexpr int tries_in_pairs = 2;
constexpr double worth_releasing = 2.0;  // least gain of the criterion by released parameters
// Least effect, in standard deviations of the most affected point.
constexpr double least_effect = 0.01;
// A pair is followed if its criterion at the screening is within `followed_within` of the best,
// or within the fraction `followed_part` of the gain of the best; of these the first
// `most_followed`.
constexpr double followed_within = 30.0;
constexpr double followed_part = 0.2;
constexpr std::size_t most_followed = 40;
// Least part of the misfit that each of a pair must explain if structure is left.
constexpr double carried_part = 0.1;

/// The kept part of a refit: everything but the discrepancy, which is not needed later.
Json json_of(const Refit& refit) { return as_json(refit, NonFinite::word); }

/// Reads a kept refit.
/// @throws std::exception unless it is one of `candidate` to this number of points
Refit refit_of(const Json& json, const Candidate& candidate, std::size_t points) {
  Refit refit = value_from<Refit>(json);
  const std::size_t p = candidate.model.slots.size();
  if (refit.usable && (refit.theta.size() != p || refit.moving.size() != p ||
                       refit.residuals.size() != points || refit.jacobian.size() < points * p)) {
    throw std::length_error("a refit of something else");
  }
  return refit;
}

/// @throws std::exception unless `row` begins with `names`
void require_names(const Json& row, const std::vector<std::string>& names) {
  if (row.at(0).get<std::vector<std::string>>() != names) {
    throw std::invalid_argument("a row of something else");
  }
}

MechanismKind kind_of(const std::vector<std::string>& ids) {
  MechanismKind kind = MechanismKind::measurement;
  for (const Mechanism* mechanism : chain_of(ids)) {
    if (mechanism->info.kind == MechanismKind::description) return MechanismKind::description;
    if (mechanism->info.kind == MechanismKind::physics) kind = MechanismKind::physics;
  }
  return kind;
}

/// See `CandidateResult::remaining_part`.
double remaining_part_of(const SearchBase& base, const Candidate& candidate, double chi2) {
  if (!base.fitted.data.noise.sd_stated) return 1.0;  // the size of the misfit is unknown
  const auto n = static_cast<double>(base.fitted.data.points.size());
  const double before = base.first.chi2 - (n - base.candidate.free_count);
  const double after = chi2 - (n - candidate.free_count);
  return before > 0.0 ? after / before : 1.0;
}

bool all_plausible(const std::vector<FoundParameter>& parameters) {
  return std::ranges::all_of(parameters, &FoundParameter::plausible);
}

/// Sets the parameters of a fitted candidate and whether they are possible.
void find_parameters(const SearchBase& base, CandidateResult& result) {
  const auto found = [&](double errors) {
    return found_parameters(result.candidate, result.refit, base.noise_scale, errors);
  };
  const bool by_error = result.cost_of_possible <= allowed_errors * allowed_errors;
  result.parameters = found(by_error ? allowed_errors : 0.0);
  result.plausible = all_plausible(result.parameters);
  result.only_by_error = result.plausible && by_error && !all_plausible(found(0.0));
  result.near_plausible = std::ranges::all_of(result.parameters, &FoundParameter::near_plausible);
}

/// The result of a fitted candidate, given its `cost_of_possible`.
CandidateResult described(const SearchBase& base, Candidate candidate, Refit refit,
                          double cost_of_possible) {
  CandidateResult result;
  result.candidate = std::move(candidate);
  result.kind = kind_of(result.candidate.added);
  result.refit = std::move(refit);
  result.cost_of_possible = cost_of_possible;
  if (result.refit.usable) find_parameters(base, result);
  return result;
}

/// Can the mechanism act differently in different series?
bool can_differ_between_series(const Mechanism& mechanism) {
  const auto& parameters = mechanism.info.parameters;
  return std::ranges::any_of(
      parameters, [](const Parameter& p) { return p.per_series || !p.stated_by.empty(); });
}

bool can_be_released(const Candidate& candidate) {
  return std::ranges::any_of(candidate.model.slots, [&](const ParameterSlot& slot) {
    return !slot.free && !slot.stated && slot.parameter->searched && candidate.adds(slot);
  });
}

/// The properties and the gain of a fitted candidate.
/// @param exact theta with exact laws
CandidateResult examine(const SearchBase& base, Candidate candidate, RefitOverLaws over,
                        std::vector<double> exact) {
  CandidateResult result = described(base, std::move(candidate), std::move(over.refit), 0.0);
  result.exact_theta = std::move(exact);
  if (!result.refit.usable) return result;
  result.delta_aicc = over.criterion - base.criterion;
  result.remaining_part = remaining_part_of(base, result.candidate, over.first_chi2);
  return result;
}

/// Sets the p-value of the structure that `result` leaves.
void find_remaining_p(const SearchBase& base, CandidateResult& result) {
  if (!result.refit.usable) return;
  const Observations& data = base.fitted.data;
  std::vector<double> squares;
  for (const Prediction& at :
       predict(result.candidate.model, result.refit.theta, data.conditions(), false)) {
    squares.push_back(at.restitution_squared);
  }
  result.remaining_p =
      quick_structure(data, base.fitted.weights, result.refit, squares, base.noise).p_value;
}

/// Start values for `to` from `fitted`, parameters of `from`, with free slots clamped to their
/// bounds.
std::vector<double> start_from(const Candidate& from, std::span<const double> fitted,
                               const Candidate& to) {
  std::vector<double> theta = carried_over(from.model, fitted, to.model);
  for (std::size_t j = 0; j < theta.size(); ++j) {
    const ParameterSlot& slot = to.model.slots[j];
    if (slot.free) theta[j] = std::clamp(theta[j], slot.lower, slot.upper);
  }
  return theta;
}

/// Does what `candidate` adds vanish in this fit? What is stated and acts does not.
bool vanishes(const Candidate& candidate, const Refit& fit) {
  bool is_free = false;
  for (std::size_t j = 0; j < fit.theta.size(); ++j) {
    const ParameterSlot& slot = candidate.model.slots[j];
    if (!candidate.adds(slot) || !(slot.free || slot.stated)) continue;
    const double null = std::clamp(slot.parameter->null_value, slot.lower, slot.upper);
    if (fit.moving[j] || fit.theta[j] != null) return false;
    is_free = is_free || slot.free;
  }
  return is_free;
}

/// The refit, under the errors of laws, of a candidate that vanishes with exact laws: that of the
/// base, at the cost of the parameters. An assumption: where the base fits badly, errors of the
/// laws can make an effect appear (by 10 and more in two of 566 fits; it changed no answer).
RefitOverLaws as_the_base(const SearchBase& base, const Candidate& candidate, const Refit& exact) {
  RefitOverLaws over{exact, base.criterion, base.first.chi2};
  const Refit& of_base = base.refit;
  over.refit.theta = start_from(base.candidate, of_base.theta, candidate);
  for (std::size_t j = 0; j < exact.theta.size(); ++j) {
    if (candidate.adds(candidate.model.slots[j])) over.refit.theta[j] = exact.theta[j];
  }
  over.refit.chi2 = of_base.chi2;
  over.refit.residuals = of_base.residuals;
  over.refit.discrepancy = of_base.discrepancy;
  over.refit.law_error = of_base.law_error;
  over.refit.jacobian = jacobian_at(base, candidate, over.refit.theta);
  const auto cost = [&](int parameters) {
    return corrected_criterion(base.fitted.data, 1.0, parameters);
  };
  over.criterion += cost(candidate.free_count) - cost(base.candidate.free_count);
  return over;
}

/// Replaces `result` by a fit with released parameters if its criterion is better by more than 2.
void try_released(const SearchBase& base, CandidateResult& result, int tries) {
  if (!result.refit.usable || !can_be_released(result.candidate)) return;
  // An implausible single cause is kept, so that it can be reported.
  const bool pair = result.candidate.added.size() > 1;
  Candidate released = make_candidate(base.spec, base.datasets, result.candidate.added, true, pair);
  if (!can_be_seen(base, released)) return;
  const std::vector<double> near = start_from(result.candidate, result.exact_theta, released);
  CandidateResult other = try_one(base, std::move(released), near, tries);
  if (other.refit.usable && other.delta_aicc < result.delta_aicc - worth_releasing) {
    result = std::move(other);
  }
}

/// Computes `cost_of_possible` if a value is allowed only within its error, and judges the
/// parameters by it.
void judge_possible_values(const SearchBase& base, CandidateResult& result) {
  if (!result.refit.usable || !result.only_by_error) return;
  Candidate held = make_candidate(base.spec, base.datasets, result.candidate.added,
                                  result.candidate.released, true);
  const std::vector<double> near = start_from(result.candidate, result.exact_theta, held);
  const CandidateResult possible = try_one(base, std::move(held), near, tries_alone);
  if (!possible.refit.usable) return;
  result.cost_of_possible = possible.delta_aicc - result.delta_aicc;
  find_parameters(base, result);
}

/// The result of `make` for `added`, or the kept one of piece `k` of its kind.
CandidateResult kept_candidate(const SearchBase& base, KeptPiece kind, std::size_t k,
                               const std::vector<std::string>& added,
                               const std::function<CandidateResult()>& make) {
  // A row contains the names, because the index depends on the order by the criterion.
  const auto write = [&](const CandidateResult& c) {
    if (!c.refit.usable) return Json::array({added});
    const Json aside = c.set_aside ? Json(name_of(*c.set_aside)) : Json(nullptr);
    return Json::array(
        {added, c.candidate.released, json_of(c.refit),
         row_json({c.delta_aicc, c.remaining_p, c.remaining_part, c.cost_of_possible}), aside});
  };
  const auto read = [&](const Json& row) {
    require_names(row, added);
    if (row.size() == 1) return CandidateResult{};
    Candidate candidate =
        make_candidate(base.spec, base.datasets, added, row.at(1).get<bool>(), added.size() > 1);
    Refit refit = refit_of(row.at(2), candidate, base.fitted.data.points.size());
    const std::vector<double> values = row_numbers(row.at(3));
    CandidateResult c = described(base, std::move(candidate), std::move(refit), values.at(3));
    c.delta_aicc = values.at(0);
    c.remaining_p = values.at(1);
    c.remaining_part = values.at(2);
    if (!row.at(4).is_null()) c.set_aside = value_named<SetAside>(row.at(4).get<std::string>());
    return c;
  };
  return kept_or_made(base.options.kept.get(), number_of(base.options, kind, k), make, write, read);
}

/// Sorts by the criterion, best first, equal ones in the order of the catalogue, and removes
/// candidates that could not be fitted.
void sort_by_criterion(std::vector<CandidateResult>& candidates) {
  std::erase_if(candidates, [](const CandidateResult& c) { return !c.refit.usable; });
  constexpr double equal = 1e-6;
  std::ranges::stable_sort(
      candidates, {}, [](const CandidateResult& c) { return std::round(c.delta_aicc / equal); });
}

/// Can the mechanism change any residual by `least_effect`, with its parameters at their start or
/// one of them at either end of its allowed range?
bool can_matter(const SearchBase& base, const Mechanism& mechanism, const Candidate& candidate,
                const std::vector<double>& near) {
  const ImpactModel& model = candidate.model;
  const Observations& data = base.fitted.data;
  const std::vector<Prediction> plain =
      predict(model, without_mechanism(model, near, mechanism), candidate.impacts, false);
  const auto moves = [&](const std::vector<double>& theta) {
    const std::vector<Prediction> acted = predict(model, theta, candidate.impacts, false);
    for (std::size_t i = 0; i < acted.size(); ++i) {
      if (!acted[i].usable() || !plain[i].usable()) return true;  // only a fit can show the effect
      const auto residual = [&](const Prediction& at) {
        return weighted_residual(data.points[i], base.fitted.weights.points[i],
                                 at.restitution_squared)
            .value;
      };
      const double r = residual(acted[i]);
      const double before = residual(plain[i]);
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

/// Fits one mechanism of the catalogue; the refit is not usable if it cannot be fitted.
CandidateResult try_single(const SearchBase& base, const Mechanism& mechanism,
                           Candidate candidate) {
  if (candidate.free_count >= static_cast<int>(base.fitted.data.points.size()) - 1) return {};
  const bool never_acts = std::ranges::all_of(candidate.impacts, [&](const PointConditions& at) {
    return is_taken_away(candidate.model, mechanism, at);
  });
  if (never_acts) return {};
  const std::vector<double> near =
      carried_over(base.candidate.model, base.exact.theta, candidate.model);
  if (!can_be_seen(base, candidate) || !can_matter(base, mechanism, candidate, near)) return {};
  CandidateResult result = try_one(base, std::move(candidate), near, tries_alone);
  try_released(base, result, tries_alone);
  judge_possible_values(base, result);
  find_remaining_p(base, result);
  return result;
}

/// The mechanism of a candidate that adds only one.
const Mechanism& only_mechanism(const CandidateResult& single) {
  return *find_mechanism(single.candidate.added.front());
}

/// Does a free parameter of an added mechanism rest on a bound? Exponents may.
bool rests_on_limit(const CandidateResult& result) {
  for (std::size_t j = 0; j < result.refit.theta.size(); ++j) {
    const ParameterSlot& slot = result.candidate.model.slots[j];
    // A released parameter may rest on a bound.
    const bool own = result.candidate.adds(slot) && slot.parameter->free;
    if (own && slot.free && !result.refit.moving[j]) return true;
  }
  return false;
}

/// The screening of a pair: no released parameters, and the errors of laws are applied only at the
/// end of descents without them.
struct Screening {
  const CandidateResult* first = nullptr;
  const CandidateResult* second = nullptr;
  Candidate both{};
  Refit refit{};
  /// An upper limit of the change of the criterion: a pair is no worse than the better mechanism
  /// alone.
  double delta_aicc = INFINITY;
};

std::vector<std::string> names_of(const Screening& screening) {
  return {screening.first->candidate.added.front(), screening.second->candidate.added.front()};
}

/// Fits the pair by descents from the fits of either alone.
void screen(const SearchBase& base, Screening& screening) {
  const Observations& data = base.fitted.data;
  if (screening.both.free_count >= static_cast<int>(data.points.size()) - 2) return;
  if (!can_be_seen(base, screening.both)) return;
  for (const CandidateResult* from : {screening.first, screening.second}) {
    Refit refit =
        refit_candidate(screening.both, data, base.fitted.weights,
                        start_from(from->candidate, from->refit.theta, screening.both), 1);
    if (refit.usable && !(screening.refit.usable && screening.refit.chi2 <= refit.chi2)) {
      screening.refit = std::move(refit);
    }
  }
  screening.delta_aicc = std::min(screening.first->delta_aicc, screening.second->delta_aicc);
  const RefitOverLaws seen =
      screen_over_laws(screening.both, data, base.fitted.weights, screening.refit, base.laws);
  screening.delta_aicc = std::min(screening.delta_aicc, seen.criterion - base.criterion);
}

/// Reads the screening from the kept rows, or computes it.
void kept_screening(const SearchBase& base, std::size_t k, Screening& screening) {
  const std::vector<std::string> names = names_of(screening);
  screening.both = make_candidate(base.spec, base.datasets, names, false, true);
  const auto make = [&] {
    screen(base, screening);
    return std::pair(screening.refit, screening.delta_aicc);
  };
  const auto write = [&](const auto& seen) {
    return Json::array({names, json_of(seen.first), row_json({seen.second})});
  };
  const auto read = [&](const Json& row) {
    require_names(row, names);
    return std::pair(refit_of(row.at(1), screening.both, base.fitted.data.points.size()),
                     row_numbers(row.at(2)).at(0));
  };
  std::tie(screening.refit, screening.delta_aicc) = kept_or_made(
      base.options.kept.get(), number_of(base.options, KeptPiece::screening, k), make, write, read);
}

/// Which pairs are followed. A pair that is further behind at the screening does not become one of
/// the best: of 460 pairs for wall1990-molybdenum and wall1990-silicon, the later steps improved
/// none by more than a third of its change of the criterion, and none of the best ten by more than
/// a twentieth.
std::vector<bool> worth_following(const std::vector<Screening>& screenings) {
  std::vector<std::size_t> order(screenings.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // Of pairs that gain no more than one of the two alone, the lower deviance is first.
  std::ranges::stable_sort(order, {}, [&](std::size_t k) {
    return std::pair(screenings[k].delta_aicc, screenings[k].refit.chi2);
  });
  const double best = order.empty() ? 0.0 : std::min(0.0, screenings[order.front()].delta_aicc);
  const double worth = best + std::max(followed_within, followed_part * -best);
  std::vector<bool> followed(screenings.size(), false);
  for (std::size_t rank = 0; rank < std::min(order.size(), most_followed); ++rank) {
    followed[order[rank]] = screenings[order[rank]].delta_aicc <= worth;
  }
  return followed;
}

/// The final result of a pair.
CandidateResult try_both(const SearchBase& base, Screening screening, bool follow) {
  const CandidateResult& first = *screening.first;
  const CandidateResult& second = *screening.second;
  const Observations& data = base.fitted.data;
  const auto over_laws = follow ? refit_over_laws : screen_over_laws;
  RefitOverLaws over =
      over_laws(screening.both, data, base.fitted.weights, screening.refit, base.laws);
  CandidateResult result =
      examine(base, std::move(screening.both), std::move(over), screening.refit.theta);
  if (follow) try_released(base, result, tries_in_pairs);
  find_remaining_p(base, result);
  if (!follow) {
    result.set_aside = SetAside::far_behind;
    return result;
  }
  // Each of the two must contribute.
  const double better = std::min(first.delta_aicc, second.delta_aicc);
  const bool possible = first.delta_aicc < second.delta_aicc ? first.plausible : second.plausible;
  if (possible && !(result.delta_aicc < better - base.options.margin_in_pairs)) {
    result.set_aside = SetAside::one_suffices;
  }
  const double better_part = std::min(first.remaining_part, second.remaining_part);
  if (result.remaining_p < tolerated_level && better_part - result.remaining_part < carried_part) {
    result.set_aside = SetAside::second_adds_little;
  }
  if (rests_on_limit(result)) result.set_aside = SetAside::at_limit;
  return result;
}

}  // namespace

std::uint64_t number_of(const DiagnosisOptions& options, KeptPiece kind, std::size_t k) {
  constexpr std::uint64_t kinds = 4;
  constexpr std::uint64_t of_each = std::uint64_t{1} << 32;
  return ((options.first_piece + 1) * kinds + static_cast<std::uint64_t>(kind)) * of_each + k;
}

bool can_be_seen(const SearchBase& base, const Candidate& candidate) {
  const Observations& data = base.fitted.data;
  if (!base.fitted.weights.noise.known) return false;
  const std::vector<const Mechanism*> added = chain_of(candidate.added);
  const bool batch = std::ranges::any_of(added, &Mechanism::is_batch);
  const bool by_series =
      std::ranges::any_of(added, [](const Mechanism* m) { return can_differ_between_series(*m); });
  std::set<std::pair<std::size_t, std::size_t>> series;
  std::set<std::tuple<std::size_t, std::size_t, double, double>> impacts;
  int two_values = 0;  // points with both rebounds and captures give two values
  for (const Observation& point : data.points) {
    series.insert({point.dataset, point.series});
    impacts.insert({point.dataset, by_series ? point.series : 0, point.diameter, point.velocity});
    if (point.mixed()) ++two_values;
  }
  if (batch && series.size() < 2) return false;
  const auto& moving = base.refit.moving;
  const auto before = static_cast<int>(std::ranges::count(moving, true));
  const int own = candidate.free_count - base.candidate.free_count;
  const int known = static_cast<int>(impacts.size()) + two_values;
  return known >= before + std::max(own, 1);
}

CandidateResult try_one(const SearchBase& base, Candidate candidate, std::span<const double> near,
                        int tries) {
  const Observations& data = base.fitted.data;
  const Weights& weights = base.fitted.weights;
  const Refit exact = base.exact_fits->of(candidate, near, tries, [&] {
    return refit_candidate(candidate, data, weights, near, tries);
  });
  RefitOverLaws over = exact.usable && vanishes(candidate, exact)
                           ? as_the_base(base, candidate, exact)
                           : refit_over_laws(candidate, data, weights, exact, base.laws);
  return examine(base, std::move(candidate), std::move(over), exact.theta);
}

std::vector<CandidateResult> try_singles(const SearchBase& base) {
  std::vector<const Mechanism*> untried;
  for (const Mechanism* mechanism : mechanisms_that_may_act(base.spec, base.candidate.model)) {
    // The base model already has a spread of the impacts from the counts of captures.
    if (mechanism->spreads() && base.fitted.weights.noise.event_spread > 0.0) continue;
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

std::vector<CandidateResult> try_pairs(const SearchBase& base,
                                       const std::vector<CandidateResult>& singles) {
  std::vector<const CandidateResult*> causes;
  for (const CandidateResult& single : singles) {
    if (single.kind == MechanismKind::description) continue;
    if (only_mechanism(single).is_batch() && series_are_sizes(base.fitted.data)) continue;
    causes.push_back(&single);
  }
  std::vector<Screening> screenings;
  for (std::size_t a = 0; a < causes.size(); ++a) {
    for (std::size_t b = a + 1; b < causes.size(); ++b) {
      const MechanismInfo &one = only_mechanism(*causes[a]).info,
                          &other = only_mechanism(*causes[b]).info;
      if (one.not_with == other.id || other.not_with == one.id) continue;
      if (only_mechanism(*causes[a]).spreads() && only_mechanism(*causes[b]).spreads()) continue;
      screenings.push_back({causes[a], causes[b], {}, {}});
    }
  }
  Progress progress("pairs of causes", 2 * screenings.size());
  parallel_over(screenings.size(), base.options.threads, [&](std::size_t k) {
    kept_screening(base, k, screenings[k]);
    progress.advance();
  });
  const std::vector<bool> followed = worth_following(screenings);
  std::vector<CandidateResult> results(screenings.size());
  parallel_over(screenings.size(), base.options.threads, [&](std::size_t k) {
    results[k] = kept_candidate(base, KeptPiece::pair, k, names_of(screenings[k]), [&] {
      return try_both(base, std::move(screenings[k]), followed[k]);
    });
    progress.advance();
  });
  sort_by_criterion(results);
  return results;
}

}  // namespace recoil
