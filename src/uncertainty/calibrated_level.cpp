#include "uncertainty/calibrated_level.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/statistics.hpp"
#include "uncertainty/capture_interval.hpp"
#include "uncertainty/profile.hpp"
#include "uncertainty/resample.hpp"

namespace recoil {
namespace {

/// The alternative below whose cumulated weight `uniform` falls.
std::size_t alternative_at(const std::vector<NoiseAlternative>& alternatives, double uniform) {
  double below = 0.0;
  for (std::size_t k = 0; k + 1 < alternatives.size(); ++k) {
    below += alternatives[k].weight;
    if (uniform < below) return k;
  }
  return alternatives.size() - 1;
}

/// The levels at which the intervals of one simulated data set just contain its truth [slots, then
/// capture velocities]; NaN where there is no interval; empty without a fit.
std::vector<double> levels_of(const std::vector<NoiseAlternative>& alternatives,
                              const std::vector<ResamplingPlan>& plans,
                              const std::vector<CaptureEstimate>& capture, std::uint64_t seed,
                              std::uint64_t index) {
  RandomStream random(seed, RandomPurpose::calibration, index);
  const std::size_t k = alternative_at(alternatives, random.uniform());
  const FitResult& truth = alternatives[k].fitted;
  Observations sample = alternatives.front().fitted.data;
  resample(plans[k], seed, index, sample);
  const FitResult fitted =
      fit(truth.model, sample, {.several_starts = false, .start = truth.theta, .minimiser = {}});
  if (!fitted.usable) return {};
  std::vector<double> levels(truth.theta.size(), NAN);
  for (std::size_t j = 0; j < levels.size(); ++j) {
    if (truth.model.slots[j].free) levels[j] = profile_level(fitted, j, truth.theta[j]);
  }
  const std::vector<NoiseAlternative> own = noise_alternatives(fitted);
  for (const CaptureEstimate& at : capture) {
    levels.push_back(at.found ? capture_level(own, at, truth) : NAN);
  }
  return levels;
}

}  // namespace

CalibratedLevels calibrate_levels(const std::vector<NoiseAlternative>& alternatives,
                                  const std::vector<CaptureEstimate>& capture,
                                  const CalibrationOptions& options) {
  std::vector<ResamplingPlan> plans;
  for (const NoiseAlternative& alternative : alternatives) {
    plans.push_back(plan_resampling(alternative.fitted, Scheme::parametric));
  }
  std::vector<std::vector<double>> rows(static_cast<std::size_t>(options.simulations));
  parallel_over(rows.size(), options.threads, [&](std::size_t i) {
    rows[i] = levels_of(alternatives, plans, capture, options.seed, i);
  });
  const std::size_t slots = alternatives.front().fitted.theta.size();
  CalibratedLevels result;
  for (const auto& row : rows) result.failed += row.empty() ? 1 : 0;
  for (std::size_t q = 0; q < slots + capture.size(); ++q) {
    std::vector<double> levels;
    for (const auto& row : rows) {
      if (q < row.size() && std::isfinite(row[q])) levels.push_back(row[q]);
    }
    std::sort(levels.begin(), levels.end());
    const bool enough = 2 * levels.size() > rows.size();
    (q < slots ? result.parameters : result.capture)
        .push_back(enough ? sorted_quantile(levels, options.level) : NAN);
  }
  return result;
}

}  // namespace recoil
