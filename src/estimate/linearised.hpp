#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

namespace recoil {

/// Linearised residuals r + J d, by the QR factors of J with its columns scaled to length 1;
/// products J'J would lose half of the digits (Golub & Van Loan, Matrix Computations, section 5.3).
class LinearisedResiduals {
 public:
  /// @param jacobian J [n x q]
  explicit LinearisedResiduals(const Eigen::MatrixXd& jacobian);

  /// Is some combination of the parameters undetermined, given the accuracy of J?
  bool singular() const { return singular_; }

  /// The Gauss-Newton step: the d [q] with the smallest |r + J d|. @pre !singular()
  /// @param residuals r [n]
  Eigen::VectorXd step(const Eigen::VectorXd& residuals) const;

  /// (J'J)^-1 [q x q]. @pre !singular()
  Eigen::MatrixXd covariance() const;

 private:
  Eigen::VectorXd scale_;  // lengths of the columns
  Eigen::HouseholderQR<Eigen::MatrixXd> factors_;
  Eigen::MatrixXd inverse_;  // of R
  bool singular_ = true;
};

}  // namespace recoil
