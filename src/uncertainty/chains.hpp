#pragma once

#include <vector>

namespace recoil {

/// The draws of one quantity, [chain][draw], all chains of one length.
using ChainDraws = std::vector<std::vector<double>>;

/// Whether chains agree, and how many independent draws they are worth (Vehtari, Gelman, Simpson,
/// Carpenter & Buerkner 2021, Bayesian Anal. 16, 667-718).
struct ChainCheck {
  /// The larger R-hat of two: of the rank-normalised draws, and of their rank-normalised distances
  /// from the median. 1 when all halves of all chains agree; infinite for chains that stand still
  /// apart.
  double r_hat = 1.0;
  double bulk = 0.0;  ///< effective draws of the rank-normalised draws
  double tail = 0.0;  ///< the smaller effective number of two: that 5 % and that 95 % lie below
};

/// Every chain is split in halves. With W the mean variance within the halves, B/n the variance of
/// their means and V = W (n - 1) / n + B/n,
///   R-hat = sqrt(V / W),  effective draws = m n / (1 + 2 sum rho_t),
///   rho_t = 1 - (W - mean covariance at lag t) / V,
/// the sum by Geyer's (1992) initial monotone sequence. Ranks r of S draws become
/// Phi^-1((r - 3/8) / (S + 1/4)).
/// @param chains of at least 4 draws
ChainCheck check_chains(const ChainDraws& chains);

/// Leave-one-out prediction of one point by importance sampling.
struct LeftOutPoint {
  double elpd = 0.0;      ///< ln p(point | all other points)
  double pareto_k = 0.0;  ///< shape of the tail of the weights; above 0.7 `elpd` means nothing
};

/// Pareto-smoothed importance sampling (Vehtari, Gelman & Gabry 2017, Stat. Comput. 27, 1413-1432):
/// draw s has the weight 1 / p(point | s); the M = min(S / 5, 3 sqrt(S)) largest become quantiles
/// of the generalised Pareto distribution that is fitted to them (Zhang & Stephens 2009,
/// Technometrics 51, 316-325; a prior worth 10 draws pulls its shape to 1/2).
/// @param log_likelihood of the point under every draw
LeftOutPoint leave_out(const std::vector<double>& log_likelihood);

}  // namespace recoil
