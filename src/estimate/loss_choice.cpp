#include "estimate/loss_choice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "estimate/likelihood.hpp"
#include "estimate/observations.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

bool is_dry(const FitSpec& spec, const std::vector<Dataset>& datasets) {
  const ImpactModel model = make_model(spec, datasets);
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    if (!without_adhesion(model, d)) return false;
  }
  return true;
}

/// Does the file fix C_H? A fixed value is not compared with other laws.
bool holds_damping(const FitSpec& spec) {
  const ParameterSpec damping = spec.statement_of(base_parameters(spec.adhesion).front());
  return damping.mentioned && !damping.free;
}

// Laws whose criteria differ by less predict the same values, for example at a single velocity.
constexpr double same_criterion = 0.01;

}  // namespace

LossChoice choose_loss(const FitSpec& spec, const std::vector<Dataset>& datasets) {
  const std::string first(hunt_crossley);
  if (!spec.loss.empty() && spec.loss != "auto") return {spec, {}};
  const LossChoice as_stated = {with_loss(spec, first), {}};
  if (spec.loss.empty() && (holds_damping(spec) || !is_dry(spec, datasets))) return as_stated;
  const Observations data = gather(datasets, spec);
  const auto n = static_cast<double>(data.points.size());
  LossChoice choice;
  for (const std::string& loss : dry_losses()) {
    const Mechanism* const mechanism = dry_loss_mechanism(loss);
    if (mechanism != nullptr && !mechanism->works_with(spec.adhesion)) continue;
    const ImpactModel model = make_model(with_loss(spec, loss), datasets);
    if (mechanism != nullptr &&
        !std::all_of(model.surroundings.begin(), model.surroundings.end(),
                     [&](const Surroundings& at) { return mechanism->acts_at(at); })) {
      continue;
    }
    const FitResult fitted = fit(model, data);
    if (!fitted.usable || !fitted.flat.empty()) continue;
    if (!fitted.weights.noise.known) return as_stated;  // the fit passes through all points
    const std::optional<double> likelihood = minus_two_log_likelihood(fitted);
    if (!likelihood) return as_stated;
    const double k = model.free_count() + (data.noise.sd_stated ? 0 : 1);
    // The correction for few points; it is equal for laws with equally many parameters.
    const double correction = n > k + 1.0 ? 2.0 * k * (k + 1.0) / (n - k - 1.0) : 0.0;
    choice.laws.push_back({loss, *likelihood + 2.0 * k + correction});
  }
  if (choice.laws.empty()) return as_stated;
  double best = choice.laws.front().delta_aicc;
  for (const LossFit& law : choice.laws) best = std::min(best, law.delta_aicc);
  for (LossFit& law : choice.laws) {
    law.delta_aicc -= best;
    if (law.delta_aicc < same_criterion) law.delta_aicc = 0.0;
  }
  std::stable_sort(choice.laws.begin(), choice.laws.end(),
                   [](const LossFit& a, const LossFit& b) { return a.delta_aicc < b.delta_aicc; });
  choice.spec = with_loss(spec, choice.laws.front().id);
  return choice;
}

}  // namespace recoil
