#pragma once

#include <vector>

namespace recoil {

/// The draws of one quantity [chain][draw]; all chains have the same length.
using ChainDraws = std::vector<std::vector<double>>;

/// Convergence of chains, and their effective number of independent draws (Vehtari, Gelman,
/// Simpson, Carpenter & Buerkner 2021, Bayesian Anal. 16, 667-718).
struct ChainCheck {
  /// The larger R-hat of two: that of the rank-normalised draws and that of the rank-normalised
  /// distances from the median. 1 if all halves of all chains agree; infinite for constant chains
  /// with different values.
  double r_hat = 1.0;
  double bulk = 0.0;  ///< effective number of rank-normalised draws
  double tail = 0.0;  ///< the smaller effective number of two: for the 5 % and the 95 % quantile
};

/// Computes R-hat and effective draws. Every chain is split in halves. With W the mean variance
/// within the halves, B/n the variance of their means and V = W (n - 1) / n + B/n,
///   R-hat = sqrt(V / W),  effective draws = m n / (1 + 2 sum rho_t),
///   rho_t = 1 - (W - mean covariance at lag t) / V,
/// with the sum truncated by Geyer's (1992) initial monotone sequence. Ranks r of S draws become
/// Phi^-1((r - 3/8) / (S + 1/4)).
/// @param chains with at least 4 draws each
ChainCheck check_chains(const ChainDraws& chains);

/// The effective number of draws of a mean, without ranks, over the number of draws [1]. 1 for
/// independent draws, less if neighbours are alike.
double relative_efficiency(const ChainDraws& chains);

/// Leave-one-out prediction of one point by importance sampling.
struct LeftOutPoint {
  double elpd = 0.0;      ///< ln p(point | all other points)
  double pareto_k = 0.0;  ///< shape of the tail of the weights; see `largest_pareto_k`
  double r_eff = 1.0;     ///< `relative_efficiency` of the likelihood of the point
  double mcse = 0.0;      ///< Monte-Carlo error of elpd
};

/// Above this shape the smoothed weights of `draws` draws are not reliable:
/// min(1 - 1 / log10(draws), 0.7) (Vehtari, Simpson, Gelman, Yao & Gabry 2024, J. Mach. Learn. Res.
/// 25, 72).
double largest_pareto_k(std::size_t draws);

/// Pareto-smoothed importance sampling (the same; Vehtari, Gelman & Gabry 2017, Stat. Comput. 27,
/// 1413-1432): draw s has the weight w_s ~ 1 / p(point | s); the M = min(S / 5, 3 sqrt(S / r_eff))
/// largest are replaced by quantiles of a generalised Pareto distribution fitted to them (Zhang &
/// Stephens 2009, Technometrics 51, 316-325; with a prior for the shape, worth 10 draws, at 1/2).
/// With E = exp(elpd), the sum of w_s p(point | s), the Monte-Carlo error of E has the square
/// sum w_s^2 (p(point | s) - E)^2 / r_eff, and elpd that of a lognormal E.
/// @param log_likelihood ln likelihood of the point [draws]
/// @param r_eff its relative efficiency
LeftOutPoint leave_out(const std::vector<double>& log_likelihood, double r_eff = 1.0);

/// The same, with the relative efficiency that the chains have.
/// @param log_likelihood ln likelihood of the point, chain by chain [draws]
LeftOutPoint leave_out_of_chains(const std::vector<double>& log_likelihood, std::size_t chains);

}  // namespace recoil
