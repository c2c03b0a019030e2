#include "estimate/judge_noise.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "estimate/reweighting.hpp"
#include "estimate/setting_error.hpp"

namespace recoil {
namespace {

// If the p-value of chi-squared under the stated noise is below this, every interval is widened.
constexpr double misfit_level = 0.01;
// Below this p-value the fit is called doubtful; chance may explain it.
constexpr double doubtful_level = 0.05;

}  // namespace

void judge_noise(FitResult& result, const Misfit& misfit) {
  result.dof = misfit.dof;
  result.p_value = misfit.p_value;
  const auto verdict = [&] {
    if (misfit.dof <= 0) return NoiseVerdict::unchecked;
    if (!result.data.noise.sd_stated) return NoiseVerdict::estimated;
    if (misfit.p_value < misfit_level) return NoiseVerdict::exceeded;
    return misfit.p_value < doubtful_level ? NoiseVerdict::doubtful : NoiseVerdict::explained;
  };
  result.noise_verdict = verdict();
  if (result.noise_verdict == NoiseVerdict::estimated) result.noise_scale = misfit.scale();
  // The misfit may lie in constants or laws that are off by more than their errors.
  if (result.noise_verdict == NoiseVerdict::exceeded) {
    result.noise_scale = std::max(1.0, misfit.scale());
  }
  const StatedNoise& stated = result.data.noise;
  Noise& noise = result.weights.noise;
  const double least = std::max(noise.scale, stated.rounding_sd);
  const bool scatters = least * result.noise_scale > least_noise;
  if (result.noise_verdict == NoiseVerdict::estimated) {
    result.noise_scale =
        std::max(result.noise_scale, std::min(1.0, stated.rounding_sd / noise.scale));
    // The degrees of freedom by which the points determine the constants do not determine the
    // noise.
    result.dof -= static_cast<int>(std::lround(misfit.learned));
  }
  noise.known = stated.sd_stated || (result.dof > 0 && scatters);
  if (!noise.known) {
    result.noise_scale = 1.0;
    result.noise_verdict = NoiseVerdict::unchecked;
  }
  const auto known_by = [&](Estimated error, int dof) {
    if (dof <= 0) return;
    result.estimated.push_back({error, dof, {}});
    if (result.quantile_dof == 0 || dof < result.quantile_dof) result.quantile_dof = dof;
  };
  known_by(Estimated::noise, stated.sd_stated ? noise.pooled_dof : result.dof);
  if (noise.event_spread > 0.0) {
    // Degrees of freedom of the spread of the impacts: those in the range where some spheres stick
    // count, and single impacts in proportion to the part of their variance that comes from the
    // spread (Satterthwaite 1946, Biometrics Bull. 2, 110).
    const std::vector<bool> among = among_captures(result.data.points);
    double impacts = 0.0;
    for (std::size_t i = 0; i < among.size(); ++i) {
      const Observation& point = result.data.points[i];
      if (point.events > 1 || point.censored) {
        impacts += among[i] ? point.events : 0;
      } else if (const PointWeights& own = result.weights.points[i]; own.scatter > 0.0) {
        impacts += std::pow(1.0 - std::pow(own.sd / own.mean_sd, 2), 2);
      }
    }
    known_by(Estimated::spread, std::max(1, static_cast<int>(impacts) - 1));
  }
  if (stated.setting_sd_estimated) {
    known_by(Estimated::setting, spare_settings(result.data, result.model.free_count()));
  }
}

}  // namespace recoil
