// The ways to a minimum beside the usual descent: from nearby, within a box, and with many points.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include "core/random.hpp"
#include "estimate/fit.hpp"
#include "estimate/impact_problem.hpp"
#include "small_problem.hpp"
#include "support/synthetic.hpp"

namespace recoil {
namespace {

LeastSquaresOptions nearby() {
  LeastSquaresOptions options;
  options.strategies = {Strategy::gauss_newton, Strategy::trust_region};
  options.finish = false;
  return options;
}

LeastSquaresOptions boxed() {
  LeastSquaresOptions options;
  options.strategies = {Strategy::box_descent};
  options.finish = false;
  return options;
}

/// y = a exp(-k x) at x = 0 ... 7, with errors of 0.02 that alternate; counts its evaluations.
LeastSquaresProblem noisy_decay(double a, double k, int& evaluations) {
  LeastSquaresProblem problem = unbounded(8, 2);
  problem.evaluate = [=, &evaluations](std::span<const double> t, std::span<double> r,
                                       std::span<double> j) {
    ++evaluations;
    for (std::size_t i = 0; i < 8; ++i) {
      const double x = static_cast<double>(i);
      const double y = a * std::exp(-k * x) + (i % 2 == 0 ? 0.02 : -0.02);
      r[i] = (t[0] * std::exp(-t[1] * x) - y) / 0.02;
      if (!std::isfinite(r[i])) return false;
      if (j.empty()) continue;
      j[2 * i] = std::exp(-t[1] * x) / 0.02;
      j[2 * i + 1] = -x * t[0] * std::exp(-t[1] * x) / 0.02;
    }
    return true;
  };
  return problem;
}

/// Rosenbrock's valley, residuals 1 - a and 10 (b - a^2): its floor is bent.
LeastSquaresProblem bent_valley(int& evaluations) {
  LeastSquaresProblem problem = unbounded(2, 2);
  problem.evaluate = [&](std::span<const double> t, std::span<double> r, std::span<double> j) {
    ++evaluations;
    r[0] = 1.0 - t[0];
    r[1] = 10.0 * (t[1] - t[0] * t[0]);
    if (!j.empty()) {
      j[0] = -1.0;
      j[1] = 0.0;
      j[2] = -20.0 * t[0];
      j[3] = 10.0;
    }
    return true;
  };
  return problem;
}

TEST(Nearby, AFewStepsGiveTheMinimumOfTheDescent) {
  int evaluations = 0;
  const LeastSquaresProblem problem = noisy_decay(3.0, 0.4, evaluations);
  const LeastSquaresResult whole = minimise(problem, std::array{1.0, 1.0});
  evaluations = 0;
  const LeastSquaresResult steps = minimise(problem, std::array{3.02, 0.41}, nearby());
  EXPECT_LE(evaluations, 5);
  ASSERT_TRUE(steps.converged);
  for (std::size_t j = 0; j < 2; ++j) {
    const double error = std::sqrt(whole.covariance[3 * j]);
    EXPECT_NEAR(steps.theta[j], whole.theta[j], 1e-6 * error) << j;
    EXPECT_NEAR(steps.covariance[3 * j], whole.covariance[3 * j], 1e-3 * error * error) << j;
  }
  EXPECT_NEAR(steps.sum_of_squares, whole.sum_of_squares, 1e-9);
}

TEST(Nearby, AWayThatIsTooLongIsDescended) {
  int evaluations = 0;
  const LeastSquaresProblem problem = noisy_decay(3.0, 0.4, evaluations);
  for (const std::array<double, 2> start : {std::array{0.1, 3.0}, std::array{30.0, 0.01}}) {
    const LeastSquaresResult result = minimise(problem, start, nearby());
    ASSERT_TRUE(result.converged) << start[0];
    EXPECT_NEAR(result.theta[0], 3.0, 0.1) << start[0];
    EXPECT_NEAR(result.theta[1], 0.4, 0.05) << start[0];
  }
}

TEST(Nearby, AMinimumAtABoundIsFoundThere) {
  int evaluations = 0;
  LeastSquaresProblem problem = bent_valley(evaluations);
  problem.upper[0] = 0.5;  // then b = a^2
  for (const bool by_box : {false, true}) {
    LeastSquaresOptions options = nearby();
    if (by_box) options.strategies.back() = Strategy::box_descent;
    const LeastSquaresResult result = minimise(problem, std::array{0.45, 0.2}, options);
    ASSERT_TRUE(result.converged) << result.message;
    EXPECT_EQ(result.theta[0], 0.5);
    EXPECT_NEAR(result.theta[1], 0.25, 1e-6);
    EXPECT_TRUE(result.at_bound[0]);
    EXPECT_FALSE(result.at_bound[1]);
  }
}

TEST(Descents, DoNotDependOnTheUnitsOfTheParameters) {
  for (const Strategy by : {Strategy::box_descent, Strategy::trust_region}) {
    LeastSquaresOptions options;
    options.strategies = {by};
    int evaluations = 0;
    const LeastSquaresProblem problem = noisy_decay(3.0, 0.4, evaluations);
    const LeastSquaresResult plain = minimise(problem, std::array{1.0, 1.0}, options);
    const int needed = std::exchange(evaluations, 0);
    const double units[] = {std::ldexp(1.0, 60), std::ldexp(1.0, -90)};  // cost no digit
    LeastSquaresProblem in_units = problem;
    in_units.evaluate = [&](std::span<const double> t, std::span<double> r, std::span<double> j) {
      if (!problem.evaluate(std::array{t[0] / units[0], t[1] / units[1]}, r, j)) return false;
      for (std::size_t i = 0; i < j.size(); ++i) j[i] /= units[i % 2];
      return true;
    };
    const LeastSquaresResult result = minimise(in_units, std::array{units[0], units[1]}, options);
    ASSERT_TRUE(plain.converged && result.converged) << result.message;
    for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(result.theta[k], plain.theta[k] * units[k]) << k;
    EXPECT_EQ(evaluations, needed);
  }
}

TEST(Descents, AValueNearABoundOfZeroIsNotAtTheBound) {
  // r = 10^19 t - 1 +- 0.1, like a Hamaker constant of 1e-19 J, and t >= 0.
  LeastSquaresProblem problem = unbounded(2, 1);
  problem.lower[0] = 0.0;
  problem.evaluate = [](std::span<const double> t, std::span<double> r, std::span<double> j) {
    for (std::size_t i = 0; i < 2; ++i) {
      r[i] = 1e19 * t[0] - (i == 0 ? 0.9 : 1.1);
      if (!j.empty()) j[i] = 1e19;
    }
    return true;
  };
  for (const Strategy by : {Strategy::box_descent, Strategy::trust_region}) {
    LeastSquaresOptions options;
    options.strategies = {by};
    const LeastSquaresResult result = minimise(problem, std::array{3e-20}, options);
    ASSERT_TRUE(result.converged) << result.message;
    EXPECT_NEAR(result.theta[0], 1e-19, 1e-28);
    EXPECT_FALSE(result.at_bound[0]);
    EXPECT_NEAR(result.covariance[0], 0.5e-38, 1e-45);
  }
}

TEST(Boxed, TwoBoundsActAtOnce) {
  const LeastSquaresProblem problem = two_bounds_at_once();
  for (const std::array<double, 3> start :
       {std::array{0.0, 5.0, 7.0}, std::array{1.0, 0.0, 7.0}, std::array{1.0, 9.0, -7.0}}) {
    const LeastSquaresResult result = minimise(problem, start, boxed());
    ASSERT_TRUE(result.converged) << result.message;
    EXPECT_EQ(result.theta[0], 1.0);
    EXPECT_EQ(result.theta[1], 0.0);
    EXPECT_NEAR(result.theta[2], -1.0, 1e-6);
    EXPECT_TRUE(result.at_bound[0] && result.at_bound[1] && !result.at_bound[2]);
  }
}

TEST(Boxed, LeavesBoundsThatDoNotHold) {
  int evaluations = 0;
  LeastSquaresProblem problem = bent_valley(evaluations);
  problem.lower = {-1.5, 0.0};
  problem.upper = {2.0, 3.0};
  for (const double a : {-1.5, 2.0}) {
    for (const double b : {0.0, 3.0}) {
      const LeastSquaresResult result = minimise(problem, std::array{a, b}, boxed());
      ASSERT_TRUE(result.converged) << a << " " << b << ": " << result.message;
      EXPECT_NEAR(result.theta[0], 1.0, 1e-5) << a << " " << b;
      EXPECT_NEAR(result.theta[1], 1.0, 1e-5) << a << " " << b;
    }
  }
}

TEST(Boxed, InLogarithmsToABoundAndToTheMinimum) {
  int evaluations = 0;
  LeastSquaresProblem problem = noisy_decay(3.0, 0.4, evaluations);
  problem.lower = {1e-3, 1e-3};
  problem.log_scale = {true, true};
  const LeastSquaresResult free = minimise(problem, std::array{30.0, 2.0}, boxed());
  ASSERT_TRUE(free.converged) << free.message;
  EXPECT_NEAR(free.theta[0], 3.0, 0.1);
  EXPECT_NEAR(free.theta[1], 0.4, 0.05);
  problem.upper[1] = 0.3;
  const LeastSquaresResult held = minimise(problem, std::array{30.0, 0.01}, boxed());
  ASSERT_TRUE(held.converged) << held.message;
  EXPECT_EQ(held.theta[1], 0.3);
  EXPECT_TRUE(held.at_bound[1]);
  // a by linear regression on exp(-0.3 x).
  double along = 0.0;
  double square = 0.0;
  for (int i = 0; i < 8; ++i) {
    const double y = 3.0 * std::exp(-0.4 * i) + (i % 2 == 0 ? 0.02 : -0.02);
    along += y * std::exp(-0.3 * i);
    square += std::exp(-0.6 * i);
  }
  EXPECT_NEAR(held.theta[0], along / square, 1e-7);
}

/// It is asked with the residuals where it stands, and with those of the linearised problem.
TEST(Boxed, StopEndsTheDescentWhereItIsTrue) {
  int evaluations = 0;
  const LeastSquaresProblem problem = noisy_decay(3.0, 0.4, evaluations);
  const LeastSquaresResult whole = minimise(problem, std::array{1.0, 1.0}, boxed());
  const int needed = std::exchange(evaluations, 0);
  const auto distance = [&](std::span<const double> residuals) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 8; ++i) sum += std::pow(residuals[i] - whole.residuals[i], 2);
    return sum;
  };
  LeastSquaresOptions options = boxed();
  double now_at = 0.0;
  options.stop = [&](std::span<const double> now, std::span<const double> after) {
    now_at = distance(now);
    return distance(after) < 1.0;
  };
  const LeastSquaresResult stopped = minimise(problem, std::array{1.0, 1.0}, options);
  EXPECT_EQ(stopped.end, DescentEnd::limit);
  EXPECT_FALSE(stopped.ended());
  EXPECT_LT(evaluations, needed);
  EXPECT_NEAR(distance(stopped.residuals), now_at, 1e-9);
  EXPECT_GT(now_at, 1.0);
}

TEST(Boxed, NoAnswerAtTheStartIsSaid) {
  LeastSquaresProblem problem = unbounded(2, 1);
  problem.evaluate = [](std::span<const double>, std::span<double>, std::span<double>) {
    return false;
  };
  const LeastSquaresResult result = minimise(problem, std::array{1.0}, boxed());
  EXPECT_FALSE(result.ended());
  EXPECT_EQ(result.end, DescentEnd::no_answer);
}

TEST(ManyRows, KeepTheirSumsAndTheirCovariance) {
  // y = x + 1 / 2 - (-1)^i at x = 0 ... n - 1: the normal equations have closed sums.
  constexpr std::size_t n = 50000;
  LeastSquaresProblem problem = unbounded(n, 2);
  problem.evaluate = [](std::span<const double> t, std::span<double> r, std::span<double> j) {
    for (std::size_t i = 0; i < n; ++i) {
      const double x = static_cast<double>(i);
      r[i] = t[0] + t[1] * x - (x + 0.5 - (i % 2 == 0 ? 1.0 : -1.0));
      if (j.empty()) continue;
      j[2 * i] = 1.0;
      j[2 * i + 1] = x;
    }
    return true;
  };
  constexpr double m = n;
  const double sum = m * (m - 1.0) / 2.0;
  const double square = m * (m - 1.0) * (2.0 * m - 1.0) / 6.0;
  const double determinant = m * square - sum * sum;
  // sum of (-1)^i x over an even number of points is -n / 2.
  const double slope = m * (m / 2.0) / determinant;
  for (const bool from_nearby : {false, true}) {
    LeastSquaresOptions options;
    if (from_nearby) options.strategies = {Strategy::gauss_newton, Strategy::trust_region};
    const LeastSquaresResult result = minimise(problem, std::array{0.4, 1.001}, options);
    ASSERT_TRUE(result.converged) << result.message;
    EXPECT_NEAR(result.theta[1], 1.0 + slope, 1e-13);
    EXPECT_NEAR(result.theta[0], 0.5 - slope * sum / m, 1e-9);
    EXPECT_NEAR(result.covariance[0] / (square / determinant), 1.0, 1e-9);
    EXPECT_NEAR(result.covariance[1] / (-sum / determinant), 1.0, 1e-9);
    EXPECT_NEAR(result.covariance[3] / (m / determinant), 1.0, 1e-9);
  }
}

TEST(GaussNewton, LeavesAMinimumJustBeyondABoundToTheDescentInTheBox) {
  // r = (x - 1, x + 1 + 2 b): the sum of squares is least at x = -b, where the standard error is
  // sqrt(s^2 / 2) with s^2 = 2 (1 + b)^2 for one degree of freedom.
  const double b = 0.1;
  LeastSquaresProblem problem;
  problem.residual_count = 2;
  problem.lower = {0.0};
  problem.upper = {10.0};
  problem.log_scale = {false};
  problem.evaluate = [b](std::span<const double> x, std::span<double> r, std::span<double> J) {
    r[0] = x[0] - 1.0;
    r[1] = x[0] + 1.0 + 2.0 * b;
    if (!J.empty()) J[0] = J[1] = 1.0;
    return true;
  };
  LeastSquaresOptions options;
  options.finish = false;
  options.strategies = {Strategy::gauss_newton, Strategy::box_descent};
  for (const double close_enough : {1e-6, 0.3, 1.0}) {
    options.close_enough = close_enough;
    const LeastSquaresResult result = minimise(problem, std::vector<double>{0.05}, options);
    ASSERT_TRUE(result.ended());
    EXPECT_EQ(result.theta[0], 0.0) << close_enough;
    EXPECT_NEAR(result.sum_of_squares, 1.0 + std::pow(1.0 + 2.0 * b, 2), 1e-12);
  }
}

/// The points of a small design many times over, with errors of their own.
Observations many_points(const Dataset& dataset, int times) {
  Observations data = gather({dataset});
  const std::vector<Observation> once = data.points;
  data.points.clear();
  RandomStream random(7, RandomPurpose::reconstruction, 0);
  for (int k = 0; k < times; ++k) {
    for (Observation point : once) {
      point.restitution += point.sd * random.normal();
      data.points.push_back(point);
    }
  }
  return data;
}

TEST(ManyPoints, AreFittedToTheLastDigitOnAnyNumberOfThreads) {
  const synthetic::Design design;
  const Dataset dataset = synthetic::dataset(design);
  const ImpactModel model = make_model(synthetic::spec(false), {dataset});
  const int times = 21000 / static_cast<int>(dataset.points.size()) + 1;
  const Observations data = many_points(dataset, times);
  FitOptions options;
  options.several_starts = false;
  options.threads = 1;
  const FitResult fitted = fit(model, data, options);
  ASSERT_TRUE(fitted.usable) << fitted.failure;
  EXPECT_LT(fitted.searched_points, data.points.size() / 2 + 1);
  const FitResult few = fit(model, gather({dataset}), options);
  EXPECT_EQ(few.searched_points, dataset.points.size());
  for (std::size_t j = 0; j < 2; ++j) {
    const double truth = j == 0 ? design.C_H : design.C_A;
    EXPECT_NEAR(fitted.theta[j], truth, 4.0 * fitted.std_error[j]) << j;
    EXPECT_NEAR(fitted.std_error[j] * std::sqrt(times) / few.std_error[j], 1.0, 0.05) << j;
  }
  EXPECT_NEAR(fitted.chi2 / fitted.dof, 1.0, 5.0 * std::sqrt(2.0 / fitted.dof));

  const Weights weights = first_weights(data);
  const LeastSquaresResult whole = minimise(impact_problem(model, data, weights), model.initial());
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_NEAR(fitted.theta[j], whole.theta[j], 1e-6 * fitted.std_error[j]) << j;
  }
  options.threads = 2;
  const FitResult again = fit(model, data, options);
  EXPECT_EQ(again.theta, fitted.theta);
  EXPECT_EQ(again.covariance, fitted.covariance);
  EXPECT_EQ(again.residuals, fitted.residuals);
  EXPECT_EQ(again.prediction_squared, fitted.prediction_squared);
}

}  // namespace
}  // namespace recoil
