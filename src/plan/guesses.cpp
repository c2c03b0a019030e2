#include "plan/guesses.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/random.hpp"

namespace recoil {

std::vector<std::vector<double>> drawn_values(const ImpactModel& model, const Guess& guess,
                                              std::uint64_t seed, int count) {
  const auto n = static_cast<Eigen::Index>(model.slots.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < guess.covariance.size(); ++i) {
    covariance.row(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::RowVectorXd>(guess.covariance[i].data(), n);
  }
  // The correlation of the logarithms is taken as that of the parameters.
  Eigen::VectorXd scale = Eigen::VectorXd::Zero(n);  // sd of ln theta over the sd of theta, or 0
  for (Eigen::Index j = 0; j < n; ++j) {
    const double theta = guess.theta[static_cast<std::size_t>(j)];
    const double sd = std::sqrt(covariance(j, j));
    if (theta == 0.0 || !(sd > 0.0)) continue;
    scale(j) = std::copysign(std::sqrt(std::log1p(std::pow(sd / theta, 2))), theta) / sd;
  }
  // A root of the covariance, which may be singular.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * covariance *
                                                             scale.asDiagonal());
  const Eigen::MatrixXd root =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  std::vector<std::vector<double>> draws = {guess.theta};
  for (int k = 1; k < count; ++k) {
    RandomStream random(seed, RandomPurpose::guesses, static_cast<std::uint64_t>(k));
    Eigen::VectorXd normal(n);
    for (double& one : normal) one = random.normal();
    const Eigen::VectorXd fitted = root * normal;
    std::vector<double>& theta = draws.emplace_back(guess.theta);
    for (std::size_t j = 0; j < theta.size(); ++j) {
      const auto row = static_cast<Eigen::Index>(j);
      const double box = std::log(guess_factor) * (2.0 * random.uniform() - 1.0);
      const ParameterSlot& slot = model.slots[j];
      if (!slot.free) continue;
      theta[j] = std::clamp(theta[j] * std::exp(scale(row) != 0.0 ? fitted(row) : box), slot.lower,
                            slot.upper);
    }
  }
  return draws;
}

}  // namespace recoil
