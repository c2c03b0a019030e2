#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/names.hpp"

namespace recoil {

/// A bounded nonlinear least-squares problem: minimise sum_i r_i(theta)^2 with
/// lower <= theta <= upper. It knows nothing of impacts.
struct LeastSquaresProblem {
  /// Fills `residuals` [n] and, unless it is empty, `jacobian` [n x p, row major],
  ///   jacobian[i * p + j] = d residuals[i] / d theta[j].
  /// Returns false where theta has no answer; the minimiser then steps back.
  using Evaluate = std::function<bool(std::span<const double> theta, std::span<double> residuals,
                                      std::span<double> jacobian)>;

  std::size_t residual_count = 0;
  std::vector<double> lower;    ///< [p], -infinity allowed
  std::vector<double> upper;    ///< [p]
  std::vector<bool> log_scale;  ///< [p] minimised in ln(theta); needs lower > 0
  std::vector<bool> fixed;      ///< [p] kept at the start; empty means none
  /// Where set: puts fixed parameters of a start where they are kept, whatever it says.
  std::function<void(std::span<double> start)> hold;
  Evaluate evaluate;
};

/// Ways to a minimum.
enum class Strategy {
  trust_region,  ///< Levenberg-Marquardt of Ceres: the most robust from far away
  box_descent,   ///< Levenberg-Marquardt by `descend_in_box`: fewer evaluations where steps meet
                 ///< bounds
  gauss_newton,  ///< `gauss_newton_from`: a few evaluations from a start near the minimum and away
                 ///< from the bounds; no answer from elsewhere
};
template <>
struct NamesOf<Strategy> {
  static constexpr std::array<std::string_view, 3> names = {"trust_region", "box_descent",
                                                            "gauss_newton"};
};

struct LeastSquaresOptions {
  /// Tried in turn until one ends. The last is a descent: trust_region or box_descent.
  std::vector<Strategy> strategies = {Strategy::trust_region};
  int max_iterations = 2000;
  double function_tolerance = 1e-14;  ///< relative change of the sum of squares
  double gradient_tolerance = 1e-14;
  double parameter_tolerance = 1e-11;  ///< relative change of theta
  /// Gauss-Newton steps at the end until no digit of theta moves: the descent alone stops where the
  /// sum of squares does, which knows half as many. One or two Jacobians where the residuals are
  /// nearly linear.
  bool finish = true;
  /// Gauss-Newton and box_descent, where they do not `finish`, end when what is left of the way is
  /// no longer than this, in standard errors where the residuals scatter by 1.
  double close_enough = 3e-7;
  double first_radius = 1e4;  ///< of the trust region, in parameters scaled by the Jacobian
};

/// How a minimisation ended.
enum class DescentEnd {
  minimum,    ///< at a minimum that the residuals determine
  valley,     ///< at a minimum along which some combination of parameters has no effect
  flat,       ///< where the residuals do not depend on a parameter: its value means nothing
  limit,      ///< still under way when the iterations ran out
  no_answer,  ///< the residuals cannot be evaluated
};
template <>
struct NamesOf<DescentEnd> {
  static constexpr std::array<std::string_view, 5> names = {"minimum", "valley", "flat", "limit",
                                                            "no_answer"};
};

struct LeastSquaresResult {
  Strategy strategy = Strategy::trust_region;  ///< that led here
  DescentEnd end = DescentEnd::no_answer;
  bool converged = false;     ///< at a minimum or in a valley
  std::string message;        ///< the minimiser's own words
  std::vector<double> theta;  ///< [p]
  double sum_of_squares = 0.0;
  int iterations = 0;
  std::vector<double> residuals;   ///< [n] at theta
  std::vector<double> jacobian;    ///< [n x p] at theta
  std::vector<bool> at_bound;      ///< [p] resting on a bound
  std::vector<std::size_t> flat;   ///< the parameters without effect, where that is the end
  std::vector<double> covariance;  ///< [p x p] (J'J)^-1; zero rows for fixed parameters and those
                                   ///< at a bound; empty when J'J is singular or the end is flat

  /// Did it end by itself, be it on flat ground?
  bool ended() const { return converged || end == DescentEnd::flat; }
};

/// Minimises `problem` from `start` by the strategies of `options`. Parameters that rest on a bound
/// satisfy the Karush-Kuhn-Tucker conditions there. A descent that ends on flat ground is repeated
/// from the start with short steps. Flat is a parameter that would have to change by 1e8
/// times its own size, its way or its range to move the residuals by as much as they are.
LeastSquaresResult minimise(const LeastSquaresProblem& problem, std::span<const double> start,
                            const LeastSquaresOptions& options = {});

/// The leverage of each point: the diagonal of J C J' with C = (J'J)^-1.
/// @param jacobian J [n x p, row major]
/// @param covariance C [p x p]
std::vector<double> leverages(std::span<const double> jacobian, std::span<const double> covariance);

/// What a leverage counts as at most: a point that the fit passes through says nothing of its own
/// noise.
inline constexpr double most_leverage = 0.99;

}  // namespace recoil
