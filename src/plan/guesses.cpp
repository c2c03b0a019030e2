#include "plan/guesses.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/random.hpp"

namespace recoil {

std::vector<std::vector<double>> drawn_values(const ImpactModel& model, const Guess& guess,
                                              std::uint64_t seed, int count) {
  const std::size_t n = model.slots.size();
  const auto fitted = [&](std::size_t j) {
    return !guess.covariance.empty() && guess.theta[j] != 0.0 && guess.covariance[j][j] > 0.0;
  };
  // The covariance of ln theta; correlations are taken as those of theta.
  Eigen::MatrixXd covariance =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  const auto sd = [&](std::size_t j) {
    if (!fitted(j)) return std::log(guess_factor);
    return std::sqrt(std::log1p(guess.covariance[j][j] / (guess.theta[j] * guess.theta[j])));
  };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      double correlation = i == j ? 1.0 : 0.0;
      if (i != j && fitted(i) && fitted(j)) {
        correlation = guess.covariance[i][j] /
                      std::sqrt(guess.covariance[i][i] * guess.covariance[j][j]) *
                      std::copysign(1.0, guess.theta[i] * guess.theta[j]);
      }
      covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          sd(i) * sd(j) * correlation;
    }
  }
  // A root of the covariance, which may be singular.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(covariance);
  const Eigen::MatrixXd root =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  std::vector<std::vector<double>> draws = {guess.theta};
  for (int k = 1; k < count; ++k) {
    RandomStream random(seed, RandomPurpose::guesses, static_cast<std::uint64_t>(k));
    Eigen::VectorXd normal(covariance.rows());
    for (double& one : normal) one = random.normal();
    const Eigen::VectorXd moved = root * normal;
    std::vector<double>& theta = draws.emplace_back(guess.theta);
    for (std::size_t j = 0; j < n; ++j) {
      const ParameterSlot& slot = model.slots[j];
      if (!slot.free) continue;
      theta[j] = std::clamp(theta[j] * std::exp(moved(static_cast<Eigen::Index>(j))), slot.lower,
                            slot.upper);
    }
  }
  return draws;
}

}  // namespace recoil
