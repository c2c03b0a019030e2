#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/random.hpp"

namespace recoil {

/// ln density but for a constant; -infinity where there is none.
using LogDensity = std::function<double(std::span<const double> z)>;

/// Walkers that sample a density: the affine-invariant ensemble of Goodman, J. & Weare, J. (2010),
/// Commun. Appl. Math. Comput. Sci. 5, 65-80, with stretch moves of a = 2. Each step moves one half
/// of the walkers along lines through walkers of the other half, then the other half: a proposal
///   z' = z_other + s (z - z_other),  s with density ~ 1 / sqrt(s) on [1/2, 2],
/// is accepted with probability min(1, s^(p - 1) density(z') / density(z)). Scales and correlations
/// of the coordinates need not be known.
class Ensemble {
 public:
  /// @param start one row per walker, more than twice as many as coordinates and an even number,
  ///   each of finite density and not all on one hyperplane
  Ensemble(LogDensity density, std::vector<std::vector<double>> start, RandomStream random);

  void step();
  const std::vector<std::vector<double>>& walkers() const { return walkers_; }
  const std::vector<double>& log_density() const { return log_density_; }
  double acceptance() const;  ///< of the proposals so far [1]

 private:
  LogDensity density_;
  std::vector<std::vector<double>> walkers_;
  std::vector<double> log_density_;
  RandomStream random_;
  std::uint64_t proposed_ = 0;
  std::uint64_t accepted_ = 0;
};

/// How far chains of one quantity are from having forgotten where they began: the potential scale
/// reduction of Gelman & Rubin with every chain split in halves (Gelman et al. 2013, Bayesian Data
/// Analysis, 3rd ed., 11.4). 1 when they agree; infinite for chains that stand still apart.
/// @param chains of the same length, at least 4
double split_r_hat(const std::vector<std::vector<double>>& chains);

/// How many independent draws the chains are worth: m n / (1 + 2 sum rho_t), with the
/// autocorrelations of all split chains together and Geyer's initial monotone sequence (Gelman et
/// al. 2013, 11.5; Vehtari et al. 2021, Bayesian Anal. 16, 667-718).
double effective_sample_size(const std::vector<std::vector<double>>& chains);

}  // namespace recoil
