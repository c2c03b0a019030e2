#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "uncertainty/capture_estimate.hpp"
#include "uncertainty/chains.hpp"
#include "uncertainty/fit_alternatives.hpp"
#include "uncertainty/interval.hpp"
#include "uncertainty/uncertainty_options.hpp"

namespace recoil {

/// The reason for a missing posterior.
enum class NoPosterior {
  no_start,     ///< no start with finite density was found near the estimate
  not_settled,  ///< R-hat is too large or the number of effective draws too small
  few_points,   ///< the noise is unknown, and there are no more points than parameters
};

/// One quantity under the posterior.
struct PosteriorMarginal {
  /// Equal tails; missing for fixed parameters and if the chains have not converged.
  Interval interval;
  double mean = 0.0;
  double sd = 0.0;
  ChainCheck check;
};

/// Leave-one-out cross-validation: the expected log predictive density of each point given the
/// others. Nothing else is set if one of the first two is true.
struct LeaveOneOut {
  bool shared_errors = false;  ///< points share errors: one alone has no likelihood
  bool unscaled = false;       ///< robust residuals: their density is known only up to a factor
  double elpd = 0.0;           ///< sum over the points
  /// Standard error of elpd: sqrt(n) times the standard deviation over the points.
  double se = 0.0;
  double mcse = 0.0;  ///< Monte-Carlo error of elpd
  /// Effective number of parameters: sum of ln mean likelihood of the points minus elpd.
  double p_loo = 0.0;
  std::vector<LeftOutPoint> points;

  bool possible() const { return !shared_errors && !unscaled; }
};

/// The posterior of all moving parameters, as joint draws. The priors are flat between the bounds
/// (in the logarithm for `log_scale`); material constants that fits move have their stated
/// distributions. The likelihood is that of the fit, including captures. If the noise is estimated,
/// or if the scatter exceeds the stated deviations (NoiseVerdict::exceeded), the deviations are
/// multiplied by an unknown scale with the prior 1 / scale; integrated over the scale,
///   p ~ (sum r^2)^(-n/2) over the n points with rebounds,
/// and a draw of the scale is (sum r^2 / chi2_n)^(1/2). If the fit chose its variance function, the
/// posterior is the mixture over the functions with the weights of `fit_alternatives`. Under one
/// function, the relative weights of points, their effective variances and the spread of the
/// impacts are those of its fit.
struct PosteriorResult {
  std::optional<NoPosterior> missing;
  int steps = 0;                              ///< steps of every chain, of which `length` are kept
  std::size_t chains = 0;                     ///< number of independent chains
  std::size_t length = 0;                     ///< draws kept per chain
  double acceptance = 0.0;                    ///< accepted share of the proposals [1]
  std::vector<PosteriorMarginal> parameters;  ///< [slots]
  std::vector<PosteriorMarginal> capture;     ///< in the order of the estimates
  std::vector<std::vector<double>> draws;     ///< [chain by chain][slots]
  std::vector<std::vector<double>> capture_draws;  ///< V* [m/s] [draws][capture], NaN: none
  std::vector<std::size_t> alternative;            ///< index of the alternative [draws]
  std::vector<double> scale;                       ///< scale of the noise [draws]; empty: known
  std::vector<double> log_likelihood;              ///< [draws]
  /// [draws]; contains -ln scale, as the prior of the scale is not normalised.
  std::vector<double> log_prior;
  std::vector<std::vector<double>> pointwise;  ///< ln likelihood [points][draws]; empty: none
  LeaveOneOut left_out;

  bool available() const { return !missing; }
};

/// Samples the posterior by Metropolis-Hastings chains that start around the estimate. Half of the
/// proposals are independent draws from Student's t, half are random-walk steps. Both use the
/// Gauss-Newton covariance at first, and then that of the draws of the round before. Proposals do
/// not change within a round, and only the last round is kept. The length of the rounds doubles
/// until every quantity has converged.
/// @param alternatives of `fit_alternatives`; the first is the fit
PosteriorResult sample_posterior(const std::vector<FitAlternative>& alternatives,
                                 const std::vector<CaptureEstimate>& capture,
                                 const PosteriorOptions& options);

/// The share of a path of the sampler that lies below `theta` [slots]. The path goes through theta,
/// at a place drawn from all of its `steps` + 1, and its proposals do not adapt. If theta is itself
/// a draw of the posterior, the shares are uniform on [0, 1], however slowly the path moves (Gandy
/// & Scott 2020, arXiv 2001.06465); equal values are ordered at random.
/// @param stream number of the stream of random numbers
/// @return empty if the posterior is not known, or its density at theta is 0
std::vector<double> shares_below(const FitResult& fitted, std::vector<double> theta, int steps,
                                 std::uint64_t seed, std::uint64_t stream);

}  // namespace recoil
