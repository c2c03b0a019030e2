#include "estimate/linearised.hpp"

#include <cmath>

namespace recoil {
namespace {

// If the ratio of its singular values is below this, a scaled J of integrated impacts (accurate to
// 1e-7) cannot show that the direction has any effect.
constexpr double singular_ratio = 3e-7;

}  // namespace

LinearisedResiduals::LinearisedResiduals(const Eigen::MatrixXd& jacobian)
    : scale_(jacobian.colwise().norm()) {
  if (jacobian.rows() < jacobian.cols() || !(scale_.minCoeff() > 0.0) || !scale_.allFinite()) {
    return;
  }
  factors_.compute(jacobian * scale_.cwiseInverse().asDiagonal());
  const Eigen::Index q = jacobian.cols();
  const auto r = factors_.matrixQR().topRows(q).triangularView<Eigen::Upper>();
  inverse_ = r.solve(Eigen::MatrixXd::Identity(q, q));
  // The columns have length 1, so the singular values lie between 1 / |R^-1|_F and sqrt(q).
  if (1.0 / inverse_.norm() > singular_ratio * std::sqrt(static_cast<double>(q))) {
    singular_ = false;
    return;
  }
  const Eigen::VectorXd singular_values =
      Eigen::JacobiSVD<Eigen::MatrixXd>(Eigen::MatrixXd(r)).singularValues();
  singular_ = !(singular_values.minCoeff() > singular_ratio * singular_values.maxCoeff());
}

Eigen::VectorXd LinearisedResiduals::step(const Eigen::VectorXd& residuals) const {
  return -factors_.solve(residuals).cwiseQuotient(scale_);
}

Eigen::MatrixXd LinearisedResiduals::covariance() const {
  const Eigen::MatrixXd inverse = scale_.cwiseInverse().asDiagonal() * inverse_;
  return inverse * inverse.transpose();
}

}  // namespace recoil
