#include "estimate/linearised.hpp"

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
  const Eigen::MatrixXd r = factors_.matrixQR().topRows(q).triangularView<Eigen::Upper>();
  const Eigen::VectorXd singular_values = Eigen::JacobiSVD<Eigen::MatrixXd>(r).singularValues();
  singular_ = !(singular_values.minCoeff() > singular_ratio * singular_values.maxCoeff());
}

Eigen::VectorXd LinearisedResiduals::step(const Eigen::VectorXd& residuals) const {
  return -factors_.solve(residuals).cwiseQuotient(scale_);
}

Eigen::MatrixXd LinearisedResiduals::covariance() const {
  const Eigen::Index q = scale_.size();
  const Eigen::MatrixXd inverse =
      scale_.cwiseInverse().asDiagonal() *
      factors_.matrixQR().topRows(q).triangularView<Eigen::Upper>().solve(
          Eigen::MatrixXd::Identity(q, q));
  return inverse * inverse.transpose();
}

}  // namespace recoil
