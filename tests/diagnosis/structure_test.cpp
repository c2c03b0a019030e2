#include "diagnosis/structure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "estimate/residual.hpp"

namespace recoil {
namespace {

constexpr std::size_t sizes = 3;
constexpr std::size_t speeds = 12;

/// Three diameters at twelve velocities, and a model of one parameter that moves all points alike.
struct Case {
  Observations data;
  Weights weights;
  Refit fitted;
  std::vector<double> predicted;

  Case() {
    for (std::size_t s = 0; s < sizes; ++s) {
      for (std::size_t v = 0; v < speeds; ++v) {
        Observation point;
        point.series = s;
        point.diameter = 1e-6 * std::pow(2.0, static_cast<double>(s));
        point.velocity = std::pow(1.4, static_cast<double>(v));
        point.restitution = 0.7;
        data.points.push_back(point);
        weights.points.emplace_back().sd = 0.02;
      }
    }
    fitted.usable = true;
    fitted.theta = {1.0};
    fitted.moving = {true};
    fitted.residuals.assign(data.points.size(), 0.0);
    fitted.jacobian.assign(data.points.size(), 1.0);
    predicted.assign(data.points.size(), 0.49);
  }
  StructureStatistics statistics(const std::vector<std::vector<double>>& shapes = {}) const {
    return {data, weights, fitted, predicted, shapes};
  }
};

std::vector<double> noise(std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::vector<double> z(sizes * speeds);
  for (double& value : z) value = normal(random);
  return z;
}

double p_of(const Structure& structure, StructureQuestion question) {
  for (const StructureTest& test : structure.tests) {
    if (test.question == question) return test.p_value;
  }
  ADD_FAILURE() << name_of(question);
  return -1.0;
}

/// The structure of noise with `shape` added.
Structure structure_with(const std::vector<double>& shape, unsigned seed) {
  Case made;
  std::mt19937 random(seed);
  std::vector<double> r = noise(random);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] += shape[i];
  made.fitted.residuals = made.statistics().residuals_of_noise({r}).front();
  return quick_structure(made.data, made.weights, made.fitted, made.predicted,
                         white_noise(499, made.data.points.size(), 7));
}

TEST(Structure, LeavesOutWhatTheModelCanFollow) {
  const Case made;
  std::mt19937 random(3);
  const std::vector<double> r = made.statistics().residuals_of_noise({noise(random)}).front();
  double sum = 0.0;
  for (const double value : r) sum += value;
  EXPECT_NEAR(sum, 0.0, 1e-12);
}

TEST(Structure, AccusesPureNoiseInFivePerCentOfCases) {
  Case made;
  std::mt19937 random(11);
  constexpr int cases = 400;
  int accused = 0;
  for (int k = 0; k < cases; ++k) {
    made.fitted.residuals = made.statistics().residuals_of_noise({noise(random)}).front();
    const Structure found =
        quick_structure(made.data, made.weights, made.fitted, made.predicted,
                        white_noise(199, made.data.points.size(), static_cast<std::uint64_t>(k)));
    accused += found.p_value <= 0.05 ? 1 : 0;
  }
  // Binomial with 5 %: 20 of 400, standard deviation 4.4.
  EXPECT_GE(accused, 6);
  EXPECT_LE(accused, 34);
}

TEST(Structure, SeesADiameterThatIsOff) {
  std::vector<double> shape(sizes * speeds, 0.0);
  std::fill_n(shape.begin() + speeds, speeds, 1.5);
  const Structure found = structure_with(shape, 5);
  EXPECT_LE(p_of(found, StructureQuestion::size), 0.01);
  EXPECT_LE(found.p_value, 0.05);
  EXPECT_GT(p_of(found, StructureQuestion::trend), 0.01);
}

TEST(Structure, SeesAWaveInTheLogarithmOfTheVelocity) {
  std::vector<double> shape;
  for (std::size_t i = 0; i < sizes * speeds; ++i) {
    const double u = static_cast<double>(i % speeds) / (speeds - 1.0);
    shape.push_back(1.8 * std::sin(2.0 * std::numbers::pi * 2.0 * u));
  }
  const Structure found = structure_with(shape, 6);
  EXPECT_LE(p_of(found, StructureQuestion::smooth), 0.01);
  EXPECT_LE(found.p_value, 0.02);
  EXPECT_TRUE(found.smooth);
}

/// Twenty shapes, one for each cause: a bend of one size below or above a velocity.
std::vector<std::vector<double>> bends() {
  std::vector<std::vector<double>> shapes;
  for (std::size_t k = 0; k < 20; ++k) {
    std::vector<double> shape(sizes * speeds, 0.0);
    const std::size_t from = 2 + k / 6;
    for (std::size_t v = 0; v < speeds; ++v) {
      const bool slow = k % 2 == 0;
      const std::size_t place = slow ? speeds - 1 - v : v;
      const double beyond = static_cast<double>(place) - static_cast<double>(speeds - from);
      if (beyond >= 0.0) shape[(k / 2 % sizes) * speeds + v] = 1.0 + beyond;
    }
    shapes.push_back(shape);
  }
  return shapes;
}

/// The p-value of residuals [points], calibrated on white noise, with the shapes of causes or not.
double p_with(const std::vector<double>& residuals, const std::vector<std::vector<double>>& shapes,
              std::uint64_t seed) {
  const Case made;
  const StructureStatistics statistics = made.statistics(shapes);
  return judge_structure(statistics, statistics.residuals_of_noise({residuals}).front(),
                         statistics(statistics.residuals_of_noise(
                             white_noise(199, made.data.points.size(), seed))))
      .p_value;
}

TEST(Structure, SeesTheShapeOfACauseThatNoOtherTestSees) {
  std::mt19937 random(21);
  constexpr int cases = 200;
  const std::vector<std::vector<double>> shapes = bends();
  int accused = 0, seen = 0, seen_without = 0;
  for (int k = 0; k < cases; ++k) {
    std::vector<double> r = noise(random);
    const auto seed = static_cast<std::uint64_t>(k);
    accused += p_with(r, shapes, seed) <= 0.05 ? 1 : 0;
    const std::vector<double>& shape = shapes[static_cast<std::size_t>(k) % shapes.size()];
    double length = 0.0;
    for (const double value : shape) length += value * value;
    for (std::size_t i = 0; i < r.size(); ++i) r[i] += 4.5 * shape[i] / std::sqrt(length);
    seen += p_with(r, shapes, seed) <= 0.05 ? 1 : 0;
    seen_without += p_with(r, {}, seed) <= 0.05 ? 1 : 0;
  }
  std::printf("of %d: noise accused %d, shapes seen %d, without the shapes %d\n", cases, accused,
              seen, seen_without);
  EXPECT_LE(accused, 20);  // binomial with 5 %: more has a chance of 1 in 400
  EXPECT_GT(seen, seen_without + cases / 10);
}

TEST(Structure, TellsLargeScatterFromShape) {
  Case made;
  std::mt19937 random(9);
  constexpr int cases = 100;
  int accused = 0;
  for (int k = 0; k < cases; ++k) {
    std::vector<double> r = noise(random);
    for (double& value : r) value *= 1.8;
    made.fitted.residuals = made.statistics().residuals_of_noise({r}).front();
    made.data.noise.sd_stated = false;  // nobody said how large it should be
    const Structure found =
        quick_structure(made.data, made.weights, made.fitted, made.predicted,
                        white_noise(199, made.data.points.size(), static_cast<std::uint64_t>(k)));
    for (const StructureTest& test : found.tests)
      ASSERT_NE(test.question, StructureQuestion::scatter);
    accused += found.p_value <= 0.05 ? 1 : 0;
  }
  EXPECT_LE(accused, 12);  // binomial with 5 %: more has a chance of 1 in 500
  made.data.noise.sd_stated = true;
  EXPECT_LE(p_of(quick_structure(made.data, made.weights, made.fitted, made.predicted,
                                 white_noise(199, made.data.points.size(), 1)),
                 StructureQuestion::scatter),
            0.01);
}

TEST(Structure, FreeFormFollowsAWaveAndLeavesNoiseAlone) {
  const Case made;
  std::vector<double> wave;
  for (std::size_t i = 0; i < sizes * speeds; ++i) {
    const double u = static_cast<double>(i % speeds) / (speeds - 1.0);
    wave.push_back(3.0 * std::sin(2.0 * std::numbers::pi * u));
  }
  const std::vector<double> r = made.statistics().residuals_of_noise({wave}).front();
  const std::vector<double> shape = made.statistics().free_form(r);
  ASSERT_EQ(shape.size(), r.size());
  double left = 0.0, before = 0.0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    left += (r[i] - shape[i]) * (r[i] - shape[i]);
    before += r[i] * r[i];
  }
  EXPECT_LT(left, 0.02 * before);
  EXPECT_TRUE(made.statistics().free_form(std::vector<double>(r.size(), 0.0)).empty());
}

/// Drops from heights 2, 4, ... m/s apart, and a model of one parameter, 1 - e^2 = c V.
struct Drops {
  Observations data;
  Weights weights;
  Refit fitted;
  std::vector<double> predicted;

  Drops(int heights, int each, bool stated) {
    data.noise.sd_stated = stated;
    for (int h = 0; h < heights; ++h) {
      for (int i = 0; i < each; ++i) {
        Observation point;
        point.diameter = 0.02;
        point.velocity = 2.0 * std::pow(5.0, heights > 1 ? h / (heights - 1.0) : 0.0);
        predicted.push_back(1.0 - 0.03 * point.velocity);
        // Single readings, so that the weights of one height differ.
        point.restitution = std::sqrt(predicted.back()) + 0.01 * (i % 3 - 1);
        data.points.push_back(point);
        weights.points.emplace_back().sd = 0.01;
      }
    }
    fitted.usable = true;
    fitted.theta = {0.03};
    fitted.moving = {true};
    for (std::size_t i = 0; i < data.points.size(); ++i) {
      fitted.jacobian.push_back(-slope(i) * data.points[i].velocity);
    }
    fitted.residuals.assign(data.points.size(), 0.0);
  }
  double slope(std::size_t i) const {
    return weighted_residual(data.points[i], weights.points[i], predicted[i], std::nullopt).slope;
  }
  /// p-value of noise with an error of e of `off[i]`.
  double p_of(std::mt19937& random, const std::vector<double>& off, std::uint64_t seed) {
    std::normal_distribution<double> normal;
    std::vector<double> r;
    for (std::size_t i = 0; i < data.points.size(); ++i) {
      r.push_back(normal(random) + off[i] * 2.0 * std::sqrt(predicted[i]) * slope(i));
    }
    const StructureStatistics statistics(data, weights, fitted, predicted);
    fitted.residuals = statistics.residuals_of_noise({r}).front();
    return quick_structure(data, weights, fitted, predicted,
                           white_noise(199, data.points.size(), seed))
        .p_value;
  }
};

TEST(Structure, AsksNothingOfVelocityWithNoMoreVelocitiesThanParameters) {
  for (const bool stated : {false, true}) {
    const Drops drops(1, 10, stated);
    const StructureStatistics statistics(drops.data, drops.weights, drops.fitted, drops.predicted);
    for (const StructureQuestion question : values_of<StructureQuestion>()) {
      EXPECT_EQ(statistics.asks(question), stated && question == StructureQuestion::scatter)
          << name_of(question);
    }
  }
  Drops unknown(5, 3, false);
  unknown.weights.noise.known = false;
  const StructureStatistics statistics(unknown.data, unknown.weights, unknown.fitted,
                                       unknown.predicted);
  for (const StructureQuestion question : values_of<StructureQuestion>()) {
    EXPECT_FALSE(statistics.asks(question));
  }
}

TEST(Structure, AccusesDropsFromAnyNumberOfHeightsInFivePerCent) {
  std::mt19937 random(17);
  constexpr int sets = 100;
  for (const bool stated : {false, true}) {
    int accused = 0, all = 0;
    for (const int heights : {1, 2, 3, 5, 17}) {
      for (const int each : {3, 5, 10}) {
        Drops drops(heights, each, stated);
        const std::vector<double> nothing(drops.data.points.size(), 0.0);
        int here = 0;
        for (int k = 0; k < sets; ++k) {
          here += drops.p_of(random, nothing, static_cast<std::uint64_t>(k)) <= 0.05 ? 1 : 0;
        }
        EXPECT_LE(here, 13) << heights << " heights, " << each << " drops";  // 5 +- 2.2
        accused += here;
        all += sets;
      }
    }
    EXPECT_LE(accused, 0.05 * all + 3.0 * std::sqrt(0.0475 * all)) << stated;
  }
}

/// e is the same at all heights, which the model cannot follow. Where its curve, refitted, is off
/// by three standard errors of a mean at every height, it passes in 5 % of data sets at most.
TEST(Structure, SeesACurveThatIsOffByThreeStandardErrorsOfAMean) {
  std::mt19937 random(23);
  constexpr int sets = 100;
  for (const bool stated : {false, true}) {
    for (const int heights : {3, 5, 17}) {
      Drops drops(heights, 5, stated);
      std::vector<double> off;
      for (const Observation& point : drops.data.points) off.push_back(std::log(point.velocity));
      // What the model leaves of it, scaled so that the root mean square over heights is 3 errors.
      const StructureStatistics statistics(drops.data, drops.weights, drops.fitted,
                                           drops.predicted);
      std::vector<double> r;
      for (std::size_t i = 0; i < off.size(); ++i) {
        r.push_back(off[i] * 2.0 * std::sqrt(drops.predicted[i]) * drops.slope(i));
      }
      r = statistics.residuals_of_noise({r}).front();
      double square = 0.0;
      for (const double value : r) square += value * value;
      const double scale = 3.0 * std::sqrt(heights / square);
      for (double& value : off) value *= scale;
      int passed = 0;
      for (int k = 0; k < sets; ++k) {
        passed += drops.p_of(random, off, static_cast<std::uint64_t>(k)) > 0.05 ? 1 : 0;
      }
      EXPECT_LE(passed, 5) << heights << " heights, " << stated;
    }
  }
}

}  // namespace
}  // namespace recoil
