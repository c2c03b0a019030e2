// Designs whose optimum is known in closed form.
#include "plan/design.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace {

using recoil::DesignProblem;

/// Regression on 1, x, ... x^(p - 1), at 41 places of [-1, 1], with errors of size 1.
DesignProblem polynomial(Eigen::Index p, const Eigen::MatrixXd& asked) {
  DesignProblem problem;
  problem.rows.resize(41, p);
  for (Eigen::Index i = 0; i < 41; ++i) {
    const double x = -1.0 + static_cast<double>(i) / 20.0;
    for (Eigen::Index k = 0; k < p; ++k) problem.rows(i, k) = std::pow(x, static_cast<double>(k));
  }
  problem.known = Eigen::MatrixXd::Zero(p, p);
  problem.asked = asked;
  return problem;
}

/// The shares of the places within 0.11 of `x`.
double share_about(const std::vector<double>& shares, double x) {
  double sum = 0.0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (std::abs(-1.0 + static_cast<double>(i) / 20.0 - x) < 0.11) sum += shares[i];
  }
  return sum;
}

double sum_of(const DesignProblem& problem, const std::vector<double>& counts) {
  return recoil::variances_of(problem, counts).sum();
}

std::vector<double> times(std::vector<double> shares, double points) {
  for (double& share : shares) share *= points;
  return shares;
}

TEST(Design, OneSlopeThroughTheOriginIsLearntAtTheFarEnd) {
  DesignProblem problem;
  problem.rows = Eigen::VectorXd::LinSpaced(21, 0.0, 2.0);
  problem.known = Eigen::MatrixXd::Zero(1, 1);
  problem.asked = Eigen::MatrixXd::Ones(1, 1);
  const std::vector<double> shares = recoil::optimal_shares({problem}, 8.0);
  EXPECT_GT(shares[20] + shares[19], 0.99);
  EXPECT_NEAR(sum_of(problem, times(shares, 8.0)), 1.0 / (8.0 * 4.0), 0.003 / 32.0);
  const std::vector<int> whole =
      recoil::after_exchanges({problem}, recoil::whole_points(shares, 8));
  EXPECT_EQ(whole.back(), 8);
}

TEST(Design, AStraightLineIsLearntAtItsTwoEnds) {
  const DesignProblem problem = polynomial(2, Eigen::MatrixXd::Identity(2, 2));
  const std::vector<double> shares = recoil::optimal_shares({problem}, 1.0);
  EXPECT_NEAR(share_about(shares, -1.0), 0.5, 0.01);
  EXPECT_NEAR(share_about(shares, 1.0), 0.5, 0.01);
  EXPECT_NEAR(sum_of(problem, shares), 2.0, 0.005);
  const std::vector<int> whole =
      recoil::after_exchanges({problem}, recoil::whole_points(shares, 10));
  EXPECT_EQ(whole.front(), 5);
  EXPECT_EQ(whole.back(), 5);
}

// Elfving (1952): a line on [-1, 1] predicted at x = 2 needs (x + 1) / 2x of the points at 1 and
// the rest at -1, and its variance is x^2.
TEST(Design, AnExtrapolationLeansOnTheNearEnd) {
  const DesignProblem problem = polynomial(2, Eigen::Vector2d(1.0, 2.0));
  const std::vector<double> shares = recoil::optimal_shares({problem}, 1.0);
  EXPECT_NEAR(share_about(shares, 1.0), 0.75, 0.02);
  EXPECT_NEAR(share_about(shares, -1.0), 0.25, 0.02);
  EXPECT_NEAR(sum_of(problem, shares), 4.0, 0.01);
}

// The A-optimal design of a parabola on [-1, 1] has 1/4, 1/2, 1/4 at -1, 0, 1, and the trace 8
// (Atkinson, Donev & Tobias 2007, Optimum Experimental Designs).
TEST(Design, AParabolaIsLearntAtThreePlaces) {
  const DesignProblem problem = polynomial(3, Eigen::MatrixXd::Identity(3, 3));
  const std::vector<double> shares = recoil::optimal_shares({problem}, 1.0);
  EXPECT_NEAR(sum_of(problem, shares), 8.0, 0.02);
  EXPECT_NEAR(share_about(shares, -1.0), 0.25, 0.02);
  EXPECT_NEAR(share_about(shares, 0.0), 0.5, 0.05);
  EXPECT_NEAR(share_about(shares, 1.0), 0.25, 0.02);
  EXPECT_GT(recoil::least_possible_sum({problem}, shares), 8.0 * 0.99);
  EXPECT_LE(recoil::least_possible_sum({problem}, shares), 8.0 + 1e-9);
  const std::vector<int> whole =
      recoil::after_exchanges({problem}, recoil::whole_points(shares, 8));
  EXPECT_EQ(whole.front(), 2);
  EXPECT_EQ(whole[20], 4);
  EXPECT_EQ(whole.back(), 2);
}

// What is known already need not be learnt: with the intercept known, all go where the slope is.
TEST(Design, WhatIsKnownCounts) {
  DesignProblem problem = polynomial(2, Eigen::Vector2d(1.0, 0.0));
  problem.known(0, 0) = 1e6;
  problem.asked = Eigen::Vector2d(0.0, 1.0);
  const std::vector<double> shares = recoil::optimal_shares({problem}, 10.0);
  EXPECT_NEAR(share_about(shares, -1.0) + share_about(shares, 1.0), 1.0, 0.01);
  EXPECT_NEAR(sum_of(problem, times(shares, 10.0)), 0.1, 0.001);
  // The variance of the intercept itself, by the inverse of a 2 x 2 matrix.
  const Eigen::MatrixXd M = recoil::information_of(problem, std::vector<double>(41, 1.0));
  problem.asked = Eigen::Vector2d(1.0, 0.0);
  EXPECT_NEAR(sum_of(problem, std::vector<double>(41, 1.0)),
              M(1, 1) / (M(0, 0) * M(1, 1) - M(0, 1) * M(1, 0)), 1e-12);
}

TEST(Design, NothingBeatsTheBound) {
  const DesignProblem problem = polynomial(3, Eigen::MatrixXd::Identity(3, 3));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double optimum = sum_of(problem, recoil::optimal_shares({problem}, 1.0));
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<double> shares(41);
    for (double& share : shares) share = uniform(random);
    const double total = std::accumulate(shares.begin(), shares.end(), 0.0);
    for (double& share : shares) share /= total;
    EXPECT_GE(sum_of(problem, shares), optimum * 0.99);
    EXPECT_LE(recoil::least_possible_sum({problem}, shares), 8.0 + 1e-9);
  }
}

TEST(Design, RoundingKeepsTheNumberOfPointsAndTheirProportions) {
  const std::vector<double> shares = {0.0, 0.37, 0.21, 0.0, 0.42};
  for (int points = 1; points < 60; ++points) {
    const std::vector<int> whole = recoil::whole_points(shares, points);
    EXPECT_EQ(std::accumulate(whole.begin(), whole.end(), 0), points);
    EXPECT_EQ(whole[0] + whole[3], 0);
    for (std::size_t i = 0; i < shares.size(); ++i) {
      EXPECT_LT(std::abs(whole[i] - points * shares[i]), 1.5) << points;
    }
  }
}

TEST(Design, ExchangesFindTheWayFromABadStart) {
  const DesignProblem problem = polynomial(2, Eigen::MatrixXd::Identity(2, 2));
  std::vector<int> start(41, 0);
  start[20] = 5;
  start[21] = 5;
  const std::vector<int> found = recoil::after_exchanges({problem}, start);
  EXPECT_EQ(found.front(), 5);
  EXPECT_EQ(found.back(), 5);
}

TEST(Design, WhatCannotBeKnownHasNoFiniteVariance) {
  DesignProblem problem = polynomial(2, Eigen::MatrixXd::Identity(2, 2));
  std::vector<double> one_place(41, 0.0);
  one_place[3] = 10.0;
  EXPECT_EQ(sum_of(problem, one_place), INFINITY);
}

}  // namespace
