// The contact of Maugis against his own equations, solved here by bisection over a / c, and against
// what others published about it.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "data/contact.hpp"
#include "impact/impact.hpp"

namespace recoil {
namespace {

using std::numbers::pi;

double bisect(const std::function<double(double)>& rising, double low, double high) {
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (rising(middle) > 0.0 ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

/// Maugis (1992), eqs 6.15 to 6.18, in his units; across a gap Kim, McMeeking & Johnson (1998).
struct Dugdale {
  double lambda;

  struct State {
    double approach, elastic, adhesive;
    double load() const { return elastic - adhesive; }
  };
  /// In contact, at m = c / a.
  State at_m(double m) const {
    const double angle = std::acos(1.0 / m);
    const double root = std::sqrt(m * m - 1.0);
    const double A = 0.5 * lambda * ((m * m - 2.0) * angle + root);
    const double B = 4.0 / 3.0 * lambda * lambda * (root * angle - m + 1.0);
    const double a = (-B + std::sqrt(B * B + 4.0 * A)) / (2.0 * A);
    return {a * a - 4.0 / 3.0 * lambda * a * root, a * a * a,
            lambda * a * a * (root + m * m * angle)};
  }
  /// Across a gap, the stress acting out to c.
  State at_c(double c) const {
    return {0.5 * c * c - 8.0 / (3.0 * pi) * lambda * c - 2.0 / (pi * lambda), 0.0,
            0.5 * pi * lambda * c * c};
  }
  double reach() const { return 2.0 / (pi * lambda); }
  /// c as the contact opens or closes.
  double c_at_touch() const {
    return bisect(
        [&](double c) {
          return pi / 4.0 * lambda * c * c + 4.0 / 3.0 * lambda * lambda * c * (pi / 2.0 - 1.0) -
                 1.0;
        },
        0.0, 10.0 / std::sqrt(lambda) + 10.0 / (lambda * lambda));
  }
  double c_at_parting() const { return 8.0 * lambda / (3.0 * pi); }
  /// The smallest approach of the stable branch.
  double parting() const {
    if (c_at_parting() < c_at_touch()) return at_c(c_at_parting()).approach;
    return at_share(share_at_parting()).approach;
  }
  /// a / c from 0 to 1.
  State at_share(double k) const { return at_m(1.0 / k); }
  double share_at_parting() const {
    double best = 1e-6;
    for (double k = 1e-6; k < 0.99999; k += 1e-5) {
      if (at_share(k).approach < at_share(best).approach) best = k;
    }
    return bisect(
        [&](double k) {
          return at_share(k * (1.0 + 1e-7)).approach - at_share(k * (1.0 - 1e-7)).approach;
        },
        std::max(1e-7, best - 2e-5), best + 2e-5);
  }
};

/// The stable branch as a table over the approach, for an integrator.
class Branch {
 public:
  explicit Branch(double lambda)
      : law_{lambda},
        touch_(law_.c_at_touch()),
        gap_(law_.c_at_parting() < touch_),
        lowest_share_(gap_ ? 1e-9 : law_.share_at_parting()),
        parting_(law_.parting()) {}

  double parting() const { return parting_; }
  Dugdale::State at(double n) const {
    if (gap_ && n < law_.at_c(touch_).approach) {
      return law_.at_c(
          bisect([&](double c) { return law_.at_c(c).approach - n; }, law_.c_at_parting(), touch_));
    }
    // t = (m^2 - 1)^(1/2) falls with n; its logarithm is even over the decades.
    const double most = std::sqrt(1.0 / (lowest_share_ * lowest_share_) - 1.0);
    const double log_t =
        bisect([&](double x) { return n - law_.at_m(std::sqrt(1.0 + std::exp(2.0 * x))).approach; },
               std::log(most) - 25.0, std::log(most));
    return law_.at_m(std::sqrt(1.0 + std::exp(2.0 * log_t)));
  }

 private:
  Dugdale law_;
  double touch_;
  bool gap_;
  double lowest_share_, parting_;
};

/// Loss of an undamped impact, in (W^5 r^4 / E*^2)^(1/3): the work of the branch from the jump in
/// to the parting.
double work_lost(double lambda) {
  const Branch branch(lambda);
  const double from = branch.parting();
  const double to = -Dugdale{lambda}.reach();
  // The load has a root at the parting: n = from + s^2.
  const int steps = 2000;
  const double length = std::sqrt(to - from);
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double s = length * i / steps;
    const double weight = i == 0 || i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * 2.0 * s * branch.at(from + s * s + 1e-14).load();
  }
  const double unit = std::pow(pi, 5.0 / 3.0) * std::pow(4.0 / 3.0, -2.0 / 3.0);
  return -unit * sum * length / (3.0 * steps);
}

ImpactResult simulated(const ImpactGroups& groups, AdhesionLaw law = AdhesionLaw::maugis,
                       AdhesionDampingPhase phase = AdhesionDampingPhase::rebound) {
  ImpactOptions options;
  options.adhesion = law;
  options.phase = phase;
  options.budget = true;
  options.tolerance = 1e-12;
  return simulate_impact(groups, options);
}

/// (W^5 r^4 / E*^2)^(1/3) over m V^2 / 2: V*^2 of JKR is 0.358757^2 V_a^2 = 7.09217 of these.
double energy_unit(double beta) { return 0.358757 * 0.358757 / 7.09217 * std::pow(beta, 2.5); }

TEST(Maugis, LambdaIsThatOfHisPaper) {
  // lambda = 1.157 mu for the stress of a Lennard-Jones force (Johnson & Greenwood 1997, J. Colloid
  // Interface Sci. 192, 326): ammonium fluorescein of 4.9 um, W = 0.35 J/m2, E* = 1.342 GPa.
  const double r = 2.45e-6, W = 0.35, E = 1.342e9, z0 = 0.3e-9;
  const double mu = std::cbrt(r * W * W / (E * E)) / z0;
  const double K = 4.0 / 3.0 * E;
  const double f0 = adhesion_force_for(W, r, K);
  EXPECT_NEAR(maugis_parameter(f0, K, z0) / mu, 1.157, 5e-4);
}

TEST(Maugis, LosesTheWorkBetweenTheJumps) {
  for (const double lambda : {0.2, 0.5, 0.6, 0.7, 0.9, 0.95, 1.2, 2.0, 5.0, 20.0}) {
    const double expected = work_lost(lambda);
    EXPECT_GT(expected, 0.0);
    EXPECT_LT(expected, 7.0922);
    for (const double beta : {0.1, 0.8}) {
      const ImpactResult impact = simulated({0.0, beta, 0.0, 0.0, lambda});
      EXPECT_NEAR((1.0 - impact.restitution_squared) / energy_unit(beta), expected,
                  2e-5 * (1.0 + expected) + 1e-9 / energy_unit(beta))
          << lambda << " " << beta;
    }
  }
}

TEST(Maugis, LosesTheWorkOfJkrAtLargeLambdaAndNothingAtSmall) {
  const auto lost = [](double lambda) {
    const double beta = 0.8;
    return (1.0 - simulated({0.0, beta, 0.0, 0.0, lambda}).restitution_squared) / energy_unit(beta);
  };
  // The bodies jump in at a distance of 2 / (pi lambda), which JKR takes for nothing.
  EXPECT_NEAR(lost(1e3), 7.0922, 0.006);
  EXPECT_NEAR(lost(1e5), 7.0922, 2e-4);
  EXPECT_NEAR(lost(0.03), 0.0, 1e-5);
  double before = 0.0;
  for (const double lambda : {0.05, 0.2, 0.5, 0.8, 0.94, 1.1, 2.0, 6.0, 30.0}) {
    EXPECT_GT(lost(lambda), before);
    before = lost(lambda);
  }
}

TEST(Maugis, PullsByThePublishedCurve) {
  // Carpick, Ogletree & Salmeron (1999), J. Colloid Interface Sci. 211, 395-400: lambda = -0.924
  // ln(1 - 1.02 alpha), and their polynomial for the pull-off under a given load, good to 1 %.
  // 2 pi W r = (beta^(3/2) / 3) m V^2 / n_c.
  for (const double lambda : {0.05, 0.2, 0.5, 0.8, 1.0, 1.5, 3.0, 10.0}) {
    const double alpha = (1.0 - std::exp(-lambda / 0.924)) / 1.02;
    const double published = 0.267 * alpha * alpha - 0.767 * alpha + 2.0;
    const double beta = 0.5;
    const double unit = std::pow(beta, 1.5) / 6.0;  // pi W r
    EXPECT_NEAR(simulated({0.0, beta, 0.0, 0.0, lambda}).force_tension / unit / published, 1.0,
                0.012)
        << lambda;
  }
}

TEST(Maugis, BecomesJkrWithBothDampings) {
  for (const double beta : {0.05, 0.5, 1.2}) {
    for (const auto phase : {AdhesionDampingPhase::rebound, AdhesionDampingPhase::both}) {
      const ImpactGroups groups{0.03, beta, 0.2, 0.0, 0.0};
      const double jkr = simulated(groups, AdhesionLaw::jkr, phase).restitution_squared;
      const auto away = [&](double lambda) {
        ImpactGroups with_range = groups;
        with_range.range = lambda;
        return std::abs(simulated(with_range, AdhesionLaw::maugis, phase).restitution_squared -
                        jkr);
      };
      EXPECT_LT(away(1e3), 2e-3 * std::pow(beta, 2.5) + 1e-6);
      EXPECT_LT(away(1e5), 0.1 * away(1e3) + 1e-9) << beta;
    }
  }
}

TEST(Maugis, HasNoDashpot) {
  ImpactOptions options;
  options.adhesion = AdhesionLaw::maugis;
  options.dashpot = true;
  EXPECT_FALSE(simulate_impact({0.03, 0.5, 0.2, 0.05, 1.0}, options).usable());
  EXPECT_FALSE(simulate_impact_fast({0.03, 0.5, 0.2, 0.05, 1.0}, options).usable());
}

TEST(Maugis, BecomesDmtWithinTheReachOfItsForces) {
  // As lambda vanishes the bodies meet Hertz's contact under 2 pi W r as long as n is small against
  // the reach 2 / (pi lambda); the attraction on the way there is a gain U on the way in and a cost
  // U on the way out: e^2 V^2 = e_c^2 V_c^2 - 2 U / m, V_c^2 = V^2 + 2 U / m, e_c by DMT. U is the
  // integral of pi W r (pi / 2) lambda c^2 over n as far as c = c* (Kim et al.).
  const double beta = 1.2, alpha = 0.2;
  for (const double lambda : {0.01, 0.003}) {
    const Dugdale law{lambda};
    const double strength = std::pow(6.0, -5.0 / 3.0) * std::pow(beta, 2.5);
    const double c0 = 16.0 * lambda / (3.0 * pi);  // after the jump
    const double c1 = law.c_at_touch();
    const auto energy = [&](double c) {
      return 0.5 * pi * lambda * (std::pow(c, 4) / 4.0 - 8.0 / (9.0 * pi) * lambda * c * c * c);
    };
    const double gain = 2.0 * strength * (energy(c1) - energy(c0));
    const double faster = std::sqrt(1.0 + gain);
    const ImpactGroups contact{alpha * faster, beta * std::pow(faster, -0.8), 0.0};
    const double expected =
        simulated(contact, AdhesionLaw::dmt).restitution_squared * faster * faster - gain;
    const double found = simulated({alpha, beta, 0.0, 0.0, lambda}).restitution_squared;
    EXPECT_NEAR((found - expected) / (1.0 - expected), 0.0, 8.0 * lambda) << lambda;
  }
}

/// Classical Runge-Kutta steps on x'' in the units of the solver.
double integrated(const ImpactGroups& g, bool both) {
  const Branch branch(g.range);
  const double length = std::pow(6.0, -2.0 / 3.0) * g.beta;  // of n, in n_c
  const double force = std::pow(g.beta, 1.5) / 6.0;
  const auto acceleration = [&](double x, double u) {
    const auto state = branch.at(std::max(x / length, branch.parting()));
    const double damped = both || u < 0.0 ? -g.gamma * u : 0.0;
    return -force * (state.elastic * (1.0 + g.alpha * u) - state.adhesive * (1.0 + damped));
  };
  double x = -Dugdale{g.range}.reach() * length, u = 1.0;
  const double dt = 1e-3;
  for (int i = 0; i < 100000; ++i) {
    const double k1 = acceleration(x, u);
    const double k2 = acceleration(x + 0.5 * dt * u, u + 0.5 * dt * k1);
    const double k3 = acceleration(x + 0.5 * dt * (u + 0.5 * dt * k1), u + 0.5 * dt * k2);
    const double k4 = acceleration(x + dt * (u + 0.5 * dt * k2), u + dt * k3);
    const double x0 = x, u0 = u;
    x += dt * u + dt * dt / 6.0 * (k1 + k2 + k3);
    u += dt / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
    const double end = branch.parting() * length;
    if (u < 0.0 && x <= end) {
      const double part = (x0 - end) / (x0 - x);
      const double last = u0 + part * (u - u0);
      return last * last;
    }
    if (u0 < 0.0 && u >= 0.0) return -1.0;
  }
  return NAN;
}

TEST(Maugis, DampedImpactsAreThoseOfAnotherIntegrator) {
  for (const double lambda : {0.3, 0.75, 1.5, 8.0}) {
    for (const bool both : {false, true}) {
      const ImpactGroups groups{0.05, 0.5, 0.3, 0.0, lambda};
      const ImpactResult impact =
          simulated(groups, AdhesionLaw::maugis,
                    both ? AdhesionDampingPhase::both : AdhesionDampingPhase::rebound);
      EXPECT_NEAR(impact.restitution_squared, integrated(groups, both), 2e-5) << lambda;
    }
  }
}

TEST(Maugis, TheDeepestPointIsThatOfTheUndampedImpact) {
  for (const AdhesionLaw law : {AdhesionLaw::jkr, AdhesionLaw::dmt, AdhesionLaw::maugis}) {
    for (const double beta : {0.02, 0.4, 1.5}) {
      for (const double lambda : {0.3, 0.8, 1.2, 6.0}) {
        const DeepestContact deepest = deepest_contact(law, beta, lambda);
        const ImpactResult impact = simulated({0.0, beta, 0.0, 0.0, lambda}, law);
        const double x = impact.penetration_max;
        if (law == AdhesionLaw::dmt) {
          EXPECT_NEAR(deepest.square.value / x, 1.0, 1e-5);
          EXPECT_NEAR(deepest.stored.value / (0.4 * std::pow(x, 2.5)), 1.0, 1e-5);
        } else if (law == AdhesionLaw::maugis) {
          const double length = std::pow(6.0, -2.0 / 3.0) * beta;
          const double cube = Branch(lambda).at(x / length).elastic;
          EXPECT_NEAR(deepest.square.value / (std::pow(cube, 2.0 / 3.0) * length), 1.0, 1e-5);
        } else {
          // n = a^2 / r - (8 pi W a / (3 K))^(1/2), where (8 pi W / (3 K))^(1/2) in units of n_c is
          // (2/3) beta^(3/4).
          const double a = std::sqrt(deepest.square.value);
          EXPECT_NEAR(a * a - 2.0 / 3.0 * std::pow(beta, 0.75) * std::sqrt(a), x, 1e-5 * x);
        }
        const double h = 1e-6;
        const auto slope = [&](double by_beta, double by_range, auto member) {
          const auto at = [&](double s) {
            return (deepest_contact(law, beta * (1.0 + s * by_beta),
                                    lambda * (1.0 + s * by_range)).*
                    member)
                .value;
          };
          return (at(h) - at(-h)) / (2.0 * h);
        };
        for (const auto member : {&DeepestContact::square, &DeepestContact::stored}) {
          const auto& quantity = deepest.*member;
          EXPECT_NEAR(quantity.by_beta * beta, slope(1.0, 0.0, member), 1e-6 * quantity.value);
          EXPECT_NEAR(quantity.by_range * lambda, slope(0.0, 1.0, member), 1e-6 * quantity.value);
        }
      }
    }
  }
}

}  // namespace
}  // namespace recoil
