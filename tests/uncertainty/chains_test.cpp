// What chains say of themselves, against closed forms and the authors' own programs.
#include "uncertainty/chains.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "core/random.hpp"

namespace recoil {
namespace {

/// The generator of Numerical Recipes, which R repeats exactly in doubles:
/// s <- (1664525 * s + 1013904223) %% 4294967296; (s + 0.5) / 4294967296
std::vector<double> uniforms(std::uint64_t s, int n) {
  std::vector<double> u;
  for (int i = 0; i < n; ++i) {
    s = (1664525 * s + 1013904223) % 4294967296;
    u.push_back((static_cast<double>(s) + 0.5) / 4294967296.0);
  }
  return u;
}

/// Four chains x_i = phi x_(i-1) + u_i - 1/2, with shift * c added to chain c = 1 to 4.
ChainDraws chains_with(double phi, double shift) {
  ChainDraws chains;
  for (int c = 1; c <= 4; ++c) {
    std::vector<double>& chain = chains.emplace_back();
    double x = 0.0;
    for (const double u : uniforms(static_cast<std::uint64_t>(c), 200)) {
      x = phi * x + u - 0.5;
      chain.push_back(x + shift * c);
    }
  }
  return chains;
}

void expect_check(const ChainDraws& chains, double r_hat, double bulk, double tail) {
  const ChainCheck check = check_chains(chains);
  EXPECT_NEAR(check.r_hat, r_hat, 1e-10);
  EXPECT_NEAR(check.bulk, bulk, 1e-7);
  EXPECT_NEAR(check.tail, tail, 1e-7);
}

TEST(Chains, AreThoseOfThePackagePosterior) {
  // rhat(x), ess_bulk(x), ess_tail(x) of the R package posterior 1.4.0 (Buerkner, Gabry, Kay &
  // Vehtari) for these chains as columns of x.
  expect_check(chains_with(0.6, 0.0), 1.007196516490, 222.4165222947, 424.2353731750);
  expect_check(chains_with(0.9, 0.05), 1.056267178625, 62.3051730538, 123.3939703655);
  expect_check(chains_with(-0.5, 0.0), 0.996670374586, 2322.4719895936, 805.7505722058);
  expect_check(chains_with(0.0, 0.3), 1.565009129242, 7.2215708064, 32.2548207500);
  // Chains of one mean, one of them three times as wide: only the folded R-hat sees it.
  ChainDraws wide = chains_with(0.3, 0.0);
  for (double& x : wide.front()) x *= 3.0;
  expect_check(wide, 1.133843961695, 458.1684683895, 42.1260364991);
}

TEST(Chains, EffectiveSizeIsThatOfAnAutoregression) {
  // x_{t+1} = phi x_t + sqrt(1 - phi^2) z: autocorrelation phi^t, so that n steps are worth
  // n (1 - phi) / (1 + phi) independent draws.
  for (const double phi : {0.0, 0.5, 0.9}) {
    ChainDraws chains;
    for (std::uint64_t c = 0; c < 8; ++c) {
      RandomStream random(5, RandomPurpose::posterior, c);
      double x = random.normal();
      std::vector<double>& chain = chains.emplace_back();
      for (int i = 0; i < 5000; ++i) {
        chain.push_back(x);
        x = phi * x + std::sqrt(1.0 - phi * phi) * random.normal();
      }
    }
    const ChainCheck check = check_chains(chains);
    EXPECT_NEAR(check.bulk / (8.0 * 5000.0 * (1.0 - phi) / (1.0 + phi)), 1.0, 0.1) << phi;
    EXPECT_NEAR(check.r_hat, 1.0, 0.005) << phi;
  }
}

TEST(Chains, ThatStandStillApartHaveNoEnd) {
  EXPECT_EQ(check_chains({{1.0, 1.0, 1.0, 1.0}, {2.0, 2.0, 2.0, 2.0}}).r_hat, INFINITY);
}

TEST(LeftOut, IsThatOfThePackageLoo) {
  // psis(-ll, r_eff = r_eff) of the R package loo 2.5.1 (Vehtari, Gabry, Magnusson, Yao, Buerkner,
  // Paananen & Gelman) for ll = k ln(u) - 1: weights u^-k have a Pareto tail of shape k. With its
  // weights w, E = sum(w exp(ll)) and v = sum(w^2 (exp(ll) - E)^2) / r_eff: ln E and
  // sqrt(ln(1 + v / E^2)).
  const double expected[][5] = {
      {0.2, 1.0, 0.291596241127, -1.221913420593, 0.008094043008},
      {0.7, 1.0, 0.712835365097, -2.112270337469, 0.080664122033},
      {1.1, 1.0, 1.049084809757, -3.478926182931, 0.278414073004},
      {0.2, 0.3, 0.192095878093, -1.221829687790, 0.014567152597},
      {0.7, 0.3, 0.614894840328, -2.096553505360, 0.127978020602},
      {0.7, 1.6, 0.753959125838, -2.118197357603, 0.067174984944},
  };
  for (const auto& [k, r_eff, shape, elpd, mcse] : expected) {
    std::vector<double> ln;
    for (const double u : uniforms(9, 1000)) ln.push_back(k * std::log(u) - 1.0);
    const LeftOutPoint point = leave_out(ln, r_eff);
    EXPECT_NEAR(point.pareto_k, shape, 1e-9);
    EXPECT_NEAR(point.elpd, elpd, 1e-9);
    EXPECT_NEAR(point.mcse, mcse, 1e-9);
  }
}

TEST(LeftOut, OfChainsHasTheirRelativeEfficiency) {
  // The same for ll = -8 (x - 0.3)^2 of the chains above, with r_eff = ess_mean(exp(ll)) / 800 of
  // the R package posterior 1.4.0.
  const double expected[][5] = {
      {0.6, 0.41133693273777, 1.63583552667770, -6.32594073028150, 0.71649284910942},
      {-0.5, 1.82552953018340, 0.96466935468075, -4.65286238093520, 0.25434360631124},
      {0.0, 1.00595214810130, -0.61579752057490, -2.73064508163050, 0.07424606385680},
  };
  for (const auto& [phi, r_eff, shape, elpd, mcse] : expected) {
    std::vector<double> ln;
    for (const std::vector<double>& chain : chains_with(phi, 0.0)) {
      for (const double x : chain) ln.push_back(-8.0 * (x - 0.3) * (x - 0.3));
    }
    const LeftOutPoint point = leave_out_of_chains(ln, 4);
    EXPECT_NEAR(point.r_eff, r_eff, 1e-9) << phi;
    EXPECT_NEAR(point.pareto_k, shape, 1e-8) << phi;
    EXPECT_NEAR(point.elpd, elpd, 1e-8) << phi;
    EXPECT_NEAR(point.mcse, mcse, 1e-8) << phi;
  }
}

TEST(LeftOut, LimitsOfTheShapeDependOnTheDraws) {
  EXPECT_DOUBLE_EQ(largest_pareto_k(100), 0.5);
  EXPECT_NEAR(largest_pareto_k(1000), 2.0 / 3.0, 1e-15);
  EXPECT_DOUBLE_EQ(largest_pareto_k(4000), 0.7);
}

TEST(LeftOut, OfAPointThatSaysNothingChangesNothing) {
  const LeftOutPoint point = leave_out(std::vector<double>(1000, -2.0));
  EXPECT_DOUBLE_EQ(point.elpd, -2.0);
  EXPECT_EQ(point.pareto_k, -INFINITY);
}

TEST(LeftOut, OfAPointThatThreeDrawsMakeImprobableHasNoShape) {
  std::vector<double> ln(1000, -2.0);
  for (const std::size_t i : {10U, 500U, 900U})
    ln[i] = -2.0 - std::log(1e3 + static_cast<double>(i));
  EXPECT_EQ(leave_out(ln).pareto_k, INFINITY);
}

TEST(LeftOut, OfChainsThatStandStillCountsNoHalfTwice) {
  std::vector<double> ln(400, -2.0);
  for (std::size_t i = 200; i < 400; ++i) ln[i] = -1.0;
  EXPECT_LE(leave_out_of_chains(ln, 4).r_eff, 8.0 / 400.0);
}

}  // namespace
}  // namespace recoil
