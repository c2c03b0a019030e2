#include "diagnosis/expected_effects.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/search.hpp"
#include "estimate/predictor.hpp"

namespace recoil {
namespace {

void add_effects(const SearchBase& base, const Mechanism& mechanism,
                 std::vector<ExpectedEffect>& all) {
  const Candidate candidate =
      make_candidate(base.spec, base.datasets, {std::string(mechanism.info.id)});
  const ImpactModel& model = candidate.model;
  const std::vector<double> with = carried_over(base.candidate.model, base.refit.theta, model);
  const std::vector<double> without = without_mechanism(model, with, mechanism);
  const std::vector<Prediction> acted = predict(model, with, candidate.impacts, false);
  const std::vector<Prediction> plain = predict(model, without, candidate.impacts, false);
  for (std::size_t d = 0; d < base.datasets.size(); ++d) {
    std::optional<ExpectedEffect> most;
    for (std::size_t i = 0; i < candidate.impacts.size(); ++i) {
      const PointConditions& at = candidate.impacts[i];
      if (at.dataset != d || !acted[i].usable() || !plain[i].usable()) continue;
      const ParameterSlot& strength = strength_at(model, mechanism, at);
      if (!strength.stated || strength.initial == strength.parameter->null_value) continue;
      const double change = acted[i].restitution() - plain[i].restitution();
      if (most && std::abs(change) <= std::abs(most->change)) continue;
      const Condition condition = *strength.stated;
      most = {std::string(mechanism.info.id),
              d,
              condition,
              conditions_of(base.datasets[d], at.series).of(condition).value_or(0.0),
              at.diameter,
              at.velocity,
              change};
    }
    if (most) all.push_back(*most);
  }
}

}  // namespace

std::vector<ExpectedEffect> expected_effects(const SearchBase& base) {
  std::vector<ExpectedEffect> all;
  for (const Mechanism* mechanism : mechanisms_that_may_act(base.spec, base.candidate.model)) {
    const std::vector<Parameter>& parameters = mechanism->info.parameters;
    if (parameters.empty() || parameters.front().stated_by.empty()) continue;
    add_effects(base, *mechanism, all);
  }
  std::ranges::stable_sort(all, [](const ExpectedEffect& a, const ExpectedEffect& b) {
    return std::abs(a.change) > std::abs(b.change);
  });
  return all;
}

}  // namespace recoil
