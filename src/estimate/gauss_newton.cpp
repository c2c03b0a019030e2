#include "estimate/gauss_newton.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "estimate/linearised.hpp"

namespace recoil {
namespace {

constexpr int most_steps = 30;

constexpr Eigen::Index few_rows = 4096;  // one matrix holds them

/// The number of rows of `n` that `triangular_factor` takes at once for `q` columns: of many, as
/// many as stay in the cache.
Eigen::Index rows_at_a_time(Eigen::Index n, Eigen::Index q) {
  return std::max<Eigen::Index>(n <= few_rows ? few_rows / 2 : 256, 16 * q);
}

constexpr double all_digits = 1e-13;  // relative step below which theta does not change
// Relative; residuals may be small differences of large numbers.
constexpr double rounding_of_sum = 1e-9;

/// Gauss-Newton steps in the coordinates of the descent (ln theta for `log_scale`).
class GaussNewton {
 public:
  GaussNewton(const LeastSquaresProblem& problem, const std::vector<std::size_t>& moving)
      : problem_(problem), moving_(moving) {}

  /// The Gauss-Newton step d; its length, relative to the accuracy that the residuals allow; and
  /// the largest move of a parameter in its standard errors, for residuals with a scatter of 1.
  struct Step {
    Eigen::VectorXd d;
    double length = 0.0;
    double errors = 0.0;
  };
  std::optional<Step> step_from(const LeastSquaresResult& at) const {
    const Eigen::MatrixXd rows = linearised_rows(at, moving_);
    Eigen::MatrixXd jacobian = rows.leftCols(rows.cols() - 1);
    for (std::size_t k = 0; k < moving_.size(); ++k) {
      const std::size_t j = moving_[k];
      if (problem_.log_scale[j]) jacobian.col(static_cast<Eigen::Index>(k)) *= at.theta[j];
    }
    const LinearisedResiduals linear(jacobian);
    if (linear.singular()) return std::nullopt;
    Step step{linear.step(rows.col(rows.cols() - 1)), 0.0, 0.0};
    step.length = (jacobian * step.d).norm();
    const Eigen::ArrayXd variance = linear.covariance().diagonal();
    step.errors = std::sqrt((step.d.array().square() / variance).maxCoeff());
    return step;
  }

  /// Moves theta by `d`. @return whether it lies within the bounds
  bool move(std::vector<double>& theta, const Eigen::VectorXd& d) const {
    for (std::size_t k = 0; k < moving_.size(); ++k) {
      const std::size_t j = moving_[k];
      const double by = d[static_cast<Eigen::Index>(k)];
      theta[j] = problem_.log_scale[j] ? theta[j] * std::exp(by) : theta[j] + by;
      if (!(theta[j] > problem_.lower[j] && theta[j] < problem_.upper[j])) return false;
    }
    return true;
  }

  /// The evaluation at `from` + `d`; nullopt if infeasible or if the sum of squares grows.
  std::optional<LeastSquaresResult> try_step(const LeastSquaresResult& from,
                                             const Eigen::VectorXd& d) const {
    LeastSquaresResult to = from;
    if (!move(to.theta, d)) return std::nullopt;
    if (!problem_.evaluate(to.theta, to.residuals, to.jacobian)) return std::nullopt;
    to.sum_of_squares = 0.0;
    for (const double r : to.residuals) to.sum_of_squares += r * r;
    if (!(to.sum_of_squares <= from.sum_of_squares * (1.0 + rounding_of_sum))) return std::nullopt;
    return to;
  }

  /// Takes a small step without an evaluation. @return false, with `at` unchanged, if it leaves the
  /// bounds
  bool take_last(LeastSquaresResult& at, const Eigen::VectorXd& d) const {
    const std::vector<double> before = at.theta;
    std::vector<double> theta = before;
    if (!move(theta, d)) return false;
    at.theta = std::move(theta);
    at.sum_of_squares = 0.0;
    for (std::size_t i = 0; i < at.residuals.size(); ++i) {
      for (const std::size_t j : moving_) {
        at.residuals[i] += at.jacobian[i * before.size() + j] * (at.theta[j] - before[j]);
      }
      at.sum_of_squares += at.residuals[i] * at.residuals[i];
    }
    return true;
  }

  /// The largest relative change of a parameter by the step `d`.
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

/// History for Anderson mixing: the differences of successive Gauss-Newton steps, and the steps
/// taken.
class StepHistory {
 public:
  /// @param first the first Gauss-Newton step, which gives the scale of each parameter
  explicit StepHistory(const Eigen::VectorXd& first) : scale_(first.cwiseAbs()) {
    scale_ = (scale_.array() > 0.0).select(scale_, 1.0);
  }

  /// The mixed step to take, given the Gauss-Newton step `d`.
  Eigen::VectorXd mixed_step(const Eigen::VectorXd& d) {
    if (last_step_.size() > 0) {
      add_column(step_changes_, d - last_step_);
      add_column(mixed_steps_, last_mixed_step_);
    }
    last_step_ = d;
    last_mixed_step_ = d;
    if (mixed_steps_.cols() > 0) {
      const Eigen::MatrixXd scaled = scale_.cwiseInverse().asDiagonal() * step_changes_;
      const Eigen::VectorXd part = scaled.colPivHouseholderQr().solve(d.cwiseQuotient(scale_));
      last_mixed_step_ -= (mixed_steps_ + step_changes_) * part;
    }
    return last_mixed_step_;
  }

 private:
  /// Keeps at most one column per parameter and drops the oldest.
  static void add_column(Eigen::MatrixXd& columns, const Eigen::VectorXd& column) {
    const Eigen::Index kept = std::min(columns.cols(), column.size() - 1);
    Eigen::MatrixXd next(column.size(), kept + 1);
    if (kept > 0) next.leftCols(kept) = columns.rightCols(kept);
    next.col(kept) = column;
    columns = std::move(next);
  }

  Eigen::VectorXd scale_, last_step_, last_mixed_step_;
  Eigen::MatrixXd step_changes_, mixed_steps_;
};

}  // namespace

Eigen::MatrixXd triangular_factor(
    Eigen::Index n, Eigen::Index q,
    const std::function<Eigen::MatrixXd(Eigen::Index first, Eigen::Index count)>& rows) {
  const Eigen::Index at_a_time = rows_at_a_time(n, q);
  Eigen::MatrixXd triangle(0, q);
  for (Eigen::Index first = 0; first < n; first += at_a_time) {
    const Eigen::Index count = std::min(at_a_time, n - first);
    Eigen::MatrixXd stacked(triangle.rows() + count, q);
    stacked << triangle, rows(first, count);
    const Eigen::Index left = std::min(stacked.rows(), q);
    const Eigen::HouseholderQR<Eigen::MatrixXd> factors(stacked);
    triangle = factors.matrixQR().topRows(left).triangularView<Eigen::Upper>();
  }
  return triangle;
}

Eigen::MatrixXd linearised_rows(const LeastSquaresResult& result,
                                const std::vector<std::size_t>& moving) {
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto n = static_cast<Eigen::Index>(result.residuals.size());
  const auto p = static_cast<Eigen::Index>(result.theta.size());
  const auto q = static_cast<Eigen::Index>(moving.size());
  const Eigen::Map<const RowMatrix> full(result.jacobian.data(), n, p);
  const Eigen::Map<const Eigen::VectorXd> residuals(result.residuals.data(), n);
  const auto some = [&](Eigen::Index first, Eigen::Index count) {
    Eigen::MatrixXd rows(count, q + 1);
    for (Eigen::Index k = 0; k < q; ++k) {
      const auto j = static_cast<Eigen::Index>(moving[static_cast<std::size_t>(k)]);
      rows.col(k) = full.col(j).segment(first, count);
    }
    rows.col(q) = residuals.segment(first, count);
    return rows;
  };
  if (n <= few_rows) return some(0, n);
  return triangular_factor(n, q + 1, some);
}

std::optional<LeastSquaresResult> gauss_newton_from(const LeastSquaresProblem& problem,
                                                    std::span<const double> start,
                                                    const std::vector<bool>& fixed,
                                                    const LeastSquaresOptions& options) {
  std::vector<std::size_t> moving;
  LeastSquaresResult result;
  result.theta.assign(start.begin(), start.end());
  for (std::size_t j = 0; j < start.size(); ++j) {
    if (fixed[j]) continue;
    if (!(start[j] > problem.lower[j] && start[j] < problem.upper[j])) return std::nullopt;
    moving.push_back(j);
  }
  result.residuals.resize(problem.residual_count);
  result.jacobian.resize(problem.residual_count * start.size());
  if (moving.empty() || !problem.evaluate(result.theta, result.residuals, result.jacobian)) {
    return std::nullopt;
  }
  for (const double r : result.residuals) result.sum_of_squares += r * r;
  const GaussNewton method(problem, moving);
  const auto n = static_cast<double>(problem.residual_count);
  const double freedom = std::max(1.0, n - static_cast<double>(moving.size()));
  const auto is_close = [&](double error) {
    return std::pow(error / options.close_enough, 2) <= result.sum_of_squares / freedom;
  };
  std::optional<GaussNewton::Step> step = method.step_from(result);
  std::optional<StepHistory> history;
  double ratio = 1.0;  // of the lengths of successive steps
  int count = 0;
  bool done = false;
  while (step && count < most_steps) {
    done = method.moves(result, step->d) <= all_digits;
    if (done) break;
    if (!options.finish && is_close(ratio * step->errors)) {
      if (!method.take_last(result, step->d)) return std::nullopt;
      done = true;
      break;
    }
    if (!history) history.emplace(step->d);
    auto next = method.try_step(result, history->mixed_step(step->d));
    if (!next) break;
    auto next_step = method.step_from(*next);
    if (!next_step) return std::nullopt;
    const double shorter = next_step->length / step->length;
    if (!(shorter < 1.0)) break;
    if (!(shorter < 0.5) && !is_close(step->errors)) return std::nullopt;
    ratio = std::max(shorter, next_step->errors / step->errors);
    result = std::move(*next);
    step = std::move(next_step);
    ++count;
  }
  if (!step || !(done || is_close(step->errors))) return std::nullopt;
  result.iterations = count;
  return result;
}

void finish_by_gauss_newton(const LeastSquaresProblem& problem,
                            const std::vector<std::size_t>& moving, LeastSquaresResult& result) {
  const GaussNewton method(problem, moving);
  std::optional<GaussNewton::Step> step = method.step_from(result);
  if (!step) return;
  StepHistory history(step->d);
  for (int count = 0; count < most_steps && method.moves(result, step->d) > all_digits; ++count) {
    auto next = method.try_step(result, history.mixed_step(step->d));
    if (!next) return;
    auto next_step = method.step_from(*next);
    if (!next_step || !(next_step->length < step->length)) return;
    result = std::move(*next);
    step = std::move(next_step);
  }
}

}  // namespace recoil
