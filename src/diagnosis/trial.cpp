#include "diagnosis/trial.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "core/parallel.hpp"
#include "diagnosis/judge.hpp"
#include "diagnosis/law_errors.hpp"
#include "estimate/observation.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {

std::size_t number_of(const DiagnosisOptions& options, KeptPiece kind, std::size_t k) {
  constexpr std::size_t kinds = 4;
  constexpr std::size_t of_each = std::size_t{1} << 32;
  return ((options.first_piece + 1) * kinds + static_cast<std::size_t>(kind)) * of_each + k;
}

Json json_of(const Refit& refit) { return as_json(refit, NonFinite::word); }

Refit refit_of(const Json& json, const Candidate& candidate, std::size_t points) {
  Refit refit = value_from<Refit>(json);
  const std::size_t p = candidate.model.slots.size();
  if (refit.usable && (refit.theta.size() != p || refit.moving.size() != p ||
                       refit.residuals.size() != points || refit.jacobian.size() < points * p)) {
    throw std::length_error("a refit of something else");
  }
  return refit;
}

void require_names(const Json& row, const std::vector<std::string>& names) {
  if (row.at(0).get<std::vector<std::string>>() != names) {
    throw std::invalid_argument("a row of something else");
  }
}
namespace {

constexpr double worth_releasing = 2.0;  // least gain of the criterion by released parameters

MechanismKind kind_of(const std::vector<std::string>& ids) {
  MechanismKind kind = MechanismKind::measurement;
  for (const Mechanism* mechanism : chain_of(ids)) {
    if (mechanism->info.kind == MechanismKind::description) return MechanismKind::description;
    if (mechanism->info.kind == MechanismKind::physics) kind = MechanismKind::physics;
  }
  return kind;
}

std::vector<double> predicted_squares(const Candidate& candidate, const Refit& refit,
                                      const Observations& data) {
  std::vector<double> squares;
  for (const Prediction& at : predict(candidate.model, refit.theta, data.conditions(), false)) {
    squares.push_back(at.restitution_squared);
  }
  return squares;
}

/// See `CandidateResult::remaining_part`.
double part_left(const SearchBase& base, const CandidateResult& candidate) {
  if (!base.fitted.data.noise.sd_stated) return 1.0;  // the size of the misfit is unknown
  const auto n = static_cast<double>(base.fitted.data.points.size());
  const double before = base.refit.chi2 - (n - base.candidate.free_count);
  const double after = candidate.refit.chi2 - (n - candidate.candidate.free_count);
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
bool knows_series(const Mechanism& mechanism) {
  const auto& parameters = mechanism.info.parameters;
  return std::ranges::any_of(
      parameters, [](const Parameter& p) { return p.per_series || !p.stated_by.empty(); });
}

std::size_t series_count(const Observations& data) {
  std::set<std::pair<std::size_t, std::size_t>> series;
  for (const Observation& point : data.points) series.insert({point.dataset, point.series});
  return series.size();
}

bool can_be_released(const Candidate& candidate) {
  return std::ranges::any_of(candidate.model.slots, [&](const ParameterSlot& slot) {
    return !slot.free && !slot.stated && slot.parameter->searched && candidate.adds(slot);
  });
}

}  // namespace

bool can_be_seen(const SearchBase& base, const Candidate& candidate) {
  const Observations& data = base.fitted.data;
  if (!data.noise.known) return false;
  const std::vector<const Mechanism*> added = chain_of(candidate.added);
  const bool batch = std::ranges::any_of(added, &Mechanism::is_batch);
  if (batch && series_count(data) < 2) return false;  // a batch effect needs at least two series
  const bool by_series =
      std::ranges::any_of(added, [](const Mechanism* m) { return knows_series(*m); });
  std::set<std::tuple<std::size_t, std::size_t, double, double>> impacts;
  int says_more = 0;  // points with both rebounds and captures give two values
  for (const Observation& point : data.points) {
    impacts.insert({point.dataset, by_series ? point.series : 0, point.diameter, point.velocity});
    if (point.mixed()) ++says_more;
  }
  const auto& moving = base.refit.moving;
  const auto before = static_cast<int>(std::ranges::count(moving, true));
  const int own = candidate.free_count - base.candidate.free_count;
  const int known = static_cast<int>(impacts.size()) + says_more;
  return known >= before + std::max(own, 1);
}

CandidateResult examine(const SearchBase& base, Candidate candidate, Refit refit) {
  const Observations& data = base.fitted.data;
  CandidateResult result = described(base, std::move(candidate), std::move(refit), 0.0);
  if (!result.refit.usable) return result;
  result.delta_aicc =
      corrected_criterion(data, result.refit, result.candidate.free_count) - base.criterion;
  result.remaining_part = part_left(base, result);
  return result;
}

void find_what_is_left(const SearchBase& base, CandidateResult& result) {
  if (!result.refit.usable) return;
  const Observations& data = base.fitted.data;
  const std::vector<double> squares = predicted_squares(result.candidate, result.refit, data);
  result.remaining_p = quick_structure(data, result.refit, squares, base.noise).p_value;
}

CandidateResult try_one(const SearchBase& base, Candidate candidate, std::span<const double> near,
                        int tries) {
  Refit refit =
      with_law_errors(candidate, base.fitted.data,
                      refit_candidate(candidate, base.fitted.data, near, tries), base.laws);
  return examine(base, std::move(candidate), std::move(refit));
}

void try_released(const SearchBase& base, CandidateResult& result, int tries) {
  if (!result.refit.usable || !can_be_released(result.candidate)) return;
  // An implausible single cause is kept, so that it can be reported.
  const bool pair = result.candidate.added.size() > 1;
  Candidate released = make_candidate(base.spec, base.datasets, result.candidate.added, true, pair);
  if (!can_be_seen(base, released)) return;
  const std::vector<double> near = within_bounds(
      released.model, carried_over(result.candidate.model, result.refit.theta, released.model));
  CandidateResult other = try_one(base, std::move(released), near, tries);
  if (other.refit.usable && other.delta_aicc < result.delta_aicc - worth_releasing) {
    result = std::move(other);
  }
}

void judge_possible_values(const SearchBase& base, CandidateResult& result, int tries) {
  if (!result.refit.usable || !result.only_by_error) return;
  Candidate held = make_candidate(base.spec, base.datasets, result.candidate.added,
                                  result.candidate.released, true);
  const std::vector<double> near = within_bounds(
      held.model, carried_over(result.candidate.model, result.refit.theta, held.model));
  const CandidateResult possible = try_one(base, std::move(held), near, tries);
  if (!possible.refit.usable) return;
  result.cost_of_possible = possible.delta_aicc - result.delta_aicc;
  find_parameters(base, result);
}

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

std::vector<double> within_bounds(const ImpactModel& model, std::vector<double> theta) {
  for (std::size_t j = 0; j < theta.size(); ++j) {
    const ParameterSlot& slot = model.slots[j];
    if (slot.free) theta[j] = std::clamp(theta[j], slot.lower, slot.upper);
  }
  return theta;
}

void sort_by_criterion(std::vector<CandidateResult>& candidates) {
  std::erase_if(candidates, [](const CandidateResult& c) { return !c.refit.usable; });
  std::ranges::stable_sort(candidates, [](const CandidateResult& a, const CandidateResult& b) {
    return a.delta_aicc < b.delta_aicc;
  });
}

namespace {

constexpr int tries_alone = 4;

// Least effect, in standard deviations of the most affected point.
constexpr double least_effect = 0.01;

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

/// Fits one mechanism of the catalogue; the refit is not usable if it cannot be fitted.
CandidateResult try_single(const SearchBase& base, const Mechanism& mechanism,
                           Candidate candidate) {
  if (candidate.free_count >= static_cast<int>(base.fitted.data.points.size()) - 1) return {};
  const std::vector<PointConditions>& impacts = candidate.impacts;
  if (std::ranges::all_of(impacts, [&](const PointConditions& at) {
        return is_taken_away(candidate.model, mechanism, at);
      })) {
    return {};
  }
  const std::vector<double> near =
      carried_over(base.candidate.model, base.refit.theta, candidate.model);
  if (!can_be_seen(base, candidate) || !can_matter(base, mechanism, candidate, near)) return {};
  CandidateResult result = try_one(base, std::move(candidate), near, tries_alone);
  try_released(base, result, tries_alone);
  judge_possible_values(base, result, tries_alone);
  find_what_is_left(base, result);
  return result;
}

}  // namespace

std::vector<CandidateResult> try_singles(const SearchBase& base) {
  std::vector<const Mechanism*> untried;
  for (const Mechanism* mechanism : mechanisms_that_may_act(base.spec, base.candidate.model)) {
    // The base model already has a spread of the impacts from the counts of captures.
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
