#include "diagnosis/diagnosis_result.hpp"

#include <algorithm>
#include <cmath>

#include "estimate/restitution_summary.hpp"

namespace recoil {

bool has_one_size(const Observations& data) {
  constexpr double size_factor = 1.2;
  double low = INFINITY, high = 0.0;
  for (const Observation& point : data.points) {
    low = std::min(low, point.diameter);
    high = std::max(high, point.diameter);
  }
  return high < low * size_factor;
}

bool tests_the_curve(const Diagnosis& diagnosis) {
  const auto& tests = diagnosis.structure.tests;
  return std::any_of(tests.begin(), tests.end(), [](const StructureTest& test) {
    return test.question != StructureQuestion::scatter;
  });
}

bool series_differ(const Diagnosis& diagnosis) {
  constexpr double level = 0.01;
  if (diagnosis.verdict != Verdict::unexplained || !diagnosis.resembles.empty()) return false;
  if (!has_one_size(diagnosis.base.data)) return false;
  return summarise_restitution(diagnosis.datasets).series.p_value.value_or(1.0) < level;
}

bool simulations_failed(const Structure& structure) {
  return structure.failed > 0.01 * (structure.simulated + structure.failed);
}

const MisfitCell* worst_cell(const Diagnosis& diagnosis) {
  const auto& where = diagnosis.where;
  const auto worst =
      std::max_element(where.begin(), where.end(), [](const MisfitCell& a, const MisfitCell& b) {
        return std::abs(a.standardised) < std::abs(b.standardised);
      });
  return worst == where.end() || std::abs(worst->standardised) < 2.0 ? nullptr : &*worst;
}

std::optional<std::size_t> dominant_point(const Diagnosis& diagnosis) {
  constexpr double most = 0.5;
  const auto& residuals = diagnosis.base.residuals;
  const auto worst = std::max_element(residuals.begin(), residuals.end(),
                                      [](double a, double b) { return std::abs(a) < std::abs(b); });
  if (worst == residuals.end() || *worst * *worst < most * diagnosis.base.chi2) return std::nullopt;
  return static_cast<std::size_t>(worst - residuals.begin());
}

Evidence evidence_for(const Diagnosis& diagnosis) {
  const auto& points = diagnosis.base.data.points;
  const auto& slots = diagnosis.base.model.slots;
  return {static_cast<int>(std::count_if(points.begin(), points.end(),
                                         [](const Observation& p) { return !p.censored; })),
          static_cast<int>(std::count_if(slots.begin(), slots.end(),
                                         [](const ParameterSlot& slot) { return slot.free; }))};
}

const CandidateResult* closest_cause(const Diagnosis& diagnosis) {
  constexpr double nearly_all = 0.2;
  const auto& candidates = diagnosis.candidates;
  const auto closest =
      std::find_if(candidates.begin(), candidates.end(), [](const CandidateResult& c) {
        return c.plausible && c.kind != MechanismKind::description && c.delta_aicc < 0.0 &&
               c.remaining_part < nearly_all && c.remaining_p < tolerated_level;
      });
  return closest == candidates.end() ? nullptr : &*closest;
}

std::vector<UnstatedErrors> rival_errors(const Diagnosis& diagnosis) {
  const auto& extended = diagnosis.extended;
  std::vector<UnstatedErrors> rivals;
  for (const UnstatedErrors& errors : diagnosis.unstated) {
    const bool close =
        !extended || errors.delta_aicc < extended->delta_aicc + diagnosis.options.margin;
    const bool two_for_one = extended && extended->candidate.added.size() > 1;
    if (errors.leave_nothing() && (close || two_for_one)) rivals.push_back(errors);
  }
  return rivals;
}

}  // namespace recoil
