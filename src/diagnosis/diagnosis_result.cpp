#include "diagnosis/diagnosis_result.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "estimate/residual.hpp"
#include "estimate/restitution_summary.hpp"

namespace recoil {

Verdict Diagnosis::verdict() const {
  if (answer_if<Adequate>()) return Verdict::adequate;
  if (answer_if<CauseNamed>()) return Verdict::cause_named;
  return answer_if<NotSeparable>() ? Verdict::not_separable : Verdict::unexplained;
}

std::vector<std::string> Diagnosis::named() const {
  const auto* one = answer_if<CauseNamed>();
  return one ? one->extended.cause.candidate.added : std::vector<std::string>();
}

std::vector<std::string> Diagnosis::rivals() const {
  const auto* several = answer_if<NotSeparable>();
  return several ? several->rivals : std::vector<std::string>();
}

std::vector<std::string> Diagnosis::resembles() const {
  const auto* shape = answer_if<Resembles>();
  return shape ? shape->causes : std::vector<std::string>();
}

std::vector<std::string> Diagnosis::causes() const {
  if (answer_if<CauseNamed>()) return named();
  return answer_if<NotSeparable>() ? rivals() : resembles();
}

const ExtendedModel* Diagnosis::extended() const {
  if (const auto* one = answer_if<CauseNamed>()) return &one->extended;
  const auto* several = answer_if<NotSeparable>();
  return several ? &several->extended : nullptr;
}

const HeldOutGain* Diagnosis::gain() const {
  const ExtendedModel* const model = extended();
  return model && model->fit && model->cause.gain ? &*model->cause.gain : nullptr;
}

std::vector<MisfitCell> misfit_map(const FitResult& fitted) {
  constexpr int bands = 4;
  const std::vector<Observation>& points = fitted.data.points;
  const auto [slow, fast] = std::ranges::minmax_element(points, {}, &Observation::velocity);
  const double low = slow->velocity;
  const double width = std::log(fast->velocity / low) / bands;
  std::map<std::tuple<std::size_t, double, int>, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int band =
        width > 0.0
            ? std::min(bands - 1, static_cast<int>(std::log(points[i].velocity / low) / width))
            : 0;
    cells[{points[i].dataset, points[i].diameter, band}].push_back(i);
  }
  std::vector<MisfitCell> map;
  for (const auto& [key, members] : cells) {
    MisfitCell cell;
    cell.dataset = std::get<0>(key);
    cell.diameter = std::get<1>(key);
    cell.points = static_cast<int>(members.size());
    cell.slowest = INFINITY;
    const ContactProperties& contact = fitted.model.contacts[cell.dataset];
    const double mass = contact.reduced_mass(cell.diameter, contact.particle_density);
    double weights = 0.0, weighted = 0.0;
    for (const std::size_t i : members) {
      const Observation& point = points[i];
      const PointWeights& own = fitted.weights.points[i];
      const double expected = expected_restitution(point, own, fitted.prediction_squared[i]);
      const double measured = point.counts_only() ? expected
                              : point.censored    ? 0.0
                                                  : point.restitution;
      const double miss = measured - expected;
      cell.slowest = std::min(cell.slowest, point.velocity);
      cell.fastest = std::max(cell.fastest, point.velocity);
      cell.restitution += miss / cell.points;
      cell.energy += 0.5 * mass * point.velocity * point.velocity *
                     (measured * measured - expected * expected) / cell.points;
      if (point.censored || !(own.sd > 0.0)) continue;
      weights += 1.0 / (own.sd * own.sd);
      weighted += miss / (own.sd * own.sd);
    }
    if (weights > 0.0) cell.standardised = weighted / std::sqrt(weights);
    map.push_back(cell);
  }
  return map;
}

bool has_one_size(const Observations& data) {
  constexpr double size_factor = 1.2;
  const auto [small, large] = std::ranges::minmax_element(data.points, {}, &Observation::diameter);
  return large->diameter < small->diameter * size_factor;
}

bool tests_the_curve(const Diagnosis& diagnosis) {
  const auto& tests = diagnosis.structure.tests;
  return std::ranges::any_of(
      tests, [](const StructureTest& test) { return test.question != StructureQuestion::scatter; });
}

bool series_differ(const Diagnosis& diagnosis) {
  constexpr double level = 0.01;
  if (diagnosis.verdict() != Verdict::unexplained || diagnosis.answer_if<Resembles>()) return false;
  if (!has_one_size(diagnosis.base.data)) return false;
  return summarise_restitution(diagnosis.datasets).series.p_value.value_or(1.0) < level;
}

bool repeats_scatter(const Diagnosis& diagnosis) {
  constexpr double level = 0.01;
  constexpr double one_velocity = 1.5;  // ratio of velocities over which e hardly changes
  if (diagnosis.verdict() != Verdict::unexplained || !has_one_size(diagnosis.base.data))
    return false;
  const RestitutionSummary summary = summarise_restitution(diagnosis.datasets);
  return summary.scatter && summary.scatter->p_value < level &&
         summary.velocities[1] < one_velocity * summary.velocities[0];
}

bool simulations_failed(const Structure& structure) {
  return structure.failed > 0.01 * (structure.simulated + structure.failed);
}

const MisfitCell* worst_cell(const Diagnosis& diagnosis) {
  const auto& where = diagnosis.where;
  const auto worst = std::ranges::max_element(
      where, {}, [](const MisfitCell& cell) { return std::abs(cell.standardised); });
  return worst == where.end() || std::abs(worst->standardised) < 2.0 ? nullptr : &*worst;
}

std::optional<std::size_t> dominant_point(const Diagnosis& diagnosis) {
  constexpr double most = 0.5;
  const auto& residuals = diagnosis.base.residuals;
  const auto worst = std::ranges::max_element(residuals, {}, [](double r) { return std::abs(r); });
  if (worst == residuals.end() || *worst * *worst < most * diagnosis.base.chi2) return std::nullopt;
  return static_cast<std::size_t>(worst - residuals.begin());
}

Evidence evidence_for(const Diagnosis& diagnosis) {
  const auto& points = diagnosis.base.data.points;
  const auto& slots = diagnosis.base.model.slots;
  return {static_cast<int>(
              std::ranges::count_if(points, [](const Observation& p) { return !p.censored; })),
          static_cast<int>(std::ranges::count_if(slots, &ParameterSlot::free))};
}

const CandidateResult* closest_cause(const Diagnosis& diagnosis) {
  constexpr double nearly_all = 0.2;
  const auto& candidates = diagnosis.candidates;
  const auto closest = std::ranges::find_if(candidates, [](const CandidateResult& c) {
    return c.plausible && c.kind != MechanismKind::description && c.delta_aicc < 0.0 &&
           c.remaining_part < nearly_all && c.remaining_p < tolerated_level;
  });
  return closest == candidates.end() ? nullptr : &*closest;
}

const CandidateResult* doubtful_cause(const Diagnosis& diagnosis) {
  for (const auto* candidates : {&diagnosis.candidates, &diagnosis.pairs}) {
    const auto found = std::ranges::find_if(*candidates, [](const CandidateResult& c) {
      return c.kind != MechanismKind::description && c.delta_aicc < 0.0 &&
             c.remaining_p >= tolerated_level;
    });
    if (found != candidates->end()) return &*found;
  }
  return nullptr;
}

std::vector<UnstatedErrors> rival_errors(const Diagnosis& diagnosis) {
  const ExtendedModel* const extended = diagnosis.extended();
  std::vector<UnstatedErrors> rivals;
  for (const UnstatedErrors& errors : diagnosis.unstated) {
    const bool close =
        !extended || errors.delta_aicc < extended->cause.delta_aicc + diagnosis.options.margin;
    const bool two_for_one = extended && extended->cause.candidate.added.size() > 1;
    if (errors.leave_nothing() && (close || two_for_one)) rivals.push_back(errors);
  }
  return rivals;
}

}  // namespace recoil
