// Several mechanisms at once, against a plain re-implementation in this file: its own closed form
// of the base impact, its own formulas, in the order that the documentation promises. Derivatives
// are compared with differences of that implementation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mechanism/mechanism.hpp"
#include "one_point.hpp"

namespace recoil {
namespace {

using one_point::hunt_crossley;
using one_point::kSoft;
using std::numbers::pi;

/// Everything on which the test case depends, in the order of Answer::slopes: V, D, C_H, (C_A, f0),
/// then the mechanisms' parameters in the order of the chain.
struct Case {
  double V = 6.0, D = 3.4e-6, C_H = 0.03;
  double diameter_error = 0.05;
  double velocity_error = 0.04;
  double rebound_sign = 0.4;
  double height = 2e-3;
  double field = 2e6, charge_exponent = 1.5;
  double asperity = 2e-14;
  double jkr = 0.45;
  double yield = 6e7, rate = 0.1;
  double outliers = 0.02;
};

double by_hand(const Case& c) {
  const double density = 1350.0;
  const double E = kSoft.reduced_modulus;
  const double d = c.D * (1.0 + c.diameter_error);
  const double r = d / 2.0;
  const double m = density * pi * d * d * d / 6.0;
  double v = c.V - c.velocity_error;
  v = std::hypot(v, std::sqrt(2.0 * 9.80665 * c.height));
  const double charge = 4.0 * pi * 8.8541878128e-12 * std::pow(2.45e-6, 2) * c.field *
                        std::pow(d / 4.9e-6, c.charge_exponent);
  const double well = 2.0 * charge * charge / (16.0 * pi * 8.8541878128e-12 * r) / m;
  v = std::sqrt(v * v + well);
  // Yielding in terms of the loads: F_Y, F*, and the elastic energy of the flattened contact.
  const double p = c.yield * std::pow(v * std::pow(d / 10e-6, -5.0 / 3.0), c.rate);
  const double n_yield = std::pow(pi * p / (2.0 * E), 2) * r;
  const double f_yield = 4.0 / 3.0 * E * std::sqrt(r) * std::pow(n_yield, 1.5);
  const double energy = 0.5 * m * v * v - 0.4 * f_yield * n_yield;
  const double load = std::sqrt(f_yield * f_yield + 2.0 * pi * p * r * energy);
  const double R = 4.0 * E / (3.0 * load) * std::pow((2.0 * load + f_yield) / (2.0 * pi * p), 1.5);
  const double depth = std::pow(3.0 * load / (4.0 * E * std::sqrt(R)), 2.0 / 3.0);
  const double elastic = std::sqrt(2.0 * 0.4 * load * depth / m);  // velocity that this is worth
  const double e0 = hunt_crossley(c.C_H * elastic);
  double v2 = e0 * e0 * elastic * elastic;
  v2 -= 2.0 / m * 7.0922 *
        std::cbrt(std::pow(c.jkr * one_point::kSoftWork, 5) * std::pow(R, 4) / (E * E));
  v2 -= 2.0 / m * c.asperity;
  v2 -= well;
  v2 -= 2.0 * 9.80665 * c.height;
  const double e = (std::sqrt(v2) + c.rebound_sign * c.velocity_error) / c.V;
  return std::pow((1.0 - c.outliers) * e + 0.5 * c.outliers, 2);
}

TEST(Combination, AgreesWithAPlainReimplementation) {
  const std::vector<std::string> ids = {
      "plastic_yield", "jkr_hysteresis",  "asperity_loss", "electrostatic_image",
      "probe_plane",   "velocity_offset", "outliers",      "size_calibration"};
  for (const double V : {3.5, 6.0, 25.0}) {
    Case c;
    c.V = V;
    const one_point::Answer answer = one_point::ask(
        kSoft, ids,
        {c.diameter_error, c.velocity_error, c.rebound_sign, c.height, c.field, c.charge_exponent,
         c.asperity, c.jkr, c.yield, c.rate, 1.0, 0.0, c.outliers},
        c.D, c.V, {c.C_H, 0.0, 0.0});
    ASSERT_TRUE(answer.usable);
    const double expected = by_hand(c);
    ASSERT_GT(expected, 0.1);
    // Rounding off at the border between seen and not seen: a few 1e-4 of what is added.
    EXPECT_NEAR(answer.square, expected, 5e-5) << V;
    struct Direction {
      std::size_t k;
      double Case::*what;
    };
    for (const auto& [k, what] : {Direction{0, &Case::V},
                                  {1, &Case::D},
                                  {2, &Case::C_H},
                                  {5, &Case::diameter_error},
                                  {6, &Case::velocity_error},
                                  {7, &Case::rebound_sign},
                                  {8, &Case::height},
                                  {9, &Case::field},
                                  {10, &Case::charge_exponent},
                                  {11, &Case::asperity},
                                  {12, &Case::jkr},
                                  {13, &Case::yield},
                                  {14, &Case::rate},
                                  {17, &Case::outliers}}) {
      const double h = 1e-5;
      Case more = c;
      Case less = c;
      more.*what *= 1.0 + h;
      less.*what *= 1.0 - h;
      const double difference = (by_hand(more) - by_hand(less)) / (2.0 * h);
      EXPECT_NEAR(answer.slopes[k] * (c.*what), difference, 2e-3 * std::abs(difference) + 1e-5)
          << "V " << V << ", direction " << k;
    }
  }
}

TEST(Combination, AllAtOnceGiveAnAnswerWithFiniteSlopes) {
  std::vector<std::string> ids;
  std::vector<double> own;
  for (const Mechanism& m : mechanism_catalogue()) {
    ids.emplace_back(m.info.id);
    // Spheres of 4.9 um do not fall through three metres of air.
    const double scale = m.info.id == "flight_drag" ? 1e-8 : 1.0;
    for (const Parameter& p : m.info.parameters) own.push_back(scale * p.initial);
  }
  const one_point::Answer answer = one_point::ask(kSoft, ids, own, 4.9e-6, 8.0, {3e-3, 0.02, 8.9});
  ASSERT_TRUE(answer.usable);
  EXPECT_GT(answer.square, 0.0);
  EXPECT_LT(answer.square, 1.0);
  EXPECT_TRUE(std::all_of(answer.slopes.begin(), answer.slopes.end(),
                          [](double s) { return std::isfinite(s); }));
}

TEST(Combination, TwoSpreadsAreTheMeanOfMeans) {
  // Independent spreads of the adhesion: to second order their squares add.
  const one_point::Base base{3e-3, 0.02, 8.9};
  const double both =
      one_point::square(kSoft, {"survivor_bias", "polydispersity"}, {0.1, 0.1}, 4.9e-6, 8.0, base);
  const double none = one_point::square(kSoft, {}, {}, 4.9e-6, 8.0, base);
  const double first = one_point::square(kSoft, {"survivor_bias"}, {0.1}, 4.9e-6, 8.0, base);
  const double second = one_point::square(kSoft, {"polydispersity"}, {0.1}, 4.9e-6, 8.0, base);
  EXPECT_NEAR(both - none, first - none + second - none, 0.02 * std::abs(both - none) + 1e-6);
}

}  // namespace
}  // namespace recoil
