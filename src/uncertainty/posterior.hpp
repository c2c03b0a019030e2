#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/names.hpp"
#include "estimate/fit.hpp"
#include "uncertainty/capture_estimate.hpp"
#include "uncertainty/interval.hpp"

namespace recoil {

struct PosteriorOptions {
  double level = 0.95;
  std::uint64_t seed = 20260101;
  int threads = 0;                ///< 0: all cores. No digit depends on it.
  int ensembles = 4;              ///< independent of one another
  int fewest_steps = 1000;        ///< kept of every walker, after as many that are dropped
  int most_steps = 8000;          ///< beyond it the sampler gives up
  double largest_r_hat = 1.01;    ///< of every quantity
  double least_effective = 1000;  ///< draws of every quantity
  std::size_t kept = 2000;        ///< joint draws that are handed on
};

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
/// their bounds (in the logarithm where they are fitted so), constants of the materials as their
/// errors state them. The likelihood is that of the fit, captures included. The scale of the noise
/// is marginalised with the prior 1 / scale where it is estimated, or where the stated deviations
/// do not hold (NoiseVerdict::exceeded):
///   p ~ (sum r^2)^(-n/2) over the n points with rebounds;
/// ratios between the weights of points, their effective variances and the spread of the impacts
/// stay those of the fit.
struct PosteriorResult {
  std::optional<NoPosterior> missing;
  int steps = 0;    ///< kept of every walker
  int walkers = 0;  ///< in all ensembles
  double acceptance = 0.0;
  std::vector<PosteriorMarginal> parameters;       ///< [slots]
  std::vector<PosteriorMarginal> capture;          ///< in the order of the estimates; from `draws`
  std::vector<std::vector<double>> draws;          ///< [kept][slots]
  std::vector<std::vector<double>> capture_draws;  ///< [kept][capture], NaN: none

  bool available() const { return !missing; }
};

PosteriorResult sample_posterior(const FitResult& fitted,
                                 const std::vector<CaptureEstimate>& capture,
                                 const PosteriorOptions& options);

}  // namespace recoil
