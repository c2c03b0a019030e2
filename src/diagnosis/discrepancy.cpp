#include "diagnosis/discrepancy.hpp"

#include <cmath>

#include "estimate/shared_errors.hpp"

namespace recoil {
namespace {

constexpr double left_out = 1e-6;  // variance that may be neglected, over that of a smooth function
constexpr double too_small = 1e-9;  // variance that may be neglected, over that of a residual

/// The matrix I + Q diag(factor) Q' times `m`.
template <class M>
void scale_along(const Eigen::MatrixXd& Q, const Eigen::VectorXd& factor, M& m) {
  const Eigen::MatrixXd along = Q.transpose() * m;
  m += Q * (factor.asDiagonal() * along);
}

}  // namespace

Eigen::MatrixXd smooth_functions(const Observations& data) {
  const auto n = static_cast<Eigen::Index>(data.points.size());
  Eigen::ArrayXd log_velocity(n), log_diameter(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Observation& point = data.points[static_cast<std::size_t>(i)];
    log_velocity(i) = std::log(point.velocity);
    log_diameter(i) = std::log(point.diameter);
  }
  Eigen::ArrayXd unexplained = Eigen::ArrayXd::Ones(n);
  std::vector<Eigen::VectorXd> columns;
  while (static_cast<Eigen::Index>(columns.size()) < n) {
    Eigen::Index pivot = 0;
    const double most = unexplained.maxCoeff(&pivot);
    if (!(most > left_out)) break;
    Eigen::VectorXd column = (-0.5 * ((log_velocity - log_velocity(pivot)).square() +
                                      (log_diameter - log_diameter(pivot)).square()))
                                 .exp();
    for (const Eigen::VectorXd& other : columns) column -= other(pivot) * other;
    column /= std::sqrt(most);
    unexplained -= column.array().square();
    columns.push_back(std::move(column));
  }
  Eigen::MatrixXd functions(n, static_cast<Eigen::Index>(columns.size()));
  for (Eigen::Index k = 0; k < functions.cols(); ++k) {
    functions.col(k) = columns[static_cast<std::size_t>(k)];
  }
  return functions;
}

Discrepancy::Discrepancy(const Eigen::MatrixXd& shared) {
  if (shared.cols() == 0) return;
  // U'U = V S^2 V' gives the directions U V / S, and I + U U' has 1 + S^2 along them.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(shared.transpose() * shared);
  const Eigen::VectorXd& variances = eigen.eigenvalues();
  const auto rank = (variances.array() > too_small).count();
  directions_.resize(shared.rows(), rank);
  whiter_.resize(rank);
  rougher_.resize(rank);
  for (Eigen::Index k = 0; k < rank; ++k) {
    const Eigen::Index from = variances.size() - 1 - k;  // in descending order
    const double variance = variances(from);
    directions_.col(k) = shared * eigen.eigenvectors().col(from) / std::sqrt(variance);
    rougher_(k) = std::sqrt(1.0 + variance) - 1.0;
    whiter_(k) = 1.0 / std::sqrt(1.0 + variance) - 1.0;
    log_determinant_ += std::log1p(variance);
  }
}

void Discrepancy::whiten(std::span<double> residuals) const {
  if (shares_nothing()) return;
  Eigen::Map<Eigen::VectorXd> r(residuals.data(), directions_.rows());
  scale_along(directions_, whiter_, r);
}

void Discrepancy::unwhiten(std::span<double> residuals) const {
  if (shares_nothing()) return;
  Eigen::Map<Eigen::VectorXd> r(residuals.data(), directions_.rows());
  scale_along(directions_, rougher_, r);
}

void Discrepancy::whiten(std::span<double> jacobian, std::size_t p) const {
  if (shares_nothing() || p == 0) return;
  Eigen::Map<RowMajor> J(jacobian.data(), directions_.rows(), static_cast<Eigen::Index>(p));
  scale_along(directions_, whiter_, J);
}

void whiten_shared(const Observations& data, const Weights& weights, Eigen::MatrixXd& columns) {
  const SharedErrors shared(data, weights);
  for (Eigen::Index k = 0; k < columns.cols() && !shared.none(); ++k) {
    shared.whiten({columns.col(k).data(), data.points.size()});
  }
}

LeastSquaresProblem whitened(LeastSquaresProblem problem, const Discrepancy& discrepancy) {
  if (discrepancy.shares_nothing()) return problem;
  problem.evaluate = [plain = std::move(problem.evaluate), &discrepancy](
                         std::span<const double> theta, std::span<double> residuals,
                         std::span<double> jacobian) {
    if (!plain(theta, residuals, jacobian)) return false;
    discrepancy.whiten(residuals);
    if (!jacobian.empty()) discrepancy.whiten(jacobian, theta.size());
    return true;
  };
  return problem;
}

}  // namespace recoil
