#include "diagnosis/trial.hpp"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "diagnosis/law_errors.hpp"
#include "diagnosis/plausibility.hpp"
#include "estimate/observation.hpp"
#include "estimate/predictor.hpp"
#include "mechanism/catalogue.hpp"

namespace recoil {
namespace {

constexpr double worth_releasing = 2.0;  // gain of the criterion by a released parameter

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
  if (!base.fitted.data.sd_stated) return 1.0;  // nobody knows how much misfit there is
  const auto n = static_cast<double>(base.fitted.data.points.size());
  const double before = base.refit.chi2 - (n - base.candidate.free_count);
  const double after = candidate.refit.chi2 - (n - candidate.candidate.free_count);
  return before > 0.0 ? after / before : 1.0;
}

bool all_plausible(const std::vector<FoundParameter>& parameters) {
  return std::all_of(parameters.begin(), parameters.end(),
                     [](const FoundParameter& p) { return p.plausible(); });
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
  result.near_plausible = std::all_of(result.parameters.begin(), result.parameters.end(),
                                      [](const FoundParameter& p) { return p.near_plausible; });
}

/// What a fitted candidate is, `cost_of_possible` being known.
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

/// Does the mechanism act otherwise in one series than in another?
bool knows_series(const Mechanism& mechanism) {
  const auto& parameters = mechanism.info.parameters;
  return std::any_of(parameters.begin(), parameters.end(),
                     [](const Parameter& p) { return p.per_series || !p.stated_by.empty(); });
}

std::size_t series_count(const Observations& data) {
  std::set<std::pair<std::size_t, std::size_t>> series;
  for (const Observation& point : data.points) series.insert({point.dataset, point.series});
  return series.size();
}

bool can_be_released(const Candidate& candidate) {
  return std::any_of(
      candidate.model.slots.begin(), candidate.model.slots.end(), [&](const ParameterSlot& slot) {
        return !slot.free && !slot.stated && slot.parameter->searched && candidate.adds(slot);
      });
}

}  // namespace

bool can_be_seen(const SearchBase& base, const Candidate& candidate) {
  const Observations& data = base.fitted.data;
  if (!data.noise.known) return false;
  const std::vector<const Mechanism*> added = chain_of(candidate.added);
  const bool batch =
      std::any_of(added.begin(), added.end(), [](const Mechanism* m) { return m->is_batch(); });
  if (batch && series_count(data) < 2) return false;  // series differ from other series
  const bool by_series =
      std::any_of(added.begin(), added.end(), [](const Mechanism* m) { return knows_series(*m); });
  std::set<std::tuple<std::size_t, std::size_t, double, double>> impacts;
  int says_more = 0;  // points with both rebounds and captures say two things
  for (const Observation& point : data.points) {
    impacts.insert({point.dataset, by_series ? point.series : 0, point.diameter, point.velocity});
    if (point.mixed()) ++says_more;
  }
  const auto& moving = base.refit.moving;
  const auto before = static_cast<int>(std::count(moving.begin(), moving.end(), true));
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
  const std::vector<double> squares = predicted_squares(result.candidate, result.refit, data);
  result.remaining_p =
      quick_structure(data, result.refit, squares, quick_samples, base.options.seed).p_value;
  result.remaining_part = part_left(base, result);
  return result;
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
  // A single one may want to be what it cannot be, and is to say so.
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

void hold_to_what_is_possible(const SearchBase& base, CandidateResult& result, int tries) {
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
  // A row carries its names: numbers follow the order of the criterion.
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
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const CandidateResult& a, const CandidateResult& b) {
                     return a.delta_aicc < b.delta_aicc;
                   });
}

}  // namespace recoil
