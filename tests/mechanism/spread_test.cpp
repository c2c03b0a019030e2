// Means over spheres that differ, against sums over thousands of them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "data/contact.hpp"
#include "mechanism/mechanism.hpp"
#include "mechanism/survivors_mean.hpp"
#include "one_point.hpp"

namespace recoil {
namespace {

using one_point::kBase;
using one_point::kDiameter;
using one_point::kSoft;
using one_point::square;

/// A normal z that is cut off at 2.5 has the standard deviation 0.954597 (by
/// scipy.stats.truncnorm).
constexpr double kCut = 1.0 / 0.954597;

/// Mean of exp(s z kCut) over the cut distribution.
double cut_mean(double s) {
  double sum = 0.0;
  double weights = 0.0;
  constexpr int count = 4000;
  for (int i = 0; i < count; ++i) {
    const double z = -2.5 + 5.0 * (i + 0.5) / count;
    sum += std::exp(-0.5 * z * z + s * z * kCut);
    weights += std::exp(-0.5 * z * z);
  }
  return sum / weights;
}

/// Mean e of those that come back over the cut distribution; -1 when none does.
template <class Square>
double brute_force(Square square_of) {
  double sum = 0.0;
  double weights = 0.0;
  constexpr int count = 4000;
  for (int i = 0; i < count; ++i) {
    const double z = -2.5 + 5.0 * (i + 0.5) / count;
    const double x = square_of(z);
    if (x <= 0.0) continue;
    sum += std::exp(-0.5 * z * z) * std::sqrt(x);
    weights += std::exp(-0.5 * z * z);
  }
  return weights > 0.0 ? sum / weights : -1.0;
}

double base_square(double f0, double diameter, double velocity) {
  ImpactConditions c{diameter, velocity, kSoft.density, kSoft.stiffness, f0, kBase.C_H, kBase.C_A};
  return simulate_impact_fast(impact_groups(c), {}).restitution_squared;
}

TEST(SurvivorBias, IsTheMeanOfTheSurvivors) {
  // The capture velocity of the typical sphere is about 1.28 m/s.
  for (const double spread : {0.05, 0.2, 0.4}) {
    for (const double V : {1.0, 1.2, 1.28, 1.4, 1.7, 3.0, 20.0}) {
      const double expected = brute_force([&](double z) {
        return base_square(kBase.f0 * std::exp(spread * kCut * z), kDiameter, V);
      });
      const double found = square(kSoft, {"survivor_bias"}, {spread}, kDiameter, V, kBase);
      if (expected < 0.0) {
        EXPECT_LT(found, 0.0) << spread << " " << V;
      } else {
        EXPECT_NEAR(std::sqrt(std::max(found, 0.0)), expected, 5e-3) << spread << " " << V;
      }
    }
  }
}

TEST(Polydispersity, IsTheMeanOverTheSizes) {
  for (const double spread : {0.05, 0.3}) {
    for (const double V : {0.9, 1.3, 2.0, 10.0}) {
      const double expected = brute_force([&](double z) {
        const double d = kDiameter * std::exp(spread * kCut * z) / cut_mean(spread);
        return base_square(kBase.f0 * std::cbrt(d / kDiameter), d, V);
      });
      const double found = square(kSoft, {"polydispersity"}, {spread}, kDiameter, V, kBase);
      if (expected < 0.0) {
        EXPECT_LT(found, 0.0) << spread << " " << V;
      } else {
        EXPECT_NEAR(std::sqrt(std::max(found, 0.0)), expected, 5e-3) << spread << " " << V;
      }
    }
  }
}

TEST(Polydispersity, KeepsTheMeanDiameterThatTheDataState) {
  // The law as it varies one sphere: its diameters, weighted by the cut normal density of z, have
  // the stated mean and the wanted spread of the logarithm.
  const MechanismLaw<double>& law = find_mechanism("polydispersity")->law<double>();
  for (const double spread : {0.05, 0.3}) {
    const std::vector<double> own = {spread};
    double mean = 0.0;
    double logarithm = 0.0;
    double square = 0.0;
    constexpr int count = 4000;
    for (int i = 0; i < count; ++i) {
      const double z = -2.5 + 5.0 * (i + 0.5) / count;
      const double weight = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi) /
                            std::erf(2.5 / std::numbers::sqrt2) * 5.0 / count;
      Encounter<double> e;
      e.at = &kSoft;
      e.diameter = 1.0;
      e.contact_radius = 0.5;
      e.adhesion_force = 1.0;
      law.vary(e, own, z);
      mean += weight * e.diameter;
      logarithm += weight * std::log(e.diameter);
      square += weight * std::pow(std::log(e.diameter), 2);
      EXPECT_NEAR(e.adhesion_force, std::cbrt(e.diameter), 1e-14);
      EXPECT_NEAR(e.contact_radius, 0.5 * e.diameter, 1e-14);
    }
    EXPECT_NEAR(mean, 1.0, 1e-6);
    EXPECT_NEAR(square - logarithm * logarithm, spread * spread, 1e-6);
  }
}

/// A histogram of uneven bins with a gap, which no lognormal is: 2.5 to 9.5 um.
MeasuredSizes uneven_sizes() {
  MeasuredSizes sizes;
  sizes.bins = {
      {3.5e-6, 0.15, 2e-6}, {5.25e-6, 0.5, 1.5e-6}, {6.5e-6, 0.2, 1e-6}, {8.5e-6, 0.15, 2e-6}};
  return sizes;
}

// The sizes act through nine spheres; here every bin is cut into four hundred.
TEST(MixedSizes, AreTheMeanOverTheStatedHistogram) {
  MeasuredSizes sizes = uneven_sizes();
  double total = 0.0;
  double mean = 0.0;
  for (const SizeBin& bin : sizes.bins) {
    total += bin.weight;
    mean += bin.weight * bin.diameter;
  }
  mean /= total;
  for (const double height : {0.0, 2e-3}) {  // of the plane: 0 and 0.198 m/s
    sizes.probe_height = height;
    Surroundings at = kSoft;
    at.sizes = mixed_sizes_of(sizes);
    const double slowest = std::sqrt(2.0 * 9.80665 * height);
    for (const double V : {0.7, 0.9, 1.1, 1.5, 2.5, 10.0}) {
      double sum = 0.0;
      double seen = 0.0;
      for (const SizeBin& bin : sizes.bins) {
        constexpr int parts = 400;
        for (int i = 0; i < parts; ++i) {
          // The point's diameter is the mean of its spheres, here kDiameter.
          const double d =
              (bin.diameter + ((i + 0.5) / parts - 0.5) * bin.width) * kDiameter / mean;
          const double x = base_square(kBase.f0 * std::cbrt(d / kDiameter), d, V);
          if (!(x > 0.0) || !(std::sqrt(x) * V > slowest)) continue;
          sum += bin.weight * std::sqrt(x);
          seen += bin.weight;
        }
      }
      ASSERT_GT(seen, 0.0) << V;
      const double found = square(at, {"polydispersity"}, {at.sizes.spread}, kDiameter, V, kBase);
      EXPECT_NEAR(std::sqrt(std::max(found, 0.0)), sum / seen, 3e-3) << V << " " << height;
    }
  }
}

TEST(MixedSizes, OfOneSizeAreNone) {
  MeasuredSizes one;
  one.bins = {{4.9e-6, 1.0, 0.0}};
  EXPECT_FALSE(mixed_sizes_of(one).mixed());
}

TEST(SurvivorsMean, OfAStraightLine) {
  // x = c - z over a normal cut off at +-2.5, by Simpson in t = sqrt(c - z).
  const auto mean = [](double c) {
    const double top = std::sqrt(c + 2.5);
    const double bottom = std::sqrt(std::max(0.0, c - 2.5));
    constexpr int n = 4000;
    double sum = 0.0;
    double weights = 0.0;
    for (int i = 0; i <= n; ++i) {
      const double t = bottom + (top - bottom) * i / n;
      const double z = c - t * t;
      const double w = (i == 0 || i == n ? 1.0
                        : i % 2 == 1     ? 4.0
                                         : 2.0) *
                       t * std::exp(-0.5 * z * z);
      sum += w * t;
      weights += w;
    }
    return sum / weights;
  };
  for (const double c : {-2.0, -0.5, 0.3, 2.0, 2.49, 4.0, 30.0}) {
    std::vector<double> x;
    for (const double z : spread_positions()) x.push_back(c - z);
    EXPECT_NEAR(std::sqrt(survivors_square<double>(x, 0.0)), mean(c), 2e-6 * mean(c)) << c;
  }
}

TEST(SurvivorsMean, PassesSmoothlyThroughTheCaptureOfTheLast) {
  const auto at = [](double c) {
    std::vector<double> x;
    for (const double z : spread_positions()) x.push_back(c - 0.1 * z);
    return survivors_square<double>(x, 0.0);
  };
  const double h = 1e-6;
  EXPECT_NEAR(at(-0.25 + h), -at(-0.25 - h), 1e-3 * h);
  EXPECT_LT(at(-0.25 - 1e-3), 0.0);
  EXPECT_NEAR((at(-0.25 + h) - at(-0.25)) / h, 4.0 / 9.0, 1e-3);
}

// What is too slow to be seen is left out like a capture, and the mean begins where it does.
TEST(SurvivorsMean, LeavesOutWhatIsNotSeen) {
  const auto at = [](double c, double seen) {
    std::vector<double> x;
    for (const double z : spread_positions()) x.push_back(c - 0.1 * z);
    return survivors_square<double>(x, seen);
  };
  EXPECT_GT(at(0.2, 0.1), at(0.2, 0.0));
  const double h = 1e-6;
  EXPECT_NEAR(at(-0.15 + h, 0.1), 0.1, h);  // the last sphere, e^2 = 0.1
  EXPECT_NEAR(at(-0.15 - h, 0.1), 0.1, h);
  EXPECT_NEAR((at(-0.15 + h, 0.1) - at(-0.15, 0.1)) / h, 0.5, 2e-3);
  EXPECT_NEAR((at(-0.15, 0.1) - at(-0.15 - h, 0.1)) / h, 0.5, 2e-3);
}

}  // namespace
}  // namespace recoil
