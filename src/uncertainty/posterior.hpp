#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/names.hpp"
#include "uncertainty/capture_estimate.hpp"
#include "uncertainty/interval.hpp"
#include "uncertainty/noise_alternatives.hpp"
#include "uncertainty/uncertainty_options.hpp"

namespace recoil {

/// Why there is no posterior.
enum class NoPosterior {
  no_walkers,   ///< not enough places of finite density were found near the estimate
  not_settled,  ///< R-hat or the number of effective draws is not what it has to be
  few_points,   ///< the noise is unknown, and no more points are there than parameters
};
template <>
struct NamesOf<NoPosterior> {
  static constexpr std::array<std::string_view, 3> names = {"no_walkers", "not_settled",
                                                            "few_points"};
};

/// One quantity under the posterior.
struct PosteriorMarginal {
  Interval
      interval;  ///< equal tails; missing for what is fixed, and where the draws have not settled
  double mean = 0.0;
  double sd = 0.0;
  double r_hat = 0.0;
  double effective = 0.0;  ///< draws
};

/// The posterior of everything that a fit moves, by joint draws. Priors: parameters flat between
/// their bounds (in the logarithm where they are fitted so), constants of the materials that fits
/// move as their errors state them. The likelihood is that of the fit, captures included. The scale
/// of the noise is marginalised with the prior 1 / scale where it is estimated, or where the stated
/// deviations do not hold (NoiseVerdict::exceeded):
///   p ~ (sum r^2)^(-n/2) over the n points with rebounds.
/// Where the fit chose its variance function, the posterior is the mixture of those under each
/// function, with the weights of `noise_alternatives`. Under one function, ratios between the
/// weights of points, their effective variances and the spread of the impacts stay those of its
/// fit.
struct PosteriorResult {
  std::optional<NoPosterior> missing;
  int steps = 0;    ///< kept of every walker
  int walkers = 0;  ///< in all ensembles, under all variance functions
  double acceptance = 0.0;
  std::vector<PosteriorMarginal> parameters;       ///< [slots]
  std::vector<PosteriorMarginal> capture;          ///< in the order of the estimates; from `draws`
  std::vector<std::vector<double>> draws;          ///< [kept][slots]
  std::vector<std::vector<double>> capture_draws;  ///< [kept][capture], NaN: none

  bool available() const { return !missing; }
};

/// @param alternatives of `noise_alternatives`; the first is the fit
PosteriorResult sample_posterior(const std::vector<NoiseAlternative>& alternatives,
                                 const std::vector<CaptureEstimate>& capture,
                                 const PosteriorOptions& options);

}  // namespace recoil
