#include "diagnosis/judge.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/batches.hpp"
#include "diagnosis/plausibility.hpp"
#include "diagnosis/reading_step.hpp"
#include "mechanism/catalogue.hpp"

namespace recoil {
namespace {

/// Is the parameter an error of a height, a length that only what falls from heights can have?
bool is_height(const Parameter& parameter) {
  const Mechanism* const mechanism = parameter.mechanism;
  return mechanism != nullptr && parameter.unit == "m" &&
         mechanism->info.kind == MechanismKind::measurement &&
         mechanism->info.methods == std::vector<Method>{Method::drop_heights};
}

/// Is it an error of a height which the rounding of the heights may make?
bool within_a_step(const SearchBase& base, const CandidateResult& c) {
  const std::vector<double> errors = standard_errors(c.refit, base.noise_scale);
  for (std::size_t j = 0; j < c.refit.theta.size(); ++j) {
    const ParameterSlot& slot = c.candidate.model.slots[j];
    if (!is_height(*slot.parameter) || !c.candidate.adds(slot)) continue;
    const double least = std::abs(c.refit.theta[j]) - allowed_errors * errors[j];
    const double step = height_step(base.datasets);
    if (step > 0.0 && least <= 0.5 * step) return true;
  }
  return false;
}

std::optional<SetAside> reason_against(const SearchBase& base, const CandidateResult& c) {
  if (c.kind == MechanismKind::description) return SetAside::description;
  if (!(c.delta_aicc < 0.0)) return SetAside::gains_too_little;
  if (c.p_value && *c.p_value > base.options.chance) return SetAside::chance;
  if (c.candidate.added.size() == 1 && find_mechanism(c.candidate.added.front())->is_batch() &&
      batch_is_size(base.fitted.data, c, base.noise_scale)) {
    return SetAside::batch_is_size;
  }
  if (!c.plausible) return SetAside::not_possible;
  if (within_a_step(base, c)) return SetAside::within_a_step;
  if (c.remaining_p < tolerated_level) return SetAside::leaves_structure;
  return std::nullopt;
}

}  // namespace

void judge(const SearchBase& base, std::vector<CandidateResult>& candidates, double reach,
           const std::vector<Fold>& folds) {
  std::optional<std::vector<FoldPrediction>> base_folds;  // found where something explains
  const auto hold_out = [&](CandidateResult& c) {
    if (!base_folds) {
      base_folds = predict_folds(base.candidate, base.fitted.data, base.laws, folds,
                                 base.refit.theta, base.options.threads);
    }
    const std::vector<FoldPrediction> own = predict_folds(
        c.candidate, base.fitted.data, base.laws, folds, c.refit.theta, base.options.threads);
    c.gain = held_out_gain(folds, *base_folds, own, base.options.seed);
    if (c.explains() && c.gain->decisive && !(c.gain->log_score > 0.0)) {
      c.set_aside = SetAside::predicts_no_better;
    }
  };
  for (CandidateResult& c : candidates) {
    if (c.explains()) c.set_aside = reason_against(base, c);
  }
  double best = INFINITY;  // of those that explain
  for (CandidateResult& c : candidates) {
    if (!c.explains() || c.delta_aicc > best + reach) continue;
    hold_out(c);
    if (c.explains()) best = std::min(best, c.delta_aicc);
  }
}

}  // namespace recoil
