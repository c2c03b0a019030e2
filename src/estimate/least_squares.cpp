#include "estimate/least_squares.hpp"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <mutex>
#include <utility>

#include "estimate/box_descent.hpp"
#include "estimate/gauss_newton.hpp"
#include "estimate/linearised.hpp"

namespace recoil {
namespace {

// A parameter that cannot change the residuals by this fraction of their norm has no effect.
constexpr double least_effect = 1e-8;

/// The coordinates z in which Ceres minimises: the free parameters only, as logarithms for
/// `log_scale`, others in a unit of the size of their start: Ceres has absolute tolerances. The
/// unit is a power of two, so that it costs no digit.
class Coordinates {
 public:
  Coordinates(const LeastSquaresProblem& problem, std::span<const double> start,
              const std::vector<bool>& held)
      : problem_(problem), theta_(start.begin(), start.end()) {
    for (std::size_t j = 0; j < theta_.size(); ++j) {
      theta_[j] = std::clamp(theta_[j], problem.lower[j], problem.upper[j]);
      const bool scaled = !problem.log_scale[j] && theta_[j] != 0.0;
      units_.push_back(scaled ? std::ldexp(1.0, std::ilogb(theta_[j])) : 1.0);
      if (!held[j]) free_.push_back(j);
    }
  }

  const std::vector<std::size_t>& free() const { return free_; }

  double to_z(std::size_t j, double theta) const {
    return problem_.log_scale[j] ? std::log(theta) : theta / units_[j];
  }
  /// d theta_j / d z_j.
  double chain(std::size_t j, double theta) const {
    return problem_.log_scale[j] ? theta : units_[j];
  }

  std::vector<double> to_theta(const double* z) const {
    std::vector<double> theta = theta_;
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const std::size_t j = free_[k];
      const double value = problem_.log_scale[j] ? std::exp(z[k]) : z[k] * units_[j];
      theta[j] = std::clamp(value, problem_.lower[j], problem_.upper[j]);
    }
    return theta;
  }

  std::vector<double> start() const {
    std::vector<double> z;
    for (const std::size_t j : free_) z.push_back(to_z(j, theta_[j]));
    return z;
  }

 private:
  const LeastSquaresProblem& problem_;
  std::vector<double> theta_;
  std::vector<double> units_;
  std::vector<std::size_t> free_;
};

/// One evaluation of a problem.
struct Answer {
  std::vector<double> theta;
  std::vector<double> residuals;
  std::vector<double> jacobian;
  double sum_of_squares = 0.0;
  bool usable = false;

  bool is_at(std::span<const double> place) const {
    return usable && std::equal(place.begin(), place.end(), theta.begin(), theta.end());
  }
};

/// Evaluates `problem` at `theta` into `answer`, whose memory is reused.
void ask(const LeastSquaresProblem& problem, std::vector<double> theta, Answer& answer) {
  answer.theta = std::move(theta);
  answer.residuals.resize(problem.residual_count);
  answer.jacobian.resize(problem.residual_count * answer.theta.size());
  answer.usable = problem.evaluate(answer.theta, answer.residuals, answer.jacobian);
  answer.sum_of_squares = 0.0;
  for (const double r : answer.residuals) answer.sum_of_squares += r * r;
}

/// The cost function for Ceres. It evaluates a trial step together with its Jacobian and keeps the
/// answer: most trials are accepted, and Ceres then needs the Jacobian at the same point. It also
/// keeps the best answer, because the descent ends there.
class Residuals : public ceres::CostFunction {
 public:
  Residuals(const LeastSquaresProblem& problem, const Coordinates& coordinates, Answer& best)
      : problem_(problem), coordinates_(coordinates), best_(best) {
    set_num_residuals(static_cast<int>(problem.residual_count));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(coordinates.free().size()));
  }

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    const Answer& answer = answer_at(coordinates_.to_theta(parameters[0]));
    if (!answer.usable) return false;
    std::copy(answer.residuals.begin(), answer.residuals.end(), residuals);
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    const std::vector<std::size_t>& free = coordinates_.free();
    const std::size_t p = answer.theta.size();
    for (std::size_t i = 0; i < answer.residuals.size(); ++i) {
      for (std::size_t k = 0; k < free.size(); ++k) {
        const std::size_t j = free[k];
        jacobians[0][i * free.size() + k] =
            answer.jacobian[i * p + j] * coordinates_.chain(j, answer.theta[j]);
      }
    }
    return true;
  }

 private:
  const Answer& answer_at(std::vector<double> theta) const {
    if (best_.is_at(theta)) return best_;
    if (last_.is_at(theta)) return last_;
    ask(problem_, std::move(theta), last_);
    if (!last_.usable || (best_.usable && !(last_.sum_of_squares <= best_.sum_of_squares)))
      return last_;
    std::swap(last_, best_);
    return best_;
  }

  const LeastSquaresProblem& problem_;
  const Coordinates& coordinates_;
  Answer& best_;
  mutable Answer last_;
};

/// @param size of the values of this parameter, for a bound of 0
bool rests_on_bound(double value, double bound, double size) {
  if (!std::isfinite(bound)) return false;
  return std::abs(value - bound) <= 1e-9 * std::max(std::abs(bound), 1e-9 * size);
}

/// The parameters that are neither fixed nor at a bound.
std::vector<std::size_t> moving_of(const LeastSquaresResult& result,
                                   const std::vector<bool>& fixed) {
  std::vector<std::size_t> moving;
  for (std::size_t j = 0; j < result.theta.size(); ++j) {
    if (!fixed[j] && !result.at_bound[j]) moving.push_back(j);
  }
  return moving;
}

/// (J'J)^-1 over the parameters `moving`, zero for all others [p x p, row major].
std::vector<double> covariance_of(const LinearisedResiduals& linear,
                                  const std::vector<std::size_t>& moving, std::size_t p) {
  std::vector<double> covariance(p * p, 0.0);
  const Eigen::MatrixXd inverse = linear.covariance();
  for (std::size_t a = 0; a < moving.size(); ++a) {
    for (std::size_t b = 0; b < moving.size(); ++b) {
      covariance[moving[a] * p + moving[b]] =
          inverse(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
    }
  }
  return covariance;
}

/// The parameters whose column of J is too short to change the residuals over any plausible range.
/// @param rows linearised at the result
std::vector<std::size_t> without_effect(const LeastSquaresProblem& problem,
                                        std::span<const double> start,
                                        const LeastSquaresResult& result,
                                        const std::vector<std::size_t>& moving,
                                        const Eigen::MatrixXd& rows) {
  std::vector<std::size_t> flat;
  const Eigen::VectorXd lengths = rows.leftCols(rows.cols() - 1).colwise().norm();
  const double residual = std::sqrt(result.sum_of_squares);
  for (std::size_t k = 0; k < moving.size(); ++k) {
    const std::size_t j = moving[k];
    const double theta = result.theta[j];
    double reach = std::max(std::abs(theta), std::abs(theta - start[j]));
    if (problem.log_scale[j]) {
      reach = std::abs(theta) * std::max(1.0, std::abs(std::log(theta / start[j])));
    } else if (std::isfinite(problem.upper[j] - problem.lower[j])) {
      reach = std::max(reach, problem.upper[j] - problem.lower[j]);
    }
    const double effect = lengths[static_cast<Eigen::Index>(k)] * reach;
    if (effect == 0.0 ? lengths[static_cast<Eigen::Index>(k)] == 0.0
                      : effect <= least_effect * residual) {
      flat.push_back(j);
    }
  }
  return flat;
}

void silence_library_log() {
  static std::once_flag once;
  std::call_once(once, [] { FLAGS_minloglevel = google::GLOG_FATAL; });
}

/// Runs Ceres from `z`, which receives the minimum; `best` receives the evaluation there.
void descend(const LeastSquaresProblem& problem, const Coordinates& coordinates,
             const LeastSquaresOptions& options, std::vector<double>& z, LeastSquaresResult& result,
             Answer& best) {
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem ceres_problem(ownership);
  Residuals residuals(problem, coordinates, best);
  ceres_problem.AddResidualBlock(&residuals, nullptr, z.data());
  for (std::size_t k = 0; k < z.size(); ++k) {
    const std::size_t j = coordinates.free()[k];
    const int index = static_cast<int>(k);
    if (std::isfinite(problem.lower[j])) {
      ceres_problem.SetParameterLowerBound(z.data(), index, coordinates.to_z(j, problem.lower[j]));
    }
    if (std::isfinite(problem.upper[j])) {
      ceres_problem.SetParameterUpperBound(z.data(), index, coordinates.to_z(j, problem.upper[j]));
    }
  }
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.logging_type = ceres::SILENT;
  solver.num_threads = 1;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = options.function_tolerance;
  solver.gradient_tolerance = options.gradient_tolerance;
  solver.parameter_tolerance = options.parameter_tolerance;
  solver.initial_trust_region_radius = options.first_radius;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &ceres_problem, &summary);
  result.end = summary.termination_type == ceres::CONVERGENCE      ? DescentEnd::minimum
               : summary.termination_type == ceres::NO_CONVERGENCE ? DescentEnd::limit
                                                                   : DescentEnd::no_answer;
  result.message = summary.message;
  result.iterations = static_cast<int>(summary.iterations.size());
}

/// Half of d (sum of squares) / d theta_j.
double slope_along(const LeastSquaresResult& result, std::size_t j) {
  const std::size_t p = result.theta.size();
  double slope = 0.0;
  for (std::size_t i = 0; i < result.residuals.size(); ++i) {
    slope += result.residuals[i] * result.jacobian[i * p + j];
  }
  return slope;
}

/// One descent with the parameters `held` kept at their start, and the evaluation at its end.
/// @param known an earlier evaluation, perhaps at the start; its memory is reused
LeastSquaresResult solve(const LeastSquaresProblem& problem, std::span<const double> start,
                         const std::vector<bool>& held, const LeastSquaresOptions& options,
                         Answer known = {}) {
  const Coordinates coordinates(problem, start, held);
  LeastSquaresResult result;
  std::vector<double> z = coordinates.start();
  if (z.empty()) {
    result.end = DescentEnd::minimum;
    result.message = "no parameter is free";
  } else {
    descend(problem, coordinates, options, z, result, known);
  }
  std::vector<double> theta = coordinates.to_theta(z.data());
  if (!known.is_at(theta)) ask(problem, std::move(theta), known);
  result.theta = std::move(known.theta);
  result.residuals = std::move(known.residuals);
  result.jacobian = std::move(known.jacobian);
  if (!known.usable) {
    result.end = DescentEnd::no_answer;
    if (result.message.empty()) result.message = "the residuals cannot be evaluated";
    return result;
  }
  result.sum_of_squares = known.sum_of_squares;
  return result;
}

/// The bound on which theta_j rests: -1 lower, +1 upper, 0 none.
int resting_side(const LeastSquaresProblem& problem, std::span<const double> start, double theta,
                 std::size_t j) {
  const double size = std::abs(start[j]);
  if (rests_on_bound(theta, problem.lower[j], size)) return -1;
  return rests_on_bound(theta, problem.upper[j], size) ? 1 : 0;
}

/// Descends within the bounds by the last strategy.
LeastSquaresResult descend_within_bounds(const LeastSquaresProblem& problem,
                                         std::span<const double> start,
                                         const std::vector<bool>& fixed,
                                         const LeastSquaresOptions& options) {
  const std::size_t p = start.size();
  std::vector<bool> held = fixed;
  const bool by_box = options.strategies.back() == Strategy::box_descent;
  LeastSquaresResult result = by_box ? descend_in_box(problem, start, fixed, options)
                                     : solve(problem, start, held, options);
  result.strategy = options.strategies.back();
  // A trust-region step that is projected onto a bound can end the descent before the other
  // parameters reach their minimum. Therefore an active-set iteration: hold the parameters at a
  // bound, descend along the others, release the parameters whose gradient points back inside, and
  // repeat until the set does not change.
  for (std::size_t round = 0; !by_box && result.end == DescentEnd::minimum; ++round) {
    bool changed = false;
    for (std::size_t j = 0; j < p; ++j) {
      if (fixed[j]) continue;
      const int side = resting_side(problem, start, result.theta[j], j);
      const bool pushed_out = side != 0 && side * slope_along(result, j) <= 0.0;
      if (pushed_out != held[j]) {
        held[j] = pushed_out;
        changed = true;
      }
    }
    if (!changed) break;
    if (round == 2 * p) {
      result.end = DescentEnd::limit;
      result.message = "parameters moved to their bounds and back without converging";
      break;
    }
    LeastSquaresResult again =
        solve(problem, result.theta, held, options,
              {result.theta, result.residuals, result.jacobian, result.sum_of_squares, true});
    again.strategy = result.strategy;
    if (again.end == DescentEnd::no_answer ||
        again.sum_of_squares > result.sum_of_squares * (1.0 + 1e-12)) {
      break;
    }
    result = std::move(again);
  }
  result.at_bound.assign(p, false);
  for (std::size_t j = 0; j < p; ++j) {
    result.at_bound[j] = !fixed[j] && resting_side(problem, start, result.theta[j], j) != 0;
  }
  return result;
}

/// One minimisation by the strategies in turn, with covariance and flat parameters at its end.
LeastSquaresResult minimise_once(const LeastSquaresProblem& problem, std::span<const double> start,
                                 const std::vector<bool>& fixed,
                                 const LeastSquaresOptions& options) {
  LeastSquaresResult result;
  bool finished = false;
  if (options.strategies.front() == Strategy::gauss_newton) {
    if (auto found = gauss_newton_from(problem, start, fixed, options)) {
      result = std::move(*found);
      result.end = DescentEnd::minimum;
      result.message = "Gauss-Newton converged";
      result.strategy = Strategy::gauss_newton;
      result.at_bound.assign(start.size(), false);
      finished = true;
    }
  }
  if (!finished) result = descend_within_bounds(problem, start, fixed, options);
  if (result.end != DescentEnd::minimum) return result;
  const std::vector<std::size_t> moving = moving_of(result, fixed);
  Eigen::MatrixXd rows = linearised_rows(result, moving);
  result.flat = without_effect(problem, start, result, moving, rows);
  if (!result.flat.empty()) {
    result.end = DescentEnd::flat;
    return result;
  }
  result.converged = true;
  if (moving.empty()) {
    result.covariance.assign(start.size() * start.size(), 0.0);
    return result;
  }
  if (options.finish && !finished) {
    finish_by_gauss_newton(problem, moving, result);
    rows = linearised_rows(result, moving);
  }
  const LinearisedResiduals linear(rows.leftCols(rows.cols() - 1));
  if (linear.singular()) {
    result.end = DescentEnd::valley;
  } else {
    result.covariance = covariance_of(linear, moving, start.size());
  }
  return result;
}

}  // namespace

LeastSquaresResult minimise(const LeastSquaresProblem& problem, std::span<const double> from,
                            const LeastSquaresOptions& options) {
  std::vector<double> start(from.begin(), from.end());
  if (problem.hold) problem.hold(start);
  assert(problem.lower.size() == start.size() && problem.upper.size() == start.size() &&
         problem.log_scale.size() == start.size());
  assert(!options.strategies.empty() && options.strategies.back() != Strategy::gauss_newton);
  silence_library_log();
  std::vector<bool> fixed = problem.fixed;
  fixed.resize(start.size(), false);
  LeastSquaresResult result = minimise_once(problem, start, fixed, options);
  constexpr double short_steps = 1e-3;  // reaches the minimum of NIST's BoxBOD from (1, 1)
  if (result.end != DescentEnd::flat || options.first_radius <= short_steps) return result;
  LeastSquaresOptions carefully = options;
  carefully.first_radius = short_steps;
  LeastSquaresResult again = minimise_once(problem, start, fixed, carefully);
  if (again.converged && again.sum_of_squares < result.sum_of_squares) return again;
  return result;
}

std::vector<double> leverages(std::span<const double> jacobian,
                              std::span<const double> covariance) {
  const std::size_t p = static_cast<std::size_t>(std::lround(std::sqrt(covariance.size())));
  const std::size_t n = p == 0 ? 0 : jacobian.size() / p;
  std::vector<double> leverage(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::span<const double> row = jacobian.subspan(i * p, p);
    for (std::size_t a = 0; a < p; ++a) {
      for (std::size_t b = 0; b < p; ++b) leverage[i] += row[a] * covariance[a * p + b] * row[b];
    }
  }
  return leverage;
}

}  // namespace recoil
