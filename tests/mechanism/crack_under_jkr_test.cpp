// The opening crack under JKR with both dampings of the base model, against the coupled equation of
// motion, which this file integrates by itself.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "one_point.hpp"

namespace recoil {
namespace {

using std::numbers::pi;

struct Coupled {
  double C_H, C_A, factor, exponent;
  bool both = false;
};

/// e^2 of ammonium fluorescein of 4.9 um on molybdenum; 0 after a capture. JKR in the units of
/// Maugis (1992), P = a^3 - (6 a^3)^(1/2), n = a^2 - (2/3) (6 a)^(1/2), with the opening of the
/// contact: the work w_1 v_c^k per area, v_c = |n'| / (dn / da), constant from the largest pull
/// (a^3 = 3/2) on. The classical Runge-Kutta method in sigma, dt = (dn / da) dsigma, from first
/// contact (a^3 = 8/3) to a^3 = 1/6, where dn / da = 0.
double coupled_square(const Coupled& c, double V) {
  constexpr double r = 2.45e-6, f0 = 8.9, rho = 1350.0;
  const double K = 4.0 / 3.0 / ((1.0 - 0.33 * 0.33) / 1.2e9 + (1.0 - 0.31 * 0.31) / 320e9);
  const double m = 4.0 / 3.0 * pi * rho * r * r * r;
  // f0 = (6 pi W)^(2/3) (K r)^(1/3) / (2 pi)
  const double W = std::pow(2.0 * pi * f0 / std::cbrt(K * r), 1.5) / (6.0 * pi);
  const double P = pi * W * r, N = std::cbrt(pi * pi * W * W * r / (K * K)),
               A = std::cbrt(pi * W * r * r / K);
  double pulled = -1.0;  // v_c^k from the largest pull on
  const auto slope_of = [](double a) { return 2.0 * a - std::sqrt(6.0) / 3.0 / std::sqrt(a); };
  const auto crack = [&](double a, double v) {
    return std::pow(std::max(-v, 0.0) * A / (slope_of(a) * N), c.exponent);
  };
  const auto rate = [&](double a, double v, bool out) {
    const double hertz = a * a * a, pull = std::sqrt(6.0 * hertz);
    double force = -(hertz - pull) - hertz * c.C_H * v;
    if (out || c.both) force -= pull * c.C_A * v;
    double dv = P * force * slope_of(a) / m;
    if (out) {
      const double power = pulled >= 0.0 ? pulled : crack(a, v);
      dv += c.factor * one_point::kSoftWork * power * 2.0 * pi * a * A * A / (N * m);
    }
    return std::pair(v / N, dv);
  };
  double a = std::cbrt(8.0 / 3.0), v = V;
  const double step = 2e-4 * N / std::max(V, 0.1);
  for (bool out = false;;) {
    const auto [a1, v1] = rate(a, v, out);
    const auto [a2, v2] = rate(a + 0.5 * step * a1, v + 0.5 * step * v1, out);
    const auto [a3, v3] = rate(a + 0.5 * step * a2, v + 0.5 * step * v2, out);
    const auto [a4, v4] = rate(a + step * a3, v + step * v3, out);
    a += step / 6.0 * (a1 + 2.0 * (a2 + a3) + a4);
    v += step / 6.0 * (v1 + 2.0 * (v2 + v3) + v4);
    if (!out && v < 0.0) {
      out = true;
    } else if (out && v >= 0.0) {
      return 0.0;
    }
    if (out && pulled < 0.0 && a * a * a <= 1.5) pulled = crack(a, v);
    if (out && a * a * a <= 1.0 / 6.0) return v * v / (V * V);
  }
}

double recoil_square(const Coupled& c, double V) {
  Surroundings at = one_point::kSoft;
  at.adhesion = AdhesionLaw::jkr;
  if (c.both) at.phase = AdhesionDampingPhase::both;
  return one_point::square(at, {"crack_rate"}, {c.factor, c.exponent}, one_point::kDiameter, V,
                           {c.C_H, c.C_A, 8.9});
}

const Coupled kCases[] = {{3e-3, 0.03, 0.05, 0.5},       {3e-3, 0.03, 0.15, 0.5},
                          {3e-3, 0.03, 0.5, 0.5},        {0.02, 0.0, 0.15, 0.3},
                          {0.0, 0.08, 0.15, 0.7},        {3e-3, 0.03, 0.15, 1.0},
                          {3e-3, 0.03, 0.15, 0.5, true}, {0.0, 0.0, 0.3, 0.5}};

TEST(CrackUnderJkr, IsTheCoupledEquation) {
  for (const Coupled& c : kCases) {
    for (const double V : {1.5, 2.5, 5.0, 20.0, 80.0}) {
      const double expected = coupled_square(c, V);
      if (expected == 0.0) {
        EXPECT_LT(recoil_square(c, V), 1e-3);
        continue;
      }
      EXPECT_NEAR(recoil_square(c, V), expected, 1e-3)
          << c.C_H << " " << c.C_A << " " << c.factor << " " << c.exponent << " V " << V;
    }
  }
}

TEST(CrackUnderJkr, CapturesWhereTheCoupledEquationDoes) {
  for (const Coupled& c : kCases) {
    const auto threshold = [&](const auto& square) {
      double low = 0.3, high = 30.0;
      while (high > 1.0001 * low) {
        const double middle = std::sqrt(low * high);
        (square(c, middle) > 0.0 ? high : low) = middle;
      }
      return high;
    };
    EXPECT_NEAR(threshold(recoil_square) / threshold(coupled_square), 1.0, 1e-3)
        << c.C_H << " " << c.C_A << " " << c.factor << " " << c.exponent;
  }
}

}  // namespace
}  // namespace recoil
