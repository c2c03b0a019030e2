#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/names.hpp"
#include "uncertainty/capture_estimate.hpp"
#include "uncertainty/chains.hpp"
#include "uncertainty/interval.hpp"
#include "uncertainty/noise_alternatives.hpp"
#include "uncertainty/uncertainty_options.hpp"

namespace recoil {

/// Why there is no posterior.
enum class NoPosterior {
  no_start,     ///< not enough places of finite density were found near the estimate
  not_settled,  ///< R-hat or the number of effective draws is not what it has to be
  few_points,   ///< the noise is unknown, and no more points are there than parameters
};
template <>
struct NamesOf<NoPosterior> {
  static constexpr std::array<std::string_view, 3> names = {"no_start", "not_settled",
                                                            "few_points"};
};

/// Why points cannot be left out one by one.
enum class NoLeaveOneOut {
  shared_errors,  ///< points share an error: one of them alone has no likelihood
  student,        ///< the density of robust residuals is known but for a factor
};
template <>
struct NamesOf<NoLeaveOneOut> {
  static constexpr std::array<std::string_view, 2> names = {"shared_errors", "student"};
};

/// One quantity under the posterior.
struct PosteriorMarginal {
  Interval
      interval;  ///< equal tails; missing for what is fixed, and where the draws have not settled
  double mean = 0.0;
  double sd = 0.0;
  ChainCheck check;
};

/// The expected log predictive density of points that were left out of the fit, one at a time.
struct LeaveOneOut {
  std::optional<NoLeaveOneOut> missing;
  double elpd = 0.0;   ///< sum over the points
  double se = 0.0;     ///< of elpd: sqrt(n) times the standard deviation over the points
  double p_loo = 0.0;  ///< ln of the mean likelihood of the points less elpd: effective parameters
  std::vector<LeftOutPoint> points;
};

/// Beyond this shape the smoothed weights of a point are not to be trusted (Vehtari, Simpson,
/// Gelman, Yao & Gabry 2024, J. Mach. Learn. Res. 25, 72).
inline constexpr double largest_pareto_k = 0.7;

/// The posterior of everything that a fit moves, by joint draws. Priors: parameters flat between
/// their bounds (in the logarithm where they are fitted so), constants of the materials that fits
/// move as their errors state them. The likelihood is that of the fit, captures included. Where the
/// noise is estimated, or the stated deviations do not hold (NoiseVerdict::exceeded), they are
/// multiplied by an unknown scale with the prior 1 / scale; integrated over it,
///   p ~ (sum r^2)^(-n/2) over the n points with rebounds,
/// and a draw of the scale is (sum r^2 / chi2_n)^(1/2).
/// Where the fit chose its variance function, the posterior is the mixture of those under each
/// function, with the weights of `noise_alternatives`. Under one function, ratios between the
/// weights of points, their effective variances and the spread of the impacts stay those of its
/// fit.
struct PosteriorResult {
  std::optional<NoPosterior> missing;
  int steps = 0;                                   ///< of every chain, of which `length` are kept
  std::size_t chains = 0;                          ///< independent of one another
  std::size_t length = 0;                          ///< draws kept of every chain
  double acceptance = 0.0;                         ///< share of the proposals
  std::vector<PosteriorMarginal> parameters;       ///< [slots]
  std::vector<PosteriorMarginal> capture;          ///< in the order of the estimates
  std::vector<std::vector<double>> draws;          ///< [chain by chain][slots]
  std::vector<std::vector<double>> capture_draws;  ///< [draws][capture], NaN: none
  std::vector<double> scale;                       ///< [draws] of the noise; empty: known
  std::vector<double> log_likelihood;              ///< [draws]
  std::vector<double> log_prior;  ///< [draws]; -ln scale for a scale, as its prior has no norm
  std::vector<std::vector<double>> pointwise;  ///< ln likelihood [points][draws]; empty: missing
  LeaveOneOut left_out;

  bool available() const { return !missing; }
};

/// Chains from places around the estimate. Half of the proposals are drawn from a Student's t
/// whatever the present place, half lie around it as a random walk; both have the covariance of
/// Gauss and Newton at first, and from round to round that of the draws so far. Within a round,
/// which alone is kept, proposals stay as they are. Rounds double until every quantity has settled.
/// @param alternatives of `noise_alternatives`; the first is the fit
PosteriorResult sample_posterior(const std::vector<NoiseAlternative>& alternatives,
                                 const std::vector<CaptureEstimate>& capture,
                                 const PosteriorOptions& options);

}  // namespace recoil
