#include "estimate/box_descent.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "estimate/gauss_newton.hpp"

namespace recoil {
namespace {

// The defaults of Ceres: the least ratio of actual to promised decrease of an accepted step, and
// the limits of the trust-region radius.
constexpr double least_decrease = 1e-3;
constexpr double least_radius = 1e-32;
constexpr double largest_radius = 1e16;
constexpr double shortest_column = 1e-3;  // lower limit of the entries of D, in relative steps

double power_of_two(double size) { return std::ldexp(1.0, std::ilogb(size)); }

/// Minimises |R d + c|^2 within low <= d <= high, where low <= 0 <= high, by an active-set method.
/// It starts at d = 0 and steps along the free parameters up to the first bound that it meets. The
/// parameter there is held until the gradient points back inside.
class BoxedStep {
 public:
  BoxedStep(const Eigen::MatrixXd& R, const Eigen::VectorXd& c, const Eigen::VectorXd& low,
            const Eigen::VectorXd& high)
      : R_(R), c_(c), low_(low), high_(high), d_(Eigen::VectorXd::Zero(R.cols())) {}

  Eigen::VectorXd solved() {
    const Eigen::Index q = d_.size();
    std::vector<bool> held(static_cast<std::size_t>(q), false);
    hold_at_start(held);
    for (Eigen::Index round = 0; round < 4 * q + 4; ++round) {
      if (!step_of_free(held)) continue;
      if (!release_one(held)) break;
    }
    return d_;
  }

 private:
  Eigen::VectorXd slope() const { return R_.transpose() * (R_ * d_ + c_); }

  /// Is d_k at a bound that a step along -slope would cross?
  bool pushed_out(Eigen::Index k, double slope) const {
    return (d_(k) <= low_(k) && slope >= 0.0) || (d_(k) >= high_(k) && slope <= 0.0);
  }

  void hold_at_start(std::vector<bool>& held) const {
    const Eigen::VectorXd at = slope();
    for (Eigen::Index k = 0; k < d_.size(); ++k) {
      held[static_cast<std::size_t>(k)] = pushed_out(k, at(k));
    }
  }

  /// Moves to the minimum over the free parameters, or to the first bound on the way and holds the
  /// parameter there. @return whether it reached the minimum
  bool step_of_free(std::vector<bool>& held) {
    std::vector<Eigen::Index> free;
    for (Eigen::Index k = 0; k < d_.size(); ++k) {
      if (!held[static_cast<std::size_t>(k)]) free.push_back(k);
    }
    if (free.empty()) return true;
    Eigen::MatrixXd columns(R_.rows(), static_cast<Eigen::Index>(free.size()));
    for (std::size_t k = 0; k < free.size(); ++k) {
      columns.col(static_cast<Eigen::Index>(k)) = R_.col(free[k]);
    }
    const Eigen::VectorXd by = columns.colPivHouseholderQr().solve(-(R_ * d_ + c_));
    double part = 1.0;
    Eigen::Index met = -1;
    for (std::size_t k = 0; k < free.size(); ++k) {
      const double step = by(static_cast<Eigen::Index>(k));
      const double room = step > 0.0 ? high_(free[k]) - d_(free[k]) : low_(free[k]) - d_(free[k]);
      if (!(std::abs(room) < part * std::abs(step))) continue;
      part = std::abs(room) / std::abs(step);
      met = free[k];
    }
    for (std::size_t k = 0; k < free.size(); ++k) {
      d_(free[k]) += part * by(static_cast<Eigen::Index>(k));
    }
    if (met < 0) return true;
    d_(met) =
        by(std::find(free.begin(), free.end(), met) - free.begin()) > 0.0 ? high_(met) : low_(met);
    held[static_cast<std::size_t>(met)] = true;
    return false;
  }

  /// Releases the held parameter with the steepest slope towards the inside. @return whether there
  /// is one
  bool release_one(std::vector<bool>& held) const {
    const Eigen::VectorXd at = slope();
    Eigen::Index most = -1;
    for (Eigen::Index k = 0; k < d_.size(); ++k) {
      if (!held[static_cast<std::size_t>(k)] || pushed_out(k, at(k))) continue;
      if (most < 0 || std::abs(at(k)) > std::abs(at(most))) most = k;
    }
    if (most < 0) return false;
    held[static_cast<std::size_t>(most)] = false;
    return true;
  }

  const Eigen::MatrixXd& R_;
  const Eigen::VectorXd& c_;
  const Eigen::VectorXd& low_;
  const Eigen::VectorXd& high_;
  Eigen::VectorXd d_;
};

/// The descent, in ln theta for parameters with `log_scale`. Others are in a unit of the size of
/// the largest value that they had, so that nothing depends on the unit of a parameter; one that
/// starts at 0 is in units of the change that moves the residuals by 1. The units are powers of
/// two, which cost no digit.
class BoxDescent {
 public:
  BoxDescent(const LeastSquaresProblem& problem, std::span<const double> start,
             const std::vector<bool>& fixed)
      : problem_(problem) {
    result_.theta.assign(start.begin(), start.end());
    for (std::size_t j = 0; j < start.size(); ++j) {
      result_.theta[j] = std::clamp(start[j], problem.lower[j], problem.upper[j]);
      if (!fixed[j]) free_.push_back(j);
    }
    units_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(free_.size()));
  }

  LeastSquaresResult run(const LeastSquaresOptions& options) {
    if (!ask(result_)) {
      result_.message = "the residuals cannot be evaluated";
      return std::move(result_);
    }
    result_.end = DescentEnd::minimum;
    if (free_.empty()) {
      result_.message = "no parameter is free";
      return std::move(result_);
    }
    double radius = options.first_radius;
    double shrink = 2.0;
    const double freedom = std::max(
        1.0, static_cast<double>(problem_.residual_count) - static_cast<double>(free_.size()));
    double promised_before = 0.0;
    linearise();
    for (result_.iterations = 0; result_.iterations < options.max_iterations;
         ++result_.iterations) {
      if (largest_slope() <= options.gradient_tolerance) return ended("the gradient vanishes");
      const Eigen::VectorXd d = step(radius);
      if (d.norm() <= options.parameter_tolerance * (where_.norm() + options.parameter_tolerance)) {
        return ended("the steps vanish");
      }
      LeastSquaresResult trial = moved(d);
      const Eigen::VectorXd expected = residuals_ + jacobian_ * d;
      if (options.stop &&
          options.stop(result_.residuals, std::vector(expected.begin(), expected.end()))) {
        result_.end = DescentEnd::limit;
        return ended("stopped");
      }
      const double promised = result_.sum_of_squares - expected.squaredNorm();
      // Geometric extrapolation: the ratio of the remaining decrease to that of this step equals
      // the ratio of this step's decrease to that of the step before.
      const double left = promised_before > 0.0 ? promised * promised / promised_before : promised;
      if (!options.finish && std::max(left, 0.0) / std::pow(options.close_enough, 2) <=
                                 expected.squaredNorm() / freedom) {
        result_.theta = std::move(trial.theta);  // without an evaluation
        Eigen::VectorXd::Map(result_.residuals.data(), expected.size()) = expected;
        result_.sum_of_squares = expected.squaredNorm();
        return ended("within the requested tolerance");
      }
      const bool answered = ask(trial);
      const double change = result_.sum_of_squares - trial.sum_of_squares;
      const bool no_more =
          answered && std::abs(change) <= options.function_tolerance * result_.sum_of_squares;
      const double kept = change / promised;
      if (answered && (kept > least_decrease || (no_more && change > 0.0))) {
        trial.iterations = result_.iterations;
        trial.end = DescentEnd::minimum;
        result_ = std::move(trial);
        if (no_more) return ended("the sum of squares no longer decreases");
        radius = std::min(largest_radius,
                          radius / std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * kept - 1.0, 3)));
        shrink = 2.0;
        promised_before = promised;
        linearise();
        continue;
      }
      if (no_more) return ended("the sum of squares no longer decreases");
      radius /= shrink;
      shrink *= 2.0;
      if (radius < least_radius) return ended("no step reduces the sum of squares");
    }
    result_.end = DescentEnd::limit;
    return ended("the iteration limit was reached");
  }

 private:
  LeastSquaresResult ended(const char* message) {
    result_.message = message;
    return std::move(result_);
  }

  bool ask(LeastSquaresResult& at) const {
    at.residuals.resize(problem_.residual_count);
    at.jacobian.resize(problem_.residual_count * at.theta.size());
    if (!problem_.evaluate(at.theta, at.residuals, at.jacobian)) return false;
    at.sum_of_squares = 0.0;
    for (const double r : at.residuals) at.sum_of_squares += r * r;
    return std::isfinite(at.sum_of_squares);
  }

  /// The way from theta_j to `bound` in the coordinate of the k-th free parameter.
  double way_to(double bound, Eigen::Index k) const {
    const std::size_t j = free_[static_cast<std::size_t>(k)];
    const double theta = result_.theta[j];
    return problem_.log_scale[j] ? std::log(bound / theta) : (bound - theta) / units_(k);
  }

  /// Sets residuals, Jacobian, position and distances to the bounds in the coordinates of the free
  /// parameters.
  void linearise() {
    const auto n = static_cast<Eigen::Index>(result_.residuals.size());
    const auto q = static_cast<Eigen::Index>(free_.size());
    const std::size_t p = result_.theta.size();
    residuals_ = Eigen::Map<const Eigen::VectorXd>(result_.residuals.data(), n);
    jacobian_.resize(n, q);
    where_.resize(q);
    low_.resize(q);
    high_.resize(q);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double* const row = &result_.jacobian[static_cast<std::size_t>(i) * p];
      for (Eigen::Index k = 0; k < q; ++k) {
        jacobian_(i, k) = row[free_[static_cast<std::size_t>(k)]];
      }
    }
    for (Eigen::Index k = 0; k < q; ++k) {
      const std::size_t j = free_[static_cast<std::size_t>(k)];
      const double theta = result_.theta[j];
      if (const double length = jacobian_.col(k).norm(); theta != 0.0) {
        units_(k) = std::max(units_(k), power_of_two(theta));
      } else if (units_(k) == 0.0) {
        units_(k) = length > 0.0 ? power_of_two(1.0 / length) : 1.0;
      }
      jacobian_.col(k) *= problem_.log_scale[j] ? theta : units_(k);
      where_(k) = problem_.log_scale[j] ? std::log(theta) : theta / units_(k);
      low_(k) = way_to(problem_.lower[j], k);
      high_(k) = way_to(problem_.upper[j], k);
    }
    reduce_rows();
  }

  /// Sets `triangle_`: the triangular factor of [J r], once for all radii.
  void reduce_rows() {
    const auto rows = [this](Eigen::Index first, Eigen::Index count) {
      Eigen::MatrixXd some(count, jacobian_.cols() + 1);
      some << jacobian_.middleRows(first, count), residuals_.segment(first, count);
      return some;
    };
    triangle_ = triangular_factor(jacobian_.rows(), jacobian_.cols() + 1, rows);
  }

  /// Largest component of the gradient, projected onto the bounds.
  double largest_slope() const {
    const Eigen::ArrayXd slope = (jacobian_.transpose() * residuals_).array();
    return (-slope).max(low_.array()).min(high_.array()).abs().maxCoeff();
  }

  Eigen::VectorXd step(double radius) const {
    const Eigen::Index q = jacobian_.cols();
    const Eigen::VectorXd lengths = jacobian_.colwise().norm().cwiseMax(shortest_column);
    Eigen::MatrixXd rows(triangle_.rows() + q, q);
    rows.topRows(triangle_.rows()) = triangle_.leftCols(q);
    rows.bottomRows(q) = Eigen::MatrixXd(lengths.asDiagonal()) / std::sqrt(radius);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(rows.rows());
    right.head(triangle_.rows()) = triangle_.col(q);
    const Eigen::HouseholderQR<Eigen::MatrixXd> factors(rows);
    right.applyOnTheLeft(factors.householderQ().adjoint());
    const Eigen::MatrixXd R = factors.matrixQR().topRows(q).triangularView<Eigen::Upper>();
    const Eigen::VectorXd c = right.head(q);
    return BoxedStep(R, c, low_, high_).solved();
  }

  LeastSquaresResult moved(const Eigen::VectorXd& d) const {
    LeastSquaresResult to;
    to.theta = result_.theta;
    for (Eigen::Index k = 0; k < d.size(); ++k) {
      const std::size_t j = free_[static_cast<std::size_t>(k)];
      if (d(k) == 0.0) continue;
      const double theta =
          problem_.log_scale[j] ? to.theta[j] * std::exp(d(k)) : to.theta[j] + units_(k) * d(k);
      to.theta[j] = d(k) <= low_(k)    ? problem_.lower[j]
                    : d(k) >= high_(k) ? problem_.upper[j]
                                       : std::clamp(theta, problem_.lower[j], problem_.upper[j]);
    }
    return to;
  }

  const LeastSquaresProblem& problem_;
  std::vector<std::size_t> free_;
  LeastSquaresResult result_;
  Eigen::VectorXd residuals_, units_, where_, low_, high_;
  Eigen::MatrixXd jacobian_, triangle_;
};

}  // namespace

LeastSquaresResult descend_in_box(const LeastSquaresProblem& problem, std::span<const double> start,
                                  const std::vector<bool>& fixed,
                                  const LeastSquaresOptions& options) {
  return BoxDescent(problem, start, fixed).run(options);
}

}  // namespace recoil
