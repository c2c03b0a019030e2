#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <span>
#include <vector>

#include "estimate/least_squares.hpp"
#include "estimate/observations.hpp"

namespace recoil {

/// As Jacobians are stored [points x slots].
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Smooth random functions of ln V and ln d on the points of a sample: zero mean and covariance
///   k = exp(-((ln V / V')^2 + (ln d / d')^2) / 2),
/// so that they keep their value over a factor of two or so and are free of it a decade away.
/// @returns B [points x rank] with B B' = k to 1e-6 (pivoted Cholesky factor: Harbrecht, Peters &
///   Schneider 2012, Appl. Numer. Math. 62, 428-440)
Eigen::MatrixXd smooth_functions(const Observations& data);

/// The covariance I + U U' of weighted residuals: beside their own noise, of unit size, they share
/// errors, of which U has one column for each. Whitening takes r to (I + U U')^(-1/2) r. Residuals
/// that follow those of the points (of constants known with an error) stay as they are.
class Discrepancy {
 public:
  Discrepancy() = default;  ///< nothing shared

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
  Eigen::VectorXd whiter_, rougher_;  // factors along them, less one
  double log_determinant_ = 0.0;
};

/// Takes out of every column [points x any] what the points of one setting share, as the residuals
/// of a fit have it (SharedSettings).
void whiten_settings(const Observations& data, Eigen::MatrixXd& columns);

/// The same problem in whitened residuals. `discrepancy` has to outlive it.
LeastSquaresProblem whitened(LeastSquaresProblem problem, const Discrepancy& discrepancy);

}  // namespace recoil
