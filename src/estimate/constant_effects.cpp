#include "estimate/constant_effects.hpp"

namespace recoil {

std::vector<std::vector<double>> constant_effects(const ImpactModel& model,
                                                  const LeastSquaresResult& run,
                                                  std::size_t points) {
  std::vector<std::vector<double>> effects;
  if (model.adjusts_constants() || run.covariance.empty()) return effects;
  const std::size_t p = run.theta.size();
  for (std::size_t k = 0; k < model.constants.size(); ++k) {
    const std::size_t own = model.first_constant() + k;
    const double sd = 1.0 / model.constants[k].deviation_slope(run.theta[own]);
    std::vector<double> pull(p, 0.0);  // J'J_c
    for (std::size_t i = 0; i < points; ++i) {
      const double* row = &run.jacobian[i * p];
      for (std::size_t j = 0; j < p; ++j) pull[j] += row[j] * row[own];
    }
    std::vector<double> effect(p, 0.0);
    for (std::size_t a = 0; a < p; ++a) {
      for (std::size_t b = 0; b < p; ++b) effect[a] -= run.covariance[a * p + b] * pull[b] * sd;
    }
    effect[own] = sd;
    effects.push_back(std::move(effect));
  }
  return effects;
}

void add_constant_effects(const std::vector<std::vector<double>>& effects,
                          std::vector<double>& covariance, double sign) {
  for (const std::vector<double>& effect : effects) {
    const std::size_t p = effect.size();
    for (std::size_t a = 0; a < p && !covariance.empty(); ++a) {
      for (std::size_t b = 0; b < p; ++b) covariance[a * p + b] += sign * effect[a] * effect[b];
    }
  }
}

}  // namespace recoil
