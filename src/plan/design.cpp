#include "plan/design.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace recoil {
namespace {

constexpr int most_admissions = 200;  // of places to the multiplicative algorithm
constexpr int rounds = 25;            // its iterations between admissions
// Relative excess of the largest d_i over the average, with one draw and with several.
constexpr double excess_at_end = 0.002, excess_of_several = 0.01;
constexpr double admitted_share = 1e-3;  // share of a place when it is admitted
constexpr double no_share = 1e-4;        // places with a smaller share are left out
constexpr int most_exchanges = 500;
constexpr std::size_t tried_exchanges = 12;
constexpr double worth_exchanging = 1e-6;  // least relative decrease of the sum of the variances

constexpr double singular = 1e-14;  // ratio of the extreme pivots

using Factor = Eigen::LLT<Eigen::MatrixXd>;

bool is_regular(const Factor& factor) {
  if (factor.info() != Eigen::Success) return false;
  const auto root = factor.matrixLLT().diagonal();
  return root.minCoeff() > std::sqrt(singular) * root.maxCoeff();
}

/// ln of `mean_sum_of`, and minus its slopes d_i in the counts.
struct Criterion {
  double log_sum = INFINITY;
  Eigen::VectorXd worth;  ///< empty where M is singular
};

Criterion criterion_of(const DesignProblems& draws, const std::vector<double>& counts) {
  Criterion found{0.0, Eigen::VectorXd::Zero(draws.front().rows.rows())};
  for (const DesignProblem& draw : draws) {
    const Factor factor(information_of(draw, counts));
    if (!is_regular(factor)) return {};
    const Eigen::MatrixXd solved = factor.solve(draw.asked);
    const double sum = draw.asked.cwiseProduct(solved).sum();
    if (!(sum > 0.0 && std::isfinite(sum))) return {};
    found.log_sum += std::log(sum);
    found.worth += (draw.rows * solved).rowwise().squaredNorm() / sum;
  }
  const auto count = static_cast<double>(draws.size());
  found.log_sum /= count;
  found.worth /= count;
  return found;
}

std::vector<double> times(std::vector<double> shares, double factor) {
  for (double& share : shares) share *= factor;
  return shares;
}

/// Iterations of the multiplicative algorithm among the places that have a share.
void multiply(const DesignProblems& draws, double points, std::vector<double>& shares) {
  std::vector<Eigen::Index> places;
  std::vector<double> own;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (!(shares[i] > 0.0)) continue;
    places.push_back(static_cast<Eigen::Index>(i));
    own.push_back(shares[i]);
  }
  DesignProblems among = draws;
  for (DesignProblem& draw : among) draw.rows = draw.rows(places, Eigen::all).eval();
  for (int round = 0; round < rounds; ++round) {
    const double total = std::accumulate(own.begin(), own.end(), 0.0);
    own = times(own, 1.0 / total);
    const Eigen::VectorXd worth = criterion_of(among, times(own, points)).worth;
    if (worth.size() == 0) return;
    for (std::size_t i = 0; i < own.size(); ++i) {
      own[i] *= std::sqrt(worth(static_cast<Eigen::Index>(i)));
    }
  }
  const double total = std::accumulate(own.begin(), own.end(), 0.0);
  if (!(total > 0.0)) return;
  double kept = 0.0;
  for (double& share : own) {
    share = share > no_share * total ? share : 0.0;
    kept += share;
  }
  for (std::size_t i = 0; i < own.size(); ++i) {
    shares[static_cast<std::size_t>(places[i])] = own[i] / kept;
  }
}

}  // namespace

std::vector<double> numbers_of(const std::vector<int>& counts) {
  return {counts.begin(), counts.end()};
}

Eigen::MatrixXd information_of(const DesignProblem& problem, const std::vector<double>& counts) {
  const auto informing = [&](const Eigen::MatrixXd& rows, const Eigen::VectorXd& n) {
    return Eigen::MatrixXd(problem.known + rows.transpose() * n.asDiagonal() * rows);
  };
  std::vector<Eigen::Index> places;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] != 0.0) places.push_back(static_cast<Eigen::Index>(i));
  }
  const Eigen::Map<const Eigen::VectorXd> n(counts.data(), problem.rows.rows());
  if (places.size() == counts.size()) return informing(problem.rows, n);
  return informing(problem.rows(places, Eigen::all), n(places));
}

Eigen::VectorXd variances_of(const DesignProblem& problem, const std::vector<double>& counts) {
  const Factor factor(information_of(problem, counts));
  if (!is_regular(factor)) return Eigen::VectorXd::Constant(problem.asked.cols(), INFINITY);
  return factor.matrixL().solve(problem.asked).colwise().squaredNorm().transpose();
}

double mean_sum_of(const DesignProblems& draws, const std::vector<double>& counts) {
  double sum = 0.0;
  for (const DesignProblem& draw : draws) sum += std::log(variances_of(draw, counts).sum());
  return std::exp(sum / static_cast<double>(draws.size()));
}

std::vector<double> optimal_shares(const DesignProblems& draws, double points,
                                   std::vector<double> shares) {
  const auto count = static_cast<std::size_t>(draws.front().rows.rows());
  if (shares.empty()) shares.assign(count, 1.0 / static_cast<double>(count));
  const double excess = draws.size() > 1 ? excess_of_several : excess_at_end;
  for (int k = 0; k < most_admissions; ++k) {
    const Eigen::VectorXd worth = criterion_of(draws, times(shares, points)).worth;
    if (worth.size() == 0) break;
    const double average =
        worth.dot(Eigen::Map<const Eigen::VectorXd>(shares.data(), worth.size()));
    if (!(worth.maxCoeff() > (1.0 + excess) * average)) break;
    for (std::size_t i = 0; i < count; ++i) {
      if (worth(static_cast<Eigen::Index>(i)) > average) shares[i] += admitted_share;
    }
    multiply(draws, points, shares);
  }
  return shares;
}

double least_possible_sum(const DesignProblems& draws, const std::vector<double>& counts) {
  const Criterion at = criterion_of(draws, counts);
  if (at.worth.size() == 0) return 0.0;
  const Eigen::Map<const Eigen::VectorXd> n(counts.data(), at.worth.size());
  return std::exp(at.log_sum + n.dot(at.worth) - n.sum() * at.worth.maxCoeff());
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

std::vector<int> after_exchanges(const DesignProblems& draws, std::vector<int> counts) {
  struct Exchange {
    double gain = 0.0;  // of the criterion, to first order
    std::size_t from = 0, to = 0;
  };
  for (int round = 0; round < most_exchanges; ++round) {
    const Criterion now = criterion_of(draws, numbers_of(counts));
    if (now.worth.size() == 0) break;
    const auto worth = [&](std::size_t i) { return now.worth(static_cast<Eigen::Index>(i)); };
    std::vector<Exchange> all;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (counts[i] == 0) continue;
      for (std::size_t j = 0; j < counts.size(); ++j) {
        if (worth(j) > worth(i)) all.push_back({worth(j) - worth(i), i, j});
      }
    }
    const auto tried =
        all.begin() + static_cast<std::ptrdiff_t>(std::min(tried_exchanges, all.size()));
    std::partial_sort(
        all.begin(), tried, all.end(),
        [](const Exchange& one, const Exchange& other) { return one.gain > other.gain; });
    const auto made = std::find_if(all.begin(), tried, [&](const Exchange& exchange) {
      std::vector<int> next = counts;
      --next[exchange.from];
      ++next[exchange.to];
      return std::log(mean_sum_of(draws, numbers_of(next))) < now.log_sum - worth_exchanging;
    });
    if (made == tried) break;
    --counts[made->from];
    ++counts[made->to];
  }
  return counts;
}

}  // namespace recoil
