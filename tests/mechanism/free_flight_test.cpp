// Spheres that are dropped, and rise to a height that is read: errors of the height, and the air on
// the way, integrated here in time.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "one_point.hpp"

namespace recoil {
namespace {

using one_point::square;

constexpr double kGravity = 9.80665;

/// Spheres of this density that are hard and do not stick.
Surroundings bare(double density) {
  ImpactSystem system = one_point::fluorescein();
  system.particle.density = density;
  system.adhesion_energy = 0.0;
  return one_point::around(system);
}

TEST(HeightOrigin, AddsToTheHeightsThatAreRead) {
  const Surroundings at = bare(2500.0);
  const double V = 1.2;
  const double h1 = V * V / (2.0 * kGravity);
  for (const double delta : {2e-3, -2e-3}) {
    for (const double share : {0.0, 1.0, -0.5}) {
      // A contact that returns 0.81 of the energy, of the true height h1 - s delta.
      const double read = 0.81 * (h1 - share * delta) + delta;
      EXPECT_NEAR(square(at, {"hysteretic_loss", "height_origin"}, {delta, share, 0.19}, 4e-3, V),
                  read / h1, 2e-4)
          << delta << " " << share;
    }
  }
  // Both heights too large by the same are a plane that is too low.
  EXPECT_NEAR(square(at, {"hysteretic_loss", "height_origin"}, {-1e-3, 1.0, 0.19}, 4e-3, V),
              square(at, {"hysteretic_loss", "probe_plane"}, {1e-3, 0.19}, 4e-3, V), 2e-4);
}

TEST(HeightOrigin, IsNoReboundOfWhatStays) {
  // Asperities take more than the sphere has: it stays, whatever is read of it.
  const Surroundings at = bare(2500.0);
  EXPECT_LT(square(at, {"asperity_loss", "height_origin"}, {2e-3, 0.0, 1e-4}, 4e-3, 0.8), 0.0);
}

/// C_d of a sphere by Brown & Lawler (2003).
double drag_coefficient(double re) {
  return 24.0 / re * (1.0 + 0.150 * std::pow(re, 0.681)) + 0.407 / (1.0 + 8710.0 / re);
}

/// Air at 1 atm: ideal gas, Sutherland's viscosity, the free path of kinetic theory, typed in from
/// Python for two temperatures.
struct Gas {
  double temperature, density, viscosity, free_path;
};
constexpr Gas kRoom{293.0, 1.204734759, 1.812688004e-5, 6.502479e-8};
constexpr Gas kHot{1200.0, 0.294156070, 4.625146662e-05, 3.357672e-07};

/// e^2 by heights of a sphere that truly returns `e`^2: fall and rise in small steps of time, by
/// the midpoint rule.
double by_heights(double density, double d, double V, double e, const Gas& gas) {
  const auto drag = [&](double v) {
    const double re = gas.density * v * d / gas.viscosity;
    const double kn = 2.0 * gas.free_path / d;
    const double slip = 1.0 + kn * (1.257 + 0.4 * std::exp(-1.1 / kn));
    return re > 0.0 ? 0.75 * gas.density / density * drag_coefficient(re) / d * v * v / slip : 0.0;
  };
  const double height = V * V / (2.0 * kGravity);
  const double step = V / kGravity / 20000.0;
  double v = 0.0;
  double x = 0.0;
  while (true) {
    const double middle = v + 0.5 * step * (kGravity - drag(v));
    const double way = middle * step;
    if (x + way >= height) {
      v += (kGravity - drag(middle)) * (height - x) / middle;
      break;
    }
    x += way;
    v += step * (kGravity - drag(middle));
  }
  v *= e;
  x = 0.0;
  while (v > 0.0) {
    const double middle = v - 0.5 * step * (kGravity + drag(v));
    if (middle <= 0.0) break;
    x += middle * step;
    v -= step * (kGravity + drag(middle));
  }
  return x / height;
}

TEST(FlightDrag, IsThatOfTheFallAndTheRise) {
  struct Ball {
    double density, diameter, velocity;
  };
  // From table tennis (Re = 1e4) to glass beads and dust (Re < 1, near its terminal velocity).
  for (const auto& [density, d, V] :
       {Ball{80.6, 40e-3, 4.43}, Ball{80.6, 40e-3, 1.0}, Ball{2500.0, 2e-3, 3.0},
        Ball{2500.0, 0.2e-3, 1.0}, Ball{1000.0, 20e-6, 0.02}}) {
    for (const Gas& gas : {kRoom, kHot}) {
      Surroundings at = bare(density);
      at.conditions.set(Condition::temperature, gas.temperature);
      const double expected = by_heights(density, d, V, 0.9, gas);
      EXPECT_LT(expected, 0.81);
      EXPECT_NEAR(square(at, {"hysteretic_loss", "flight_drag"}, {101325.0, 0.19}, d, V), expected,
                  1e-3)
          << d << " " << V;
    }
  }
}

TEST(FlightDrag, TakesTheTwelfthPartOfABall) {
  // 2.7 g, 40 mm, C_d = 0.41, from 1 m: v^2 = (g / k) (1 - exp(-2 k h)) and h_2 = ln(1 + k v^2 / g)
  // / 2k with k = 0.1152 / m give e = 0.818 where 0.9 is true.
  const double density = 2.7e-3 / (std::numbers::pi / 6.0 * std::pow(40e-3, 3));
  const double V = std::sqrt(2.0 * kGravity);
  const double e = std::sqrt(
      square(bare(density), {"hysteretic_loss", "flight_drag"}, {101325.0, 0.19}, 40e-3, V));
  EXPECT_NEAR(e, 0.818, 0.003);
}

TEST(FlightDrag, IsGoneWithoutAirAndBoundedWithTooMuch) {
  const Surroundings at = bare(2500.0);
  EXPECT_NEAR(square(at, {"flight_drag"}, {1e-9}, 1e-3, 2.0), 1.0, 1e-9);
  // Dust from half a kilometre falls at its terminal velocity and rises by next to nothing.
  const one_point::Answer dust = one_point::ask(at, {"flight_drag"}, {1e5}, 5e-6, 100.0);
  EXPECT_TRUE(dust.usable);
  EXPECT_LT(dust.square, 1e-6);
  for (const double slope : dust.slopes) EXPECT_TRUE(std::isfinite(slope));
}

}  // namespace
}  // namespace recoil
