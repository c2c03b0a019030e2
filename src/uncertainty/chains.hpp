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

/// Leave-one-out prediction of one point by importance sampling.
struct LeftOutPoint {
  double elpd = 0.0;      ///< ln p(point | all other points)
  double pareto_k = 0.0;  ///< shape of the tail of the weights; above 0.7 `elpd` is unreliable
};

/// Pareto-smoothed importance sampling (Vehtari, Gelman & Gabry 2017, Stat. Comput. 27, 1413-1432):
/// draw s has the weight 1 / p(point | s); the M = min(S / 5, 3 sqrt(S)) largest are replaced by
/// quantiles of a generalised Pareto distribution fitted to them (Zhang & Stephens 2009,
/// Technometrics 51, 316-325; with a prior for the shape, worth 10 draws, at 1/2).
/// @param log_likelihood ln likelihood of the point [draws]
LeftOutPoint leave_out(const std::vector<double>& log_likelihood);

}  // namespace recoil
