#include "estimate/gauss_newton.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "estimate/linearised.hpp"

namespace recoil {
namespace {

constexpr int most_steps = 30;
constexpr double all_digits = 1e-13;      // of theta
constexpr double rounding_of_sum = 1e-9;  // its residuals may be small differences of large numbers

/// A minimum on its way, in the coordinates in which it was descended to.
class GaussNewton {
 public:
  GaussNewton(const LeastSquaresProblem& problem, const std::vector<std::size_t>& moving)
      : problem_(problem), moving_(moving) {}

  /// The step from `at`, and its length in units of how far the residuals tell.
  struct Step {
    Eigen::VectorXd d;
    double length = 0.0;
  };
  std::optional<Step> step_from(const LeastSquaresResult& at) const {
    Eigen::MatrixXd jacobian = columns_of(at, moving_);
    for (std::size_t k = 0; k < moving_.size(); ++k) {
      const std::size_t j = moving_[k];
      if (problem_.log_scale[j]) jacobian.col(static_cast<Eigen::Index>(k)) *= at.theta[j];
    }
    const LinearisedResiduals linear(jacobian);
    if (linear.singular()) return std::nullopt;
    const Eigen::Map<const Eigen::VectorXd> residuals(
        at.residuals.data(), static_cast<Eigen::Index>(at.residuals.size()));
    Step step{linear.step(residuals), 0.0};
    step.length = (jacobian * step.d).norm();
    return step;
  }

  /// Goes from `from` by `d`; nothing where that leads nowhere.
  std::optional<LeastSquaresResult> gone(const LeastSquaresResult& from,
                                         const Eigen::VectorXd& d) const {
    LeastSquaresResult to = from;
    for (std::size_t k = 0; k < moving_.size(); ++k) {
      const std::size_t j = moving_[k];
      const double by = d[static_cast<Eigen::Index>(k)];
      to.theta[j] = problem_.log_scale[j] ? to.theta[j] * std::exp(by) : to.theta[j] + by;
      if (!(to.theta[j] > problem_.lower[j] && to.theta[j] < problem_.upper[j]))
        return std::nullopt;
    }
    if (!problem_.evaluate(to.theta, to.residuals, to.jacobian)) return std::nullopt;
    to.sum_of_squares = 0.0;
    for (const double r : to.residuals) to.sum_of_squares += r * r;
    if (!(to.sum_of_squares <= from.sum_of_squares * (1.0 + rounding_of_sum))) return std::nullopt;
    return to;
  }

  /// By how much of themselves `d` moves the parameters at most.
  double moves(const LeastSquaresResult& at, const Eigen::VectorXd& d) const {
    double most = 0.0;
    for (std::size_t k = 0; k < moving_.size(); ++k) {
      const double by = std::abs(d[static_cast<Eigen::Index>(k)]);
      const std::size_t j = moving_[k];
      most = std::max(most, problem_.log_scale[j] ? by : by / std::abs(at.theta[j]));
    }
    return most;
  }

 private:
  const LeastSquaresProblem& problem_;
  const std::vector<std::size_t>& moving_;
};

/// The steps so far and the ways that were gone, as differences from one place to the next.
class StepHistory {
 public:
  /// @param scale of each parameter
  explicit StepHistory(Eigen::VectorXd scale) : scale_(std::move(scale)) {}

  /// The way to go from here, `d` being the Gauss-Newton step.
  Eigen::VectorXd way(const Eigen::VectorXd& d) {
    if (last_step_.size() > 0) {
      add_column(step_changes_, d - last_step_);
      add_column(ways_, last_way_);
    }
    last_step_ = d;
    last_way_ = d;
    if (ways_.cols() > 0) {
      const Eigen::MatrixXd scaled = scale_.cwiseInverse().asDiagonal() * step_changes_;
      const Eigen::VectorXd part = scaled.colPivHouseholderQr().solve(d.cwiseQuotient(scale_));
      last_way_ -= (ways_ + step_changes_) * part;
    }
    return last_way_;
  }

 private:
  /// No more columns than parameters: the oldest goes.
  static void add_column(Eigen::MatrixXd& columns, const Eigen::VectorXd& column) {
    const Eigen::Index kept = std::min(columns.cols(), column.size() - 1);
    Eigen::MatrixXd next(column.size(), kept + 1);
    if (kept > 0) next.leftCols(kept) = columns.rightCols(kept);
    next.col(kept) = column;
    columns = std::move(next);
  }

  Eigen::VectorXd scale_, last_step_, last_way_;
  Eigen::MatrixXd step_changes_, ways_;
};

}  // namespace

Eigen::MatrixXd columns_of(const LeastSquaresResult& result,
                           const std::vector<std::size_t>& moving) {
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto n = static_cast<Eigen::Index>(result.residuals.size());
  const auto p = static_cast<Eigen::Index>(result.theta.size());
  const Eigen::Map<const RowMatrix> full(result.jacobian.data(), n, p);
  Eigen::MatrixXd columns(n, static_cast<Eigen::Index>(moving.size()));
  for (std::size_t k = 0; k < moving.size(); ++k) {
    columns.col(static_cast<Eigen::Index>(k)) = full.col(static_cast<Eigen::Index>(moving[k]));
  }
  return columns;
}

void finish_by_gauss_newton(const LeastSquaresProblem& problem,
                            const std::vector<std::size_t>& moving, LeastSquaresResult& result) {
  const GaussNewton method(problem, moving);
  std::optional<GaussNewton::Step> step = method.step_from(result);
  if (!step) return;
  Eigen::VectorXd scale = step->d.cwiseAbs();
  for (std::size_t k = 0; k < moving.size(); ++k) {
    const auto own = static_cast<Eigen::Index>(k);
    if (!(scale[own] > 0.0)) scale[own] = 1.0;
  }
  StepHistory history(std::move(scale));
  for (int count = 0; count < most_steps && method.moves(result, step->d) > all_digits; ++count) {
    auto next = method.gone(result, history.way(step->d));
    if (!next) return;
    auto next_step = method.step_from(*next);
    if (!next_step || !(next_step->length < step->length)) return;
    result = std::move(*next);
    step = std::move(next_step);
  }
}

}  // namespace recoil
