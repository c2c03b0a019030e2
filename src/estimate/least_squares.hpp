#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/names.hpp"

namespace recoil {

/// A bounded nonlinear least-squares problem: minimise sum_i r_i(theta)^2 with lower <= theta <=
/// upper. It is independent of impacts.
struct LeastSquaresProblem {
  /// Fills `residuals` [n] and, unless it is empty, `jacobian` [n x p, row major],
  ///   jacobian[i * p + j] = d residuals[i] / d theta[j].
  /// Returns false if the residuals cannot be computed at theta; the minimiser then shortens the
  /// step.
  using Evaluate = std::function<bool(std::span<const double> theta, std::span<double> residuals,
                                      std::span<double> jacobian)>;

  std::size_t residual_count = 0;
  std::vector<double> lower;    ///< [p], -infinity allowed
  std::vector<double> upper;    ///< [p]
  std::vector<bool> log_scale;  ///< [p] true: minimised in ln(theta); requires lower > 0
  std::vector<bool> fixed;      ///< [p] true: kept at the start; empty: none
  /// If set, overwrites fixed parameters of a start by the values at which they are kept.
  std::function<void(std::span<double> start)> hold;
  Evaluate evaluate;
};

/// Algorithms of `minimise`.
enum class Strategy {
  trust_region,  ///< Levenberg-Marquardt of Ceres: the most robust far from the minimum
  box_descent,  ///< Levenberg-Marquardt of `descend_in_box`: fewer evaluations if steps meet bounds
  gauss_newton,  ///< `gauss_newton_from`: few evaluations from a start near the minimum and away
                 ///< from the bounds; fails elsewhere
};
constexpr auto names_of_values(Strategy) {
  return name_list("trust_region", "box_descent", "gauss_newton");
}

struct LeastSquaresOptions {
  /// Tried in turn until one succeeds. The last is trust_region or box_descent.
  std::vector<Strategy> strategies = {Strategy::trust_region};
  int max_iterations = 2000;
  double function_tolerance = 1e-14;  ///< relative change of the sum of squares
  double gradient_tolerance = 1e-14;
  double parameter_tolerance = 1e-11;  ///< relative change of theta
  /// Ends with Gauss-Newton steps until no digit of theta changes (`finish_by_gauss_newton`); the
  /// descent alone determines half of the digits. Costs one or two Jacobians if the residuals are
  /// nearly linear.
  bool finish = true;
  /// Without `finish`, gauss_newton and box_descent end if the estimated distance to the minimum is
  /// at most this, in standard errors for residuals with a scatter of 1.
  double close_enough = 3e-7;
  /// First radius of the trust region, in parameters scaled by the Jacobian.
  double first_radius = 1e4;
  /// If set, box_descent asks it before every step, with the residuals there and those that the
  /// linearised problem has after the step, and ends as `limit` if it is true.
  std::function<bool(std::span<const double> now, std::span<const double> after)> stop;
};

/// How a minimisation ended.
enum class DescentEnd {
  minimum,    ///< a minimum that the residuals determine
  valley,     ///< a minimum at which some combination of parameters has no effect
  flat,       ///< the residuals do not depend on a parameter: its value is undetermined
  limit,      ///< the iteration limit was reached, or `stop` was true
  no_answer,  ///< the residuals cannot be evaluated
};
constexpr auto names_of_values(DescentEnd) {
  return name_list("minimum", "valley", "flat", "limit", "no_answer");
}

struct LeastSquaresResult {
  Strategy strategy = Strategy::trust_region;  ///< the strategy that succeeded
  DescentEnd end = DescentEnd::no_answer;
  bool converged = false;     ///< ended as minimum or valley
  std::string message;        ///< message of the minimiser
  std::vector<double> theta;  ///< [p]
  double sum_of_squares = 0.0;
  int iterations = 0;
  std::vector<double> residuals;   ///< [n] at theta
  std::vector<double> jacobian;    ///< [n x p] at theta
  std::vector<bool> at_bound;      ///< [p] rests on a bound
  std::vector<std::size_t> flat;   ///< the parameters without effect, if `end` is flat
  std::vector<double> covariance;  ///< [p x p] (J'J)^-1; zero rows for fixed parameters and those
                                   ///< at a bound; empty when J'J is singular or the end is flat

  /// Did it converge, or end where a parameter has no effect?
  bool ended() const { return converged || end == DescentEnd::flat; }
};

/// Minimises `problem` from `start` by the strategies of `options`. Parameters that rest on a bound
/// satisfy the Karush-Kuhn-Tucker conditions there. A descent that ends as flat is repeated from
/// the start with short steps. A parameter is flat if a change of 1e8 times its value, its distance
/// from the start or its range is needed to change the residuals by their own norm.
LeastSquaresResult minimise(const LeastSquaresProblem& problem, std::span<const double> start,
                            const LeastSquaresOptions& options = {});

/// The leverage of each point: the diagonal of J C J' with C = (J'J)^-1.
/// @param jacobian J [n x p, row major]
/// @param covariance C [p x p]
std::vector<double> leverages(std::span<const double> jacobian, std::span<const double> covariance);

/// Upper limit of a leverage in use: a point that the fit passes through gives no information about
/// its own noise.
inline constexpr double most_leverage = 0.99;

}  // namespace recoil
