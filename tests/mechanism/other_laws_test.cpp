// Mechanisms beside jkr, dmt and maugis: what stands beside which law, derivatives, and the ones
// that know the contact against integrals along the path of an undamped impact.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

#include "impact/impact.hpp"
#include "one_point.hpp"

namespace recoil {
namespace {

using one_point::Answer;
using one_point::ask;
using one_point::Base;
using one_point::kBase;
using one_point::kDiameter;
using one_point::kSoft;
using std::numbers::pi;

Surroundings under(AdhesionLaw law) {
  Surroundings at = kSoft;
  at.adhesion = law;
  return at;
}

std::vector<double> strengths_of(const Mechanism& m) {
  std::vector<double> values;
  for (const Parameter& p : m.info.parameters) values.push_back(p.initial);
  if (m.info.id == "plastic_yield") std::tie(values[0], values[1]) = std::pair(1.2e8, 0.1);
  if (m.info.id == "elastic_waves") values.front() = 100.0;
  if (m.info.id == "plate_flexure") values.front() = 1e4;
  return values;
}

TEST(OtherLaws, RefuseWhatWouldCountTwice) {
  const auto refused = [](const char* id, AdhesionLaw law) {
    return !find_mechanism(id)->works_with(law);
  };
  for (const AdhesionLaw law : {AdhesionLaw::jkr, AdhesionLaw::dmt, AdhesionLaw::maugis}) {
    EXPECT_TRUE(refused("jkr_hysteresis", law));
    EXPECT_EQ(refused("crack_rate", law), law != AdhesionLaw::jkr);
    EXPECT_EQ(refused("van_der_waals_approach", law), law == AdhesionLaw::maugis);
    EXPECT_EQ(refused("bulk_viscoelastic", law), law == AdhesionLaw::maugis);
    for (const char* id : {"plastic_yield", "asperity_loss", "capillary", "adhesion_hysteresis",
                           "elastic_waves", "gas_film", "polydispersity"}) {
      EXPECT_FALSE(refused(id, law)) << id;
    }
  }
  for (const Mechanism& m : mechanism_catalogue()) EXPECT_TRUE(m.works_with(AdhesionLaw::ring));
}

class BesideLaw : public testing::TestWithParam<AdhesionLaw> {};
INSTANTIATE_TEST_SUITE_P(Laws, BesideLaw,
                         testing::Values(AdhesionLaw::jkr, AdhesionLaw::dmt, AdhesionLaw::maugis),
                         [](const auto& law) { return to_string(law.param); });

TEST_P(BesideLaw, WhatActsInTheContactVanishesActsAndHasItsDerivatives) {
  const Surroundings at = under(GetParam());
  for (const Mechanism& m : mechanism_catalogue()) {
    if (m.info.place != MechanismPlace::contact || !m.works_with(GetParam())) continue;
    const std::string id(m.info.id);
    std::vector<double> own = strengths_of(m);
    std::vector<double> none = own;
    none.front() = m.info.parameters.front().null_value;
    double largest = 0.0;
    for (const double V : {0.7, 2.5, 30.0}) {
      const double base = one_point::square(at, {}, {}, kDiameter, V, kBase);
      EXPECT_NEAR(one_point::square(at, {id}, none, kDiameter, V, kBase), base,
                  1e-9 * std::max(1.0, std::abs(base)))
          << id << " " << V;
      const Answer answer = ask(at, {id}, own, kDiameter, V, kBase);
      ASSERT_TRUE(answer.usable) << id;
      largest = std::max(largest, std::abs(answer.square - base));
      for (std::size_t k = 0; k < answer.slopes.size(); ++k) {
        const auto moved = [&](double factor) {
          double v = V, d = kDiameter;
          Base changed = kBase;
          std::vector<double> its = own;
          double* const places[] = {&v, &d, &changed.C_H, &changed.C_A, &changed.f0};
          (k < 5 ? *places[k] : its[k - 5]) *= factor;
          return one_point::square(at, {id}, its, d, v, changed);
        };
        const double h = 2e-5;
        const double difference = (moved(1.0 + h) - moved(1.0 - h)) / (2.0 * h);
        const double values[] = {V, kDiameter, kBase.C_H, kBase.C_A, kBase.f0};
        const double slope = answer.slopes[k] * (k < 5 ? values[k] : own[k - 5]);
        EXPECT_NEAR(slope, difference, 5e-4 * std::abs(difference) + 5e-5)
            << id << " V " << V << " k " << k;
      }
    }
    EXPECT_GT(largest, 1e-4) << id;
  }
}

/// The contact of JKR over a [m]: W goes with f0 by eqs 9 and 10.
struct Jkr {
  double r = kDiameter / 2.0, K = kSoft.stiffness, f0 = 8.9;
  double W = std::pow(2.0 * pi * f0, 1.5) / (6.0 * pi * std::sqrt(K * r));
  double mass = kSoft.density * pi / 6.0 * std::pow(kDiameter, 3);

  double approach(double a) const { return a * a / r - std::sqrt(8.0 * pi * W * a / (3.0 * K)); }
  double slope(double a) const { return 2.0 * a / r - std::sqrt(2.0 * pi * W / (3.0 * K * a)); }
  double load(double a) const {
    return K * a * a * a / r - std::sqrt(6.0 * pi * W * K * a * a * a);
  }
  /// Integral of P dn from touch to a, by Simpson's rule.
  double work(double a) const {
    const double a0 = std::cbrt(8.0 * pi * W * r * r / (3.0 * K));
    const int n = 2000;
    double sum = 0.0;
    for (int i = 0; i <= n; ++i) {
      const double x = a0 + (a - a0) * i / n;
      sum += (i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * load(x) * slope(x);
    }
    return sum * (a - a0) / (3.0 * n);
  }
  double speed(double V, double a) const {
    return std::sqrt(std::max(0.0, V * V - 2.0 * work(a) / mass));
  }
  double deepest(double V) const {
    double low = std::cbrt(6.0 * pi * W * r * r / K), high = r;
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      (V * V - 2.0 * work(middle) / mass > 0.0 ? low : high) = middle;
    }
    return low;
  }
};

TEST(CrackRateUnderJkr, TakesTheIntegralAlongTheUndampedPath) {
  const Jkr jkr;
  const double k = 0.5, factor = 1e-3;
  const double pull = std::cbrt(1.5 * pi * jkr.W * jkr.r * jkr.r / jkr.K);     // greatest pull
  const double parts = std::cbrt(pi * jkr.W * jkr.r * jkr.r / (6.0 * jkr.K));  // dn / da = 0
  for (const double V : {3.0, 10.0}) {
    const double most = jkr.deepest(V);
    const auto crack = [&](double a) { return std::pow(jkr.speed(V, a) / jkr.slope(a), k); };
    // The speed vanishes as a root at the deepest point: a = most - s^2, midpoints.
    const int n = 400;
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
      const double s = std::sqrt(most - pull) * (i + 0.5) / n;
      const double a = most - s * s;
      sum += 2.0 * pi * a * crack(a) * 2.0 * s * std::sqrt(most - pull) / n;
    }
    sum += pi * (pull * pull - parts * parts) * crack(pull);
    const double lost = 2.0 * factor * kSoft.adhesion_energy * sum / (jkr.mass * V * V);
    const Surroundings at = under(AdhesionLaw::jkr);
    const Base undamped{0.0, 0.0, jkr.f0};
    const double found = one_point::square(at, {}, {}, kDiameter, V, undamped) -
                         one_point::square(at, {"crack_rate"}, {factor, k}, kDiameter, V, undamped);
    EXPECT_NEAR(found / lost, 1.0, 2e-3) << V;
  }
}

TEST(BulkUnderJkr, TakesTheWorkOfTheRelaxingElasticForce) {
  // The force A d(K a^3 / r) / dt against the sphere, to first order along the undamped path: A
  // times the integral of (3 K a^2 / r) |n'| da, in and out.
  const Jkr jkr;
  const double A = 1e-13;
  const double touch = std::cbrt(8.0 * pi * jkr.W * jkr.r * jkr.r / (3.0 * jkr.K));
  const double parts = std::cbrt(pi * jkr.W * jkr.r * jkr.r / (6.0 * jkr.K));
  for (const double V : {3.0, 10.0}) {
    const double most = jkr.deepest(V);
    const auto one_way = [&](double from) {
      const int n = 400;
      double sum = 0.0;
      for (int i = 0; i < n; ++i) {
        const double s = std::sqrt(most - from) * (i + 0.5) / n;
        const double a = most - s * s;
        sum += 3.0 * jkr.K * a * a / jkr.r * jkr.speed(V, a) * 2.0 * s * std::sqrt(most - from) / n;
      }
      return sum;
    };
    const double lost = 2.0 * A * (one_way(touch) + one_way(parts)) / (jkr.mass * V * V);
    const Surroundings at = under(AdhesionLaw::jkr);
    const Base undamped{0.0, 0.0, jkr.f0};
    const double found = one_point::square(at, {}, {}, kDiameter, V, undamped) -
                         one_point::square(at, {"bulk_viscoelastic"}, {A}, kDiameter, V, undamped);
    EXPECT_NEAR(found / lost, 1.0, 2e-3) << V;
  }
}

}  // namespace
}  // namespace recoil
