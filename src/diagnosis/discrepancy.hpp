#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <span>

#include "estimate/least_squares.hpp"
#include "estimate/observations.hpp"
#include "estimate/weights.hpp"

namespace recoil {

/// The storage of Jacobians [points x slots].
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Smooth random functions of ln V and ln d on the points of a sample: zero mean and covariance
///   k = exp(-((ln V / V')^2 + (ln d / d')^2) / 2),
/// so that values within a factor of two are strongly correlated and values a decade apart are
/// nearly independent. V' and d' are any second point.
/// @return B [points x rank] with B B' = k to 1e-6 (pivoted Cholesky factor: Harbrecht, Peters &
///   Schneider 2012, Appl. Numer. Math. 62, 428-440)
Eigen::MatrixXd smooth_functions(const Observations& data);

/// The covariance I + U U' of weighted residuals: independent noise of variance 1, and one column
/// of U for each shared error. Whitening replaces r by (I + U U')^(-1/2) r. Residuals after those
/// of the points (of uncertain constants) do not change.
class Discrepancy {
 public:
  Discrepancy() = default;  ///< no shared errors

  /// @param shared U [points x errors]
  explicit Discrepancy(const Eigen::MatrixXd& shared);

  void whiten(std::span<double> residuals) const;
  void unwhiten(std::span<double> residuals) const;
  /// Every column of `jacobian` [points x p, row major].
  void whiten(std::span<double> jacobian, std::size_t p) const;
  /// ln det (I + U U')
  double log_determinant() const { return log_determinant_; }
  bool shares_nothing() const { return directions_.cols() == 0; }

 private:
  Eigen::MatrixXd directions_;        // orthonormal [points x rank]
  Eigen::VectorXd whiter_, rougher_;  // factors along the directions, minus one
  double log_determinant_ = 0.0;
};

/// Whitens every column [points x any] for the errors that points of one setting share, as the
/// residuals of a fit are (SharedErrors).
void whiten_shared(const Observations& data, const Weights& weights, Eigen::MatrixXd& columns);

/// The same problem in whitened residuals. `discrepancy` must outlive it.
LeastSquaresProblem whitened(LeastSquaresProblem problem, const Discrepancy& discrepancy);

}  // namespace recoil
