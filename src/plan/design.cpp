#include "plan/design.hpp"

#include <algorithm>
#include <cmath>

namespace recoil {
namespace {

constexpr int most_rounds = 5000;        // iterations of the multiplicative algorithm
constexpr double excess_at_end = 0.002;  // relative excess of the largest d_i over the average
constexpr double no_share = 1e-9;        // points with a smaller share are omitted
constexpr int most_exchanges = 500;
constexpr double worth_exchanging = 1e-6;  // least relative decrease of the sum of the variances

constexpr double singular = 1e-14;  // reciprocal condition

using Factor = Eigen::LLT<Eigen::MatrixXd>;

bool is_regular(const Factor& factor) {
  return factor.info() == Eigen::Success && factor.rcond() > singular;
}

double sum_of_variances(const Eigen::MatrixXd& information, const Eigen::MatrixXd& asked) {
  const Factor factor(information);
  if (!is_regular(factor)) return INFINITY;
  const double sum = factor.matrixL().solve(asked).squaredNorm();
  return std::isfinite(sum) ? sum : INFINITY;
}

/// d_i of every point; empty where M is singular.
Eigen::VectorXd worth_of_points(const DesignProblem& problem, const Eigen::MatrixXd& information) {
  const Factor factor(information);
  if (!is_regular(factor)) return {};
  const Eigen::MatrixXd solved = factor.solve(problem.asked);
  return (problem.rows * solved).rowwise().squaredNorm();
}

}  // namespace

std::vector<double> numbers_of(const std::vector<int>& counts) {
  return {counts.begin(), counts.end()};
}

Eigen::MatrixXd information_of(const DesignProblem& problem, const std::vector<double>& counts) {
  const Eigen::Map<const Eigen::VectorXd> n(counts.data(), problem.rows.rows());
  return problem.known + problem.rows.transpose() * n.asDiagonal() * problem.rows;
}

Eigen::VectorXd variances_of(const DesignProblem& problem, const std::vector<double>& counts) {
  const Factor factor(information_of(problem, counts));
  if (!is_regular(factor)) return Eigen::VectorXd::Constant(problem.asked.cols(), INFINITY);
  return factor.matrixL().solve(problem.asked).colwise().squaredNorm().transpose();
}

std::vector<double> optimal_shares(const DesignProblem& problem, double points) {
  const auto count = static_cast<std::size_t>(problem.rows.rows());
  std::vector<double> shares(count, 1.0 / static_cast<double>(count));
  std::vector<double> counts(count);
  for (int round = 0; round < most_rounds; ++round) {
    for (std::size_t i = 0; i < count; ++i) counts[i] = points * shares[i];
    const Eigen::VectorXd worth = worth_of_points(problem, information_of(problem, counts));
    if (worth.size() == 0) break;
    double average = 0.0;
    double total = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double d = worth(static_cast<Eigen::Index>(i));
      average += shares[i] * d;
      shares[i] *= std::sqrt(d);
      total += shares[i];
    }
    if (!(total > 0.0)) break;
    for (double& share : shares) {
      share /= total;
      if (share < no_share) share = 0.0;
    }
    if (worth.maxCoeff() < (1.0 + excess_at_end) * average) break;
  }
  return shares;
}

double least_possible_sum(const DesignProblem& problem, const std::vector<double>& counts) {
  const Eigen::MatrixXd information = information_of(problem, counts);
  const Eigen::VectorXd worth = worth_of_points(problem, information);
  if (worth.size() == 0) return 0.0;
  const Eigen::Map<const Eigen::VectorXd> n(counts.data(), problem.rows.rows());
  const double now = sum_of_variances(information, problem.asked);
  return std::max(0.0, now + n.dot(worth) - n.sum() * worth.maxCoeff());
}

std::vector<int> whole_points(const std::vector<double>& shares, int points) {
  const auto made = std::ranges::count_if(shares, [](double w) { return w > 0.0; });
  std::vector<int> counts(shares.size(), 0);
  int total = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (!(shares[i] > 0.0)) continue;
    counts[i] = std::max(
        0, static_cast<int>(std::ceil((points - 0.5 * static_cast<double>(made)) * shares[i])));
    total += counts[i];
  }
  // Adds the point with the smallest n / w, or removes the one with the largest (n - 1) / w.
  for (; total != points; total += total < points ? 1 : -1) {
    const bool add = total < points;
    std::size_t best = shares.size();
    double least = INFINITY;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      if (!(shares[i] > 0.0) || (!add && counts[i] == 0)) continue;
      const double ratio = add ? counts[i] / shares[i] : -(counts[i] - 1) / shares[i];
      if (ratio < least) best = i;
      least = std::min(least, ratio);
    }
    if (best == shares.size()) break;
    counts[best] += add ? 1 : -1;
  }
  return counts;
}

std::vector<int> after_exchanges(const DesignProblem& problem, std::vector<int> counts) {
  Eigen::MatrixXd information = information_of(problem, numbers_of(counts));
  double now = sum_of_variances(information, problem.asked);
  const auto count = static_cast<Eigen::Index>(counts.size());
  const auto square = [&](Eigen::Index i) -> Eigen::MatrixXd {
    return problem.rows.row(i).transpose() * problem.rows.row(i);
  };
  for (int round = 0; round < most_exchanges; ++round) {
    double best = now;
    Eigen::Index from = -1;
    Eigen::Index to = -1;
    for (Eigen::Index i = 0; i < count; ++i) {
      if (counts[static_cast<std::size_t>(i)] == 0) continue;
      const Eigen::MatrixXd without = information - square(i);
      for (Eigen::Index j = 0; j < count; ++j) {
        if (j == i) continue;
        const double sum = sum_of_variances(without + square(j), problem.asked);
        if (sum >= best) continue;
        best = sum;
        from = i;
        to = j;
      }
    }
    if (from < 0 || (std::isfinite(now) && !(best < (1.0 - worth_exchanging) * now))) break;
    --counts[static_cast<std::size_t>(from)];
    ++counts[static_cast<std::size_t>(to)];
    information = information_of(problem, numbers_of(counts));
    now = best;
  }
  return counts;
}

}  // namespace recoil
