// What an outside suite sees: one header, one target. Fits a straight line, makes its intervals and
// says by its exit status whether the closed forms came out.
#include "uncertainty/estimator.hpp"

int main() {
  const double inf = 1e300;
  const double x[] = {0, 1, 2, 3, 4};
  const double y[] = {1, 3, 2, 5, 4};
  recoil::LeastSquaresProblem problem;
  problem.residual_count = 5;
  problem.lower = {-inf, -inf};
  problem.upper = {inf, inf};
  problem.log_scale = {false, false};
  problem.evaluate = [&](std::span<const double> t, std::span<double> r, std::span<double> j) {
    for (std::size_t i = 0; i < 5; ++i) {
      r[i] = t[0] + t[1] * x[i] - y[i];
      if (!j.empty()) {
        j[2 * i] = 1.0;
        j[2 * i + 1] = x[i];
      }
    }
    return true;
  };
  const double start[] = {0.0, 0.0};
  const recoil::LeastSquaresResult fit = recoil::minimise(problem, start);
  const auto near = [](double a, double b) { return a - b < 1e-6 && b - a < 1e-6; };
  // Slope 0.8 and sum of squares 3.6; s^2 = 1.2 with 3 degrees of freedom, var(slope) = 0.12,
  // Student's quantile 3.182446305.
  const recoil::Interval wald =
      recoil::wald_interval(fit.theta[1], 0.3464101615137755, 0.95, 3, -inf, inf);
  const bool good = fit.converged && near(fit.theta[1], 0.8) && near(fit.sum_of_squares, 3.6) &&
                    wald.available() && near(*wald.upper, 0.8 + 3.182446305284263 * 0.34641016);
  return good ? 0 : 1;
}
