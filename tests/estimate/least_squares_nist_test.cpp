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
      // From the first, long steps overshoot to b2 = 84, where exp(-b2 x) and all slopes vanish.
      {{1, 1}, {100, 0.75}},
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

Certified mgh10() {
  return {"MGH10",
          {50, 55, 60, 65, 70, 75, 80, 85, 90, 95, 100, 105, 110, 115, 120, 125},
          {34780, 28610, 23650, 19630, 16370, 13720, 11540, 9744, 8261, 7030, 6005, 5147, 4427,
           3820, 3307, 2872},
          [](std::span<const double> b, double x, std::span<double> slope) {
            const double below = x + b[2];
            slope[0] = std::exp(b[1] / below);
            slope[1] = b[0] * slope[0] / below;
            slope[2] = -slope[1] * b[1] / below;
            return b[0] * slope[0];
          },
          {{2, 400000, 25000}, {0.02, 4000, 250}},
          {5.6096364710e-03, 6.1813463463e+03, 3.4522363462e+02},
          {1.5687892471e-04, 2.3309021107e+01, 7.8486103508e-01},
          8.7945855171e+01};
}

Certified mgh17() {
  Certified problem = {
      "MGH17",
      {},
      {0.844, 0.908, 0.932, 0.936, 0.925, 0.908, 0.881, 0.850, 0.818, 0.784, 0.751,
       0.718, 0.685, 0.658, 0.628, 0.603, 0.580, 0.558, 0.538, 0.522, 0.506, 0.490,
       0.478, 0.467, 0.457, 0.448, 0.438, 0.431, 0.424, 0.420, 0.414, 0.411, 0.406},
      [](std::span<const double> b, double x, std::span<double> slope) {
        slope[0] = 1.0;
        slope[1] = std::exp(-x * b[3]);
        slope[2] = std::exp(-x * b[4]);
        slope[3] = -x * b[1] * slope[1];
        slope[4] = -x * b[2] * slope[2];
        return b[0] + b[1] * slope[1] + b[2] * slope[2];
      },
      {{50, 150, -100, 1, 2}, {0.5, 1.5, -1, 0.01, 0.02}},
      {3.7541005211e-01, 1.9358469127e+00, -1.4646871366e+00, 1.2867534640e-02, 2.2122699662e-02},
      {2.0723153551e-03, 2.2031669222e-01, 2.2175707739e-01, 4.4861358114e-04, 8.9471996575e-04},
      5.4648946975e-05};
  for (std::size_t i = 0; i < problem.y.size(); ++i) {
    problem.x.push_back(10.0 * static_cast<double>(i));
  }
  return problem;
}

Certified eckerle_4() {
  return {"Eckerle4",
          {400,   405, 410,   415, 420,   425, 430,   435, 436.5, 438, 439.5, 441,
           442.5, 444, 445.5, 447, 448.5, 450, 451.5, 453, 454.5, 456, 457.5, 459,
           460.5, 462, 463.5, 465, 470,   475, 480,   485, 490,   495, 500},
          {0.0001575, 0.0001699, 0.0002350, 0.0003102, 0.0004917, 0.0008710, 0.0017418,
           0.0046400, 0.0065895, 0.0097302, 0.0149002, 0.0237310, 0.0401683, 0.0712559,
           0.1264458, 0.2073413, 0.2902366, 0.3445623, 0.3698049, 0.3668534, 0.3106727,
           0.2078154, 0.1164354, 0.0616764, 0.0337200, 0.0194023, 0.0117831, 0.0074357,
           0.0022732, 0.0008800, 0.0004579, 0.0002345, 0.0001586, 0.0001143, 0.0000710},
          [](std::span<const double> b, double x, std::span<double> slope) {
            const double u = (x - b[2]) / b[1];
            slope[0] = std::exp(-0.5 * u * u) / b[1];
            slope[1] = b[0] * slope[0] * (u * u - 1.0) / b[1];
            slope[2] = b[0] * slope[0] * u / b[1];
            return b[0] * slope[0];
          },
          {{1, 10, 500}, {1.5, 5, 450}},
          {1.5543827178e+00, 4.0888321754e+00, 4.5154121844e+02},
          {1.5408051163e-02, 4.6803020753e-02, 4.6800518816e-02},
          1.4635887487e-03};
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

// With the options as they are, and to the digits that are certified: eleven, of which the last may
// be rounded.
TEST_P(Nist, ReachesTheCertifiedValues) {
  const Certified& certified = GetParam();
  const LeastSquaresProblem problem = as_problem(certified);
  const std::size_t p = certified.value.size();
  for (const std::vector<double>& start : certified.starts) {
    const LeastSquaresResult result = minimise(problem, start);
    SCOPED_TRACE("from " + std::to_string(start[0]));
    ASSERT_TRUE(result.converged) << to_string(result.end) << ": " << result.message;
    EXPECT_EQ(result.end, DescentEnd::minimum);
    constexpr double ten_digits = 1e-10;
    EXPECT_NEAR(result.sum_of_squares / certified.sum_of_squares, 1.0, ten_digits);
    ASSERT_EQ(result.covariance.size(), p * p);
    const double variance = result.sum_of_squares / static_cast<double>(certified.x.size() - p);
    for (std::size_t k = 0; k < p; ++k) {
      EXPECT_NEAR(result.theta[k] / certified.value[k], 1.0, ten_digits) << "b" << k + 1;
      EXPECT_NEAR(std::sqrt(result.covariance[k * p + k] * variance) / certified.error[k], 1.0,
                  ten_digits)
          << "b" << k + 1;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(LeastSquares, Nist,
                         testing::Values(misra_1a(), box_bod(), mgh09(), mgh10(), mgh17(),
                                         thurber(), rat43(), eckerle_4()),
                         [](const auto& given) { return given.param.name; });

}  // namespace
}  // namespace recoil
