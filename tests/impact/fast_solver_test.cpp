// The fast solver never gives a different answer from the reference.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "impact/dop853.hpp"
#include "impact/impact.hpp"
#include "impact/phase_rule.hpp"

namespace recoil {
namespace {

TEST(Dop853, RowsAndWeightsFulfilTheOrderConditionsTheyMust) {
  double nodes[dop853::stages] = {};
  for (int i = 0; i < dop853::stages; ++i) {
    for (int j = 0; j < i; ++j) nodes[i] += dop853::stage[i][j];
  }
  for (int order = 1; order <= 8; ++order) {  // quadrature: sum b c^(k-1) = 1/k
    double sum = 0.0;
    for (int i = 0; i < dop853::stages; ++i) {
      sum += dop853::weight[i] * std::pow(nodes[i], order - 1);
    }
    EXPECT_NEAR(sum, 1.0 / order, 1e-14) << "order " << order;
  }
  double nested = 0.0;  // sum b_i a_ij c_j^5 = 1/42 (order 7)
  for (int i = 0; i < dop853::stages; ++i) {
    for (int j = 0; j < i; ++j) {
      nested += dop853::weight[i] * dop853::stage[i][j] * std::pow(nodes[j], 5);
    }
  }
  EXPECT_NEAR(nested, 1.0 / 42.0, 1e-14);
}

void expect_exact(const GaussRule& rule) {
  const std::size_t count = rule.count;
  const auto integral = [&](const GaussRule::Row& row, int power) {
    double sum = 0.0;
    for (std::size_t j = 0; j < count; ++j) sum += row[j] * std::pow(rule.node[j], power);
    return sum;
  };
  for (int power = 0; power < 2 * static_cast<int>(count); ++power) {
    EXPECT_NEAR(integral(rule.weight, power), 1.0 / (power + 1), 1e-15) << "power " << power;
  }
  for (int power = 0; power < static_cast<int>(count); ++power) {
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_NEAR(integral(rule.up_to[i], power), std::pow(rule.node[i], power + 1) / (power + 1),
                  2e-15);
    }
    const auto anywhere = rule.integral_up_to(0.3);
    EXPECT_NEAR(integral(anywhere, power), std::pow(0.3, power + 1) / (power + 1), 2e-15);
    // s, and s (1 - s), times the polynomial
    const double s = 0.3;
    const auto powers = [&](int n) { return std::pow(s, n + 1) / (n + 1); };
    const auto one_end = rule.integral_up_to(s, rule.vanishing(false));
    EXPECT_NEAR(integral(one_end, power + 1), powers(power + 1), 1e-14);
    const auto both_ends = rule.integral_up_to(s, rule.vanishing(true));
    EXPECT_NEAR(integral(both_ends, power + 1) - integral(both_ends, power + 2),
                powers(power + 1) - powers(power + 2), 1e-14);
  }
  // Neither coefficient is in a polynomial of lower degree.
  EXPECT_NEAR(integral(rule.last, static_cast<int>(count) - 2), 0.0, 1e-13);
  EXPECT_NEAR(integral(rule.last_but_one, static_cast<int>(count) - 3), 0.0, 1e-13);
  EXPECT_GT(std::abs(integral(rule.last, static_cast<int>(count) - 1)), 1e-20);
}

TEST(GaussRule, IsExactForPolynomials) {
  for (const std::size_t nodes : {8, 16, 24}) expect_exact(GaussRule(nodes));
}

struct Draw {
  double w, h, g;  // V / V_a, C_H V_a, C_A V_a
  AdhesionDampingPhase phase;
  double lambda = 1.5;  // of Maugis
};

ImpactGroups groups_of(const Draw& d) {
  return {d.h * d.w, std::pow(d.w, -0.8), d.g * d.w, 0.0, d.lambda};
}

bool captures_without_damping(AdhesionLaw law) {
  return law == AdhesionLaw::jkr || law == AdhesionLaw::maugis;
}

class WideBox {
 public:
  explicit WideBox(AdhesionLaw law = AdhesionLaw::ring) : law_(law) {}

  Draw next() {
    return {between(0.02, 1000.0), zero_or(1e-6, 1.5), zero_or(1e-6, 1.5),
            flip() ? AdhesionDampingPhase::both : AdhesionDampingPhase::rebound,
            law_ == AdhesionLaw::maugis ? between(0.03, 100.0) : 1.5};
  }
  /// Moves `d` to a relative distance 1e-6 to 1e-1 from its capture velocity, on either side.
  bool approach_capture(Draw& d) {
    if (d.h == 0.0 && d.g == 0.0 && !captures_without_damping(law_)) return false;
    ImpactOptions options;
    options.adhesion = law_;
    options.phase = d.phase;
    double low = 1e-3, high = 50.0;
    for (int i = 0; i < 50; ++i) {
      Draw trial = d;
      trial.w = std::sqrt(low * high);
      const bool back = simulate_impact_fast(groups_of(trial), options).restitution_squared > 0.0;
      (back ? high : low) = trial.w;
    }
    d.w = low * (1.0 + (flip() ? 1.0 : -1.0) * between(1e-6, 1e-1));
    return high < 49.0;
  }
  bool flip() { return unit_(random_) < 0.5; }
  double between(double low, double high) { return low * std::pow(high / low, unit_(random_)); }

 private:
  double zero_or(double low, double high) {
    return unit_(random_) < 0.2 ? 0.0 : between(low, high);
  }

  AdhesionLaw law_;
  std::mt19937_64 random_{20260101};
  std::uniform_real_distribution<double> unit_{0.0, 1.0};
};

/// How deep a captured sphere can lie, or 1: (8/15) beta^(5/2) under the ring law, less under JKR
/// and DMT, and 2 pi W r (W / s0) / (m V^2 / 2) more where the pull reaches as far as W / s0.
double depth_of_well(AdhesionLaw law, const ImpactGroups& groups) {
  const double unit = std::pow(groups.beta, 2.5);
  const double reach = law == AdhesionLaw::maugis ? 0.13 / groups.range : 0.0;
  return std::max(1.0, (0.534 + reach) * unit);
}

void compare(const ImpactGroups& groups, AdhesionDampingPhase phase,
             AdhesionLaw law = AdhesionLaw::ring) {
  ImpactOptions options;
  options.dashpot = groups.kappa > 0.0;
  options.adhesion = law;
  options.phase = phase;
  options.gradient = true;
  options.tolerance = 1e-12;
  const ImpactResult fast = simulate_impact_fast(groups, options);
  const ImpactResult reference = simulate_impact(groups, options);
  const auto where = testing::Message()
                     << "alpha " << groups.alpha << " beta " << groups.beta << " gamma "
                     << groups.gamma << " kappa " << groups.kappa << " lambda " << groups.range
                     << " " << to_string(phase) << " " << to_string(law);
  ASSERT_EQ(fast.outcome, reference.outcome) << where;
  // e^2 below capture is as large as the adhesive well, (8/15) beta^(5/2).
  const double yardstick = depth_of_well(law, groups);
  EXPECT_NEAR(fast.restitution_squared, reference.restitution_squared, 1e-9 * yardstick) << where;
  // As adhesion vanishes the slope of JKR in beta grows without limit; that in ln beta does not.
  const bool vanishing = captures_without_damping(law) && groups.beta < 1e-3;
  for (std::size_t k = 0; k < 5; ++k) {
    double unit = vanishing && k == 1 ? groups.beta : 1.0;
    if (k == 4) unit = groups.range;
    const double size = std::max(yardstick, std::abs(unit * reference.gradient[k]));
    EXPECT_NEAR(unit * fast.gradient[k], unit * reference.gradient[k], 1e-7 * size)
        << "group " << k << " at " << where;
  }
}

class EveryLaw : public testing::TestWithParam<AdhesionLaw> {
 protected:
  static void compare_draw(const Draw& draw) { compare(groups_of(draw), draw.phase, GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(Adhesion, EveryLaw, testing::ValuesIn(values_of<AdhesionLaw>()),
                         [](const auto& law) { return to_string(law.param); });

TEST_P(EveryLaw, AgreesWithTheReferenceOverAWideBox) {
  WideBox box(GetParam());
  for (int i = 0; i < 400; ++i) compare_draw(box.next());
}

TEST_P(EveryLaw, AgreesWithTheReferenceNearCapture) {
  WideBox box(GetParam());
  int compared = 0;
  for (int i = 0; i < 300; ++i) {
    Draw draw = box.next();
    if (!box.approach_capture(draw)) continue;
    compare_draw(draw);
    ++compared;
  }
  EXPECT_GT(compared, 150);
}

TEST_P(EveryLaw, AgreesWithTheReferenceAsTheAdhesionVanishes) {
  WideBox box;
  for (const double beta : {0.0, 1e-300, 1e-15, 1e-13, 1e-9, 1e-6, 1e-4}) {
    for (const double alpha : {0.0, 0.1, 1.0, 10.0}) {
      const double lambda = 1.5;
      compare({alpha, beta, 0.0, 0.0, lambda}, AdhesionDampingPhase::rebound, GetParam());
      compare({alpha, beta, box.between(1e-3, 1.0), 0.0, lambda}, AdhesionDampingPhase::both,
              GetParam());
    }
  }
}

TEST_P(EveryLaw, AgreesWithTheReferenceWithoutOneOfTheDampings) {
  for (const double w : {0.05, 0.3, 1.0, 3.0, 30.0}) {
    for (const double damping : {0.0, 1e-6, 0.01, 0.3, 1.2}) {
      for (const auto phase : {AdhesionDampingPhase::rebound, AdhesionDampingPhase::both}) {
        compare_draw({w, damping, 0.0, phase});
        compare_draw({w, 0.0, damping, phase});
      }
    }
  }
}

// Critical damping, (C_H + C_A) V_a = 2 (ring), 2 sqrt(9/10) (JKR): from there on the reference,
// which knows of no shortcut, must find the same.
struct Creep {
  AdhesionLaw law;
  double critical;
};
class EveryCreep : public testing::TestWithParam<Creep> {};
INSTANTIATE_TEST_SUITE_P(Adhesion, EveryCreep,
                         testing::Values(Creep{AdhesionLaw::ring, 2.0},
                                         Creep{AdhesionLaw::jkr, 1.8973665961010278}),
                         [](const auto& creep) { return to_string(creep.param.law); });

TEST_P(EveryCreep, IsKnownWithoutFollowingIt) {
  const auto& [law, critical] = GetParam();
  for (const double damping : {critical, 1.025 * critical, 1.5 * critical}) {
    for (const double share : {0.0, 0.3, 1.0}) {
      for (const double w : {0.5, 1.0, 10.0, 200.0, 3000.0}) {
        const ImpactGroups groups{share * damping * w, std::pow(w, -0.8),
                                  (1.0 - share) * damping * w};
        ImpactOptions options;
        options.adhesion = law;
        options.gradient = true;
        const ImpactResult fast = simulate_impact_fast(groups, options);
        const ImpactResult reference = simulate_impact(groups, options);
        ASSERT_EQ(reference.outcome, ImpactOutcome::captured) << damping << " " << w;
        EXPECT_EQ(fast.outcome, ImpactOutcome::captured);
        EXPECT_NEAR(fast.restitution_squared, reference.restitution_squared, 1e-9 / (w * w));
        EXPECT_NEAR(fast.gradient[1], reference.gradient[1], 1e-7);
      }
    }
  }
}

// Strong damping of the adhesion, as the optimiser tries it under every law: a sphere that creeps
// takes the reference seconds, or all of its steps. The values are C_A V of a fit with V from 1 to
// 100 m/s and C_A up to its bound of 10 s/m, at work of adhesion from 1 to 3000 times its start.
TEST_P(EveryLaw, HandsOverNothingToCreep) {
  ImpactOptions options;
  options.adhesion = GetParam();
  options.gradient = true;
  std::vector<ImpactGroups> impacts;
  for (const double beta : {60.0, 8.0, 2.0, 0.5, 0.125, 0.04, 0.01, 1e-3}) {
    for (const double gamma : {20.0, 60.0, 200.0, 350.0, 600.0, 1000.0}) {
      for (const double alpha : {0.0, 0.2, 50.0}) {
        for (const double lambda : {0.1, 1.7, 6.0, 20.0, 557.0}) {
          impacts.push_back({alpha, beta, gamma, 0.0, lambda});
        }
      }
    }
  }
  std::vector<ImpactResult> results(impacts.size());
  EXPECT_EQ(simulate_impacts_fast(impacts, options, results), 0);
  for (const ImpactResult& result : results) EXPECT_TRUE(result.usable());
}

class EveryBorderOfCreep : public testing::TestWithParam<AdhesionLaw> {};
INSTANTIATE_TEST_SUITE_P(Adhesion, EveryBorderOfCreep,
                         testing::Values(AdhesionLaw::dmt, AdhesionLaw::maugis),
                         [](const auto& law) { return to_string(law.param); });

// Where a fast sphere can leave an overdamped well, the answer is known only from a damping on
// that grows with V. The reference must find the same on both sides of it.
TEST_P(EveryBorderOfCreep, IsFollowedBelowAndKnownAbove) {
  ImpactOptions options;
  options.adhesion = GetParam();
  for (const double w : {0.5, 1.0, 10.0, 100.0}) {
    for (const double share : {0.0, 0.5}) {
      for (const double lambda : {0.3, 5.0}) {
        const auto groups = [&](double damping) {
          return ImpactGroups{share * damping * w, std::pow(w, -0.8), (1.0 - share) * damping * w,
                              0.0, lambda};
        };
        double followed = 0.1, known = 1e3;
        while (known > 1.0001 * followed) {
          const double middle = std::sqrt(followed * known);
          const bool by_steps = simulate_impact_fast(groups(middle), options).steps > 0;
          (by_steps ? followed : known) = middle;
        }
        compare(groups(0.98 * known), AdhesionDampingPhase::rebound, GetParam());
        compare(groups(1.02 * known), AdhesionDampingPhase::rebound, GetParam());
        EXPECT_EQ(simulate_impact_fast(groups(1.02 * known), options).outcome,
                  ImpactOutcome::captured);
      }
    }
  }
}

TEST_P(EveryLaw, SameAnswerAtEveryTolerance) {
  WideBox box(GetParam());
  for (int i = 0; i < 200; ++i) {
    const Draw draw = box.next();
    ImpactOptions options;
    options.adhesion = GetParam();
    options.phase = draw.phase;
    options.gradient = true;
    const ImpactResult usual = simulate_impact_fast(groups_of(draw), options);
    options.fast_tolerance = 1e-12;
    const ImpactResult tight = simulate_impact_fast(groups_of(draw), options);
    const double yardstick = depth_of_well(GetParam(), groups_of(draw));
    EXPECT_NEAR(usual.restitution_squared, tight.restitution_squared, 1e-9 * yardstick);
    EXPECT_LT(usual.steps, tight.steps + 1);
  }
}

class EveryDashpot : public testing::TestWithParam<AdhesionLaw> {};
// Maugis's law has none.
INSTANTIATE_TEST_SUITE_P(Adhesion, EveryDashpot,
                         testing::Values(AdhesionLaw::ring, AdhesionLaw::jkr, AdhesionLaw::dmt),
                         [](const auto& law) { return to_string(law.param); });

TEST_P(EveryDashpot, AgreesWithTheReference) {
  WideBox box(GetParam());
  for (int i = 0; i < 200; ++i) {
    Draw draw = box.next();
    draw.w = std::max(draw.w, 0.5);  // the reference follows no slower creep to its end
    ImpactGroups groups = groups_of(draw);
    groups.kappa = box.between(1e-3, 3.0);
    compare(groups, draw.phase, GetParam());
  }
}

// An ordinary impact is solved phase by phase, in a few sweeps over the nodes; an integration
// takes 30 steps and more.
TEST_P(EveryLaw, TakesFewSweepsForAnOrdinaryImpact) {
  for (const double w : {3.0, 10.0, 40.0}) {
    ImpactOptions options;
    options.adhesion = GetParam();
    options.gradient = true;
    const ImpactResult impact =
        simulate_impact_fast({0.003 * w, std::pow(w, -0.8), 0.05 * w, 0.0, 8.0}, options);
    EXPECT_EQ(impact.outcome, ImpactOutcome::rebound);
    EXPECT_LT(impact.steps, 28) << w;
  }
}

// Between two turning points the sweeps shrink by less and less. Ended as those of a rebound are,
// one capture in fifteen had a derivative that errs by more than this, ten times less than
// promised.
TEST(FastSolver, DerivativesOfCapturesAreNoWorseThanThoseOfRebounds) {
  WideBox box;
  ImpactOptions options;
  options.gradient = true;
  options.tolerance = 1e-12;
  int captured = 0;
  for (int i = 0; i < 400; ++i) {
    const double w = box.between(0.3, 3.0);
    const ImpactGroups groups{box.between(1e-3, 1.0), std::pow(w, -0.8), box.between(1e-4, 1.0)};
    const ImpactResult fast = simulate_impact_fast(groups, options);
    const ImpactResult reference = simulate_impact(groups, options);
    ASSERT_EQ(fast.outcome, reference.outcome);
    if (fast.outcome == ImpactOutcome::captured) ++captured;
    for (std::size_t k = 0; k < 3; ++k) {
      const double size = std::max(1.0, std::abs(reference.gradient[k]));
      EXPECT_NEAR(fast.gradient[k], reference.gradient[k], 1e-8 * size)
          << "group " << k << " at alpha " << groups.alpha << " beta " << groups.beta << " gamma "
          << groups.gamma;
    }
  }
  EXPECT_GT(captured, 100);
}

// So strongly damped that explicit steps become tiny: the reference answers, and is counted.
TEST(FastSolver, HandsOverInsteadOfGuessing) {
  const ImpactGroups stiff{2e5, 1e-8, 0.0};
  ImpactResult fast;
  EXPECT_EQ(simulate_impacts_fast({&stiff, 1}, {}, {&fast, 1}), 1);
  const ImpactResult reference = simulate_impact(stiff, {});
  EXPECT_EQ(fast.outcome, reference.outcome);
  EXPECT_EQ(fast.restitution_squared, reference.restitution_squared);
}

TEST_P(EveryLaw, HandsOverNothingInTheBox) {
  WideBox box(GetParam());
  ImpactOptions options;
  options.adhesion = GetParam();
  std::vector<ImpactGroups> impacts;
  for (int i = 0; i < 2000; ++i) {
    const Draw draw = box.next();
    // Maugis's law is followed as far as that without adhesion, and stiffer.
    if (draw.h * draw.w > (GetParam() == AdhesionLaw::maugis ? 300.0 : 1000.0)) continue;
    impacts.push_back(groups_of(draw));
  }
  std::vector<ImpactResult> results(impacts.size());
  EXPECT_EQ(simulate_impacts_fast(impacts, options, results), 0);
}

TEST(FastSolver, RefusesWhatIsNoImpact) {
  const double nan = std::nan("");
  for (const ImpactGroups& groups : {ImpactGroups{nan, 0.1, 0.1}, ImpactGroups{0.1, -1.0, 0.1},
                                     ImpactGroups{0.1, 0.1, INFINITY}}) {
    EXPECT_EQ(simulate_impact_fast(groups, {}).outcome, ImpactOutcome::integration_failure);
  }
}

}  // namespace
}  // namespace recoil
