// What happens between the measuring plane and the contact, against balances worked by hand. The
// base impact is Hunt & Crossley's where a loss is needed: f0 = 0 has the closed form
//   C_H V (1 + e) = ln((1 + C_H V) / (1 - e C_H V)).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "one_point.hpp"

namespace recoil {
namespace {

using one_point::hunt_crossley;
using one_point::kDiameter;
using one_point::kSoft;
using one_point::square;

constexpr double kDamping = 0.05;
const one_point::Base kDamped{kDamping, 0.0, 0.0};

TEST(HuntCrossley, TheBaseItself) {
  EXPECT_NEAR(hunt_crossley(0.5), 0.7484349316, 1e-9);
  EXPECT_NEAR(std::sqrt(square(kSoft, {}, {}, kDiameter, 10.0, kDamped)), hunt_crossley(0.5), 1e-9);
}

/// Drag of a sphere that approaches a wall at the gap h (in radii) over that of Stokes: Brenner's
/// and Maude's series.
double wall_drag(double h) {
  const double a = std::acosh(1.0 + h);
  double sum = 0.0;
  for (int n = 1; n < 100000; ++n) {
    const double m = 2.0 * n + 1.0;
    if (m * a > 300.0) break;
    const double above = 2.0 * std::sinh(m * a) + m * std::sinh(2.0 * a);
    const double below = 4.0 * std::pow(std::sinh(0.5 * m * a), 2) - std::pow(m * std::sinh(a), 2);
    const double term = n * (n + 1.0) / ((m - 2.0) * (m + 2.0)) * (above / below - 1.0);
    sum += term;
    if (n > 5 && term < 1e-13 * sum) break;
  }
  return 4.0 / 3.0 * std::sinh(a) * sum;
}

/// The integral of the drag over a way of so many radii: the film with slipping walls, whose force
/// is that of the pressure integral of ((rho^3) / (h^2 (h + 6b))), and the rest of the series with
/// the slip of a free sphere. By Simpson's rule in ln h.
double drag_over(double way, double knudsen) {
  const double b = 1.15 * knudsen;
  const double C = 1.0 + knudsen * (1.257 + 0.4 * std::exp(-1.1 / knudsen));
  const auto drag = [&](double h) {
    const double x = h / (6.0 * b);
    const double film = 2.0 * x * ((1.0 + x) * std::log1p(1.0 / x) - 1.0) / h;
    // Below 1e-4 the series is 1 / h - (1/5) ln h + 0.97128.
    const double rest = h > 1e-4 ? wall_drag(h) - 1.0 / h : 0.97128 - 0.2 * std::log(h);
    return film + rest / C;
  };
  constexpr int steps = 1200;
  const double from = std::log(1e-12);
  const double h = (std::log(way) - from) / steps;
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double at = std::exp(from + i * h);
    sum += (i == 0 || i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * at * drag(at);
  }
  return sum * h / 3.0;
}

TEST(GasFilm, SlowsBothWaysByLubricationAndDrag) {
  // Air at 1 atm and 293 K, Sutherland's viscosity and the free path of kinetic theory. At lambda =
  // 66 nm the integral of the drag is 10.107 for L = 5 r and 15.722 for 10 r around 4.9 um.
  EXPECT_NEAR(drag_over(5.0, 66e-9 / (0.5 * kDiameter)), 10.106931, 1e-4);
  EXPECT_NEAR(drag_over(10.0, 66e-9 / (0.5 * kDiameter)), 15.722273, 1e-4);
  for (const double d : {2.58e-6, kDiameter, 49e-6, 2e-3}) {
    const double r = 0.5 * d;
    const double unit = 4.5 * 1.812688004e-5 / (1350.0 * r);
    for (const double way : {0.3, 1.0, 5.0, 7.0, 10.0, 40.0}) {
      const double integral = drag_over(way, 6.502479e-8 / r);
      const double V = 50.0 * integral * unit;
      const double e = std::sqrt(square(kSoft, {"gas_film"}, {101325.0, way * r}, d, V));
      const double lost = 0.5 * V * (1.0 - e);
      EXPECT_NEAR(lost / (integral * unit), 1.0, way < 5.0 ? 0.02 : 2e-3) << d << " " << way;
    }
  }
}

/// At 1200 K air has 4.625e-05 Pa s and a free path of 336 nm at 1 atm.
TEST(GasFilm, TakesTheStatedTemperature) {
  Surroundings hot = kSoft;
  hot.conditions.set(Condition::temperature, 1200.0);
  const double r = 0.5 * kDiameter;
  const double expected = 4.5 * 4.625146662e-05 / (1350.0 * r) * drag_over(5.0, 3.357672e-07 / r);
  const double V = 50.0 * expected;
  const double e = std::sqrt(square(hot, {"gas_film"}, {101325.0, 5.0 * r}, kDiameter, V));
  EXPECT_NEAR(0.5 * V * (1.0 - e) / expected, 1.0, 2e-3);
}

TEST(GasFilm, IsGoneInVacuumAndAtTheSurface) {
  EXPECT_NEAR(square(kSoft, {"gas_film"}, {101325.0, 0.0}, kDiameter, 3.0), 1.0, 1e-9);
  EXPECT_NEAR(square(kSoft, {"gas_film"}, {1e-5, 1e-3}, kDiameter, 3.0), 1.0, 1e-6);
}

TEST(GasFilm, StopsWhatIsSlowerThanItTakes) {
  const double r = 0.5 * kDiameter;
  const double lost = 4.5 * 1.812688004e-5 / (1350.0 * r) * drag_over(5.0, 6.502479e-8 / r);
  // In, and not out again: an elastic sphere at 1.5 times the loss comes back to the film with half
  // of it. At less than the loss it never touches. Capture is at twice the loss.
  for (const double V : {0.5 * lost, lost, 1.5 * lost, 1.98 * lost}) {
    EXPECT_LT(square(kSoft, {"gas_film"}, {101325.0, 2.5 * kDiameter}, kDiameter, V), 0.0) << V;
  }
  EXPECT_GT(square(kSoft, {"gas_film"}, {101325.0, 2.5 * kDiameter}, kDiameter, 2.02 * lost), 0.0);
}

/// A steel ball of 2 mm on steel, without adhesion, as Gollwitzer et al. (2012) drop glass beads:
/// glycerol of 1 Pa s, 100 um thick, on asperities of 1 um.
struct Wet {
  Surroundings at;
  double d = 2e-3, mu = 1.0, film = 1e-4, rough = 1e-6;

  Wet() {
    ImpactSystem system = one_point::steel();
    system.adhesion_force_f0 = {};
    system.adhesion_energy = 0.0;
    at = one_point::around(system);
  }
  /// 6 pi mu r^2 / m, from m = (4/3) pi rho r^3.
  double unit() const { return 4.5 * mu / (7900.0 * 0.5 * d); }
  double square_at(double V, double share = 0.0) const {
    return square(at, {"hysteretic_loss", "liquid_film"}, ordered(share), d, V);
  }
  std::vector<double> ordered(double share) const {
    std::vector<double> own;
    for (const Mechanism* m : chain_of({"hysteretic_loss", "liquid_film"})) {
      const std::vector<double> values =
          m->info.id == "liquid_film" ? std::vector{mu, film, rough} : std::vector{share};
      own.insert(own.end(), values.begin(), values.end());
    }
    return own;
  }
};

// e = e_dry (1 - St_c / St) with St = m V / (6 pi mu r^2), St_c = (1 + 1 / e_dry) ln(delta / h);
// e_dry^2 = 1 - share of the elastic energy at any velocity. Capture at St_c.
TEST(LiquidFilm, HasTheLimitsOfTheStokesNumber) {
  const Wet wet;
  for (const double share : {0.0, 0.36}) {
    const double dry = std::sqrt(1.0 - share);
    const double critical = (1.0 + 1.0 / dry) * std::log(wet.film / wet.rough);
    for (const double St : {1.5 * critical, 3.0 * critical, 10.0 * critical, 100.0 * critical}) {
      const double e = std::sqrt(wet.square_at(St * wet.unit(), share));
      EXPECT_NEAR(e, dry * (1.0 - critical / St), 2e-3) << share << " " << St / critical;
    }
    EXPECT_LT(wet.square_at(0.998 * critical * wet.unit(), share), 0.0);
    EXPECT_GT(wet.square_at(1.002 * critical * wet.unit(), share), 0.0);
    EXPECT_LT(wet.square_at(0.3 * critical * wet.unit(), share), 0.0);
  }
  // A thinner film than the asperities are high is not felt.
  Wet dry;
  dry.film = 1e-8;
  EXPECT_NEAR(dry.square_at(10.0 * dry.unit()), 1.0, 1e-4);
}

/// e of the gap x(t), m x'' = -6 pi mu r^2 x' / x, from delta to h and back with a dry e at h: the
/// classical Runge-Kutta method in t, with steps of a thousandth of x / x'.
double wet_restitution(const Wet& wet, double V, double e_dry) {
  const auto way = [&](double x, double v, double end) {
    const double direction = v < 0.0 ? -1.0 : 1.0;
    while (direction * (end - x) > 0.0 && direction * v > 0.0) {
      const double t = std::min(1e-3 * x / std::abs(v), (end - x) / v);
      const auto slope = [&](double at, double speed) { return -wet.unit() * speed / at; };
      const double a1 = slope(x, v), v2 = v + 0.5 * t * a1;
      const double a2 = slope(x + 0.5 * t * v, v2), v3 = v + 0.5 * t * a2;
      const double a3 = slope(x + 0.5 * t * v2, v3), v4 = v + t * a3;
      const double a4 = slope(x + t * v3, v4);
      x += t / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
      v += t / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
      if (std::abs(end - x) < 1e-9 * end) break;
    }
    return v;
  };
  return way(wet.rough, -e_dry * way(wet.film, -V, wet.rough), wet.film) / V;
}

TEST(LiquidFilm, IsTheIntegralOfLubrication) {
  Wet wet;
  for (const double film : {1e-5, 1e-4, 4e-4}) {
    wet.film = film;
    for (const double V : {10.0, 20.0, 60.0}) {
      EXPECT_NEAR(std::sqrt(wet.square_at(V, 0.19)), wet_restitution(wet, V, 0.9), 2e-3) << film;
    }
  }
}

// Between equal spheres r^2 / m is (r / 2)^2 / (m / 2): half as much is lost.
TEST(LiquidFilm, ActsBetweenTwoSpheres) {
  Wet wet;
  const double on_flat = 1.0 - std::sqrt(wet.square_at(200.0));
  wet.at.surface_diameter = wet.d;
  wet.at.surface_mass = M_PI / 6.0 * 7900.0 * wet.d * wet.d * wet.d;
  EXPECT_NEAR((1.0 - std::sqrt(wet.square_at(200.0))) / on_flat, 0.5, 1e-3);
}

// Water under 4.9 um spheres with adhesion: the film captures before the adhesion does.
TEST(LiquidFilm, ActsBesideAdhesion) {
  const double unit = 4.5 * 1e-5 / (1350.0 * 0.5 * kDiameter);
  const double lost = unit * std::log(100.0);
  const std::vector<double> film = {1e-5, 1e-6, 1e-8};
  for (const double V : {3.0, 6.0, 20.0}) {
    const double inside = V - lost;
    const double back =
        inside * std::sqrt(square(kSoft, {}, {}, kDiameter, inside, one_point::kBase));
    EXPECT_NEAR(std::sqrt(square(kSoft, {"liquid_film"}, film, kDiameter, V, one_point::kBase)),
                (back - lost) / V, 2e-3);
  }
}

TEST(ElectrostaticImage, IsDahnekesEnergyBalance) {
  // V_E = sqrt(1.5 eps0 / rho) E_s = 0.099 m/s at 1e6 V/m, at every size.
  const double well = 1.5 * 8.8541878128e-12 / 1350.0 * 1e12;
  EXPECT_NEAR(std::sqrt(well), 0.0992, 1e-4);
  const double V = 0.3;
  const double arrives = std::sqrt(V * V + well);
  const double e0 = hunt_crossley(kDamping * arrives);
  for (const double d : {kDiameter, 2.0 * kDiameter}) {
    EXPECT_NEAR(square(kSoft, {"electrostatic_image"}, {1e6, 2.0}, d, V, kDamped),
                e0 * e0 - (1.0 - e0 * e0) * well / (V * V), 1e-9);
  }
  // A fixed charge: the field of the larger sphere is a quarter, U / m falls like d^-4.
  const double less = well / 16.0;
  const double e1 = hunt_crossley(kDamping * std::sqrt(V * V + less));
  EXPECT_NEAR(square(kSoft, {"electrostatic_image"}, {1e6, 0.0}, 2.0 * kDiameter, V, kDamped),
              e1 * e1 - (1.0 - e1 * e1) * less / (V * V), 1e-9);
  // Without a loss the well gives back what it took.
  EXPECT_NEAR(square(kSoft, {"electrostatic_image"}, {3e6, 2.0}, kDiameter, V), 1.0, 1e-9);
}

TEST(ElectrostaticImage, IsWeakerBeforeADielectric) {
  // Silicon, eps = 11.7: (eps - 1) / (eps + 1) = 0.842520.
  ImpactSystem system = one_point::fluorescein();
  system.surface.relative_permittivity = 11.7;
  const double well = 0.842520 * 1.5 * 8.8541878128e-12 / 1350.0 * 1e12;
  const double V = 0.3;
  const double e0 = hunt_crossley(kDamping * std::sqrt(V * V + well));
  EXPECT_NEAR(
      square(one_point::around(system), {"electrostatic_image"}, {1e6, 2.0}, kDiameter, V, kDamped),
      e0 * e0 - (1.0 - e0 * e0) * well / (V * V), 1e-7);
}

TEST(VanDerWaalsApproach, IsAWellInFrontOfTheContact) {
  // U = A R / (6 z0) = 1.0208e-16 J for 1e-19 J and 4.9 um; U / m ~ d^-2.
  const double U = 1e-19 * 2.45e-6 / (6.0 * 0.4e-9);
  EXPECT_NEAR(U, 1.0208e-16, 1e-20);
  const double V = 0.3;
  for (const double factor : {1.0, 2.0}) {
    const double d = factor * kDiameter;
    const double m = 1350.0 * std::numbers::pi / 6.0 * std::pow(kDiameter, 3);
    const double well = 2.0 * U / m / (factor * factor);
    const double e0 = hunt_crossley(kDamping * std::sqrt(V * V + well));
    EXPECT_NEAR(square(kSoft, {"van_der_waals_approach"}, {1e-19}, d, V, kDamped),
                e0 * e0 - (1.0 - e0 * e0) * well / (V * V), 1e-9);
  }
}

TEST(ProbePlane, IsFreeFall) {
  const double h = 1e-3;
  const double twice_gh = 2.0 * 9.80665 * h;
  EXPECT_NEAR(twice_gh, 0.0196, 1e-4);
  const double V = 0.4;
  const double arrives = std::sqrt(V * V + twice_gh);
  const double e0 = hunt_crossley(kDamping * arrives);
  EXPECT_NEAR(square(kSoft, {"probe_plane"}, {h}, kDiameter, V, kDamped),
              (e0 * e0 * arrives * arrives - twice_gh) / (V * V), 1e-9);
  // What bounces back lower than the plane is not seen: 0.8 of 0.14 m/s does not rise by 1 mm.
  const one_point::Base hard{3.0, 0.0, 0.0};
  EXPECT_LT(square(kSoft, {"probe_plane"}, {h}, kDiameter, 0.05, hard), 0.0);
}

TEST(VelocityOffset, IsReadInBothVelocities) {
  const double V = 2.0;
  for (const double offset : {0.05, -0.05}) {
    const double e0 = hunt_crossley(kDamping * (V - offset));
    const double rebound = e0 * (V - offset);
    for (const double sign : {1.0, -1.0, 0.0}) {
      EXPECT_NEAR(
          std::sqrt(square(kSoft, {"velocity_offset"}, {offset, sign}, kDiameter, V, kDamped)),
          (rebound + sign * offset) / V, 1e-5);
    }
  }
}

}  // namespace
}  // namespace recoil
