#include "validation/synthetic/strength.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace recoil::hidden {
Eigen::VectorXd base_residuals(const Design& design, const std::vector<Point>& points, double C_H,
                               double C_A) {
  Base base = design.base;
  base.C_H = C_H;
  base.C_A = C_A;
  static const Effects nothing;
  Eigen::VectorXd all(static_cast<Eigen::Index>(points.size()));
  std::transform(points.begin(), points.end(), all.begin(), [&](const Point& p) {
    const double square = square_of_restitution(base, nothing, p.velocity, p.diameter);
    const double e = std::sqrt(std::max(square, 0.0));
    return (p.restitution * p.restitution - square) / (p.sd * (p.restitution + e));
  });
  return all;
}

Refit refit_base(const Design& design, const std::vector<Point>& points) {
  const auto residuals = [&](const Eigen::Vector2d& damping) {
    return base_residuals(design, points, damping(0), damping(1));
  };
  Eigen::Vector2d x(design.base.C_H, design.base.C_A);
  const Eigen::Vector2d unit = x.cwiseMax(1e-6);
  Eigen::VectorXd now = residuals(x);
  double damping = 1e-3;
  for (int round = 0; round < 60; ++round) {
    Eigen::MatrixX2d slope(now.size(), 2);
    for (int j = 0; j < 2; ++j) {
      const double h = 1e-4 * unit(j) + 1e-4 * x(j);
      Eigen::Vector2d moved = x;
      moved(j) += h;
      slope.col(j) = (residuals(moved) - now) / h;
    }
    Eigen::Vector2d gradient = slope.transpose() * now;
    Eigen::Matrix2d normal = slope.transpose() * slope;
    for (int j = 0; j < 2; ++j) {
      // A parameter at its bound stays there while the slope pushes it out. So does one that
      // changes nothing: the damping of an adhesion that is not there.
      if (!((x(j) == 0.0 && gradient(j) > 0.0) || normal(j, j) == 0.0)) continue;
      normal.row(j).setZero();
      normal.col(j).setZero();
      normal(j, j) = 1.0;
      gradient(j) = 0.0;
    }
    double step_size = 0.0;
    double gain = 0.0;
    for (int tries = 0; tries < 12; ++tries) {
      Eigen::Matrix2d damped = normal;
      damped.diagonal() *= 1.0 + damping;
      const Eigen::Vector2d next = (x - damped.inverse() * gradient).cwiseMax(0.0);
      const Eigen::VectorXd there = residuals(next);
      if (there.squaredNorm() <= now.squaredNorm()) {
        step_size = (next - x).cwiseAbs().cwiseQuotient(unit).sum();
        gain = now.squaredNorm() - there.squaredNorm();
        x = next;
        now = there;
        damping = std::max(damping * 0.1, 1e-9);
        break;
      }
      damping *= 10.0;
    }
    if (step_size < 1e-6 || gain < 1e-6 * (now.squaredNorm() + 1e-6)) break;
  }
  return {x(0), x(1), now.norm()};
}

}  // namespace recoil::hidden
