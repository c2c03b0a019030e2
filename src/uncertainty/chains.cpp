#include "uncertainty/chains.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "core/statistics.hpp"

namespace recoil {
namespace {

ChainDraws halves(const ChainDraws& chains) {
  ChainDraws split;
  for (const std::vector<double>& chain : chains) {
    const auto half = static_cast<std::ptrdiff_t>(chain.size() / 2);
    split.emplace_back(chain.begin(), chain.begin() + half);
    split.emplace_back(chain.end() - half, chain.end());
  }
  return split;
}

/// Applies `map` to all draws.
template <class Map>
ChainDraws mapped(ChainDraws chains, const Map& map) {
  for (std::vector<double>& chain : chains) {
    for (double& x : chain) x = map(x);
  }
  return chains;
}

std::vector<double> sorted(const ChainDraws& chains) {
  std::vector<double> all;
  for (const std::vector<double>& chain : chains) all.insert(all.end(), chain.begin(), chain.end());
  std::sort(all.begin(), all.end());
  return all;
}

ChainDraws rank_normalised(const ChainDraws& chains) {
  const std::vector<double> all = sorted(chains);
  return mapped(chains, [&all](double x) {
    const auto [first, last] = std::equal_range(all.begin(), all.end(), x);
    const double rank =  // equal draws share their mean rank
        0.5 * static_cast<double>((first - all.begin()) + (last - all.begin()) + 1);
    return gsl_cdf_ugaussian_Pinv((rank - 0.375) / (static_cast<double>(all.size()) + 0.25));
  });
}

/// The p-quantile of an ascending sample, type 7 of Hyndman & Fan (1996).
double quantile_of(const std::vector<double>& ascending, double p) {
  const double at = p * static_cast<double>(ascending.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, ascending.size() - 1);
  return std::lerp(ascending[below], ascending[above], at - std::floor(at));
}

struct ChainVariances {
  double within = 0.0;
  double marginal = 0.0;
  std::vector<double> means;

  explicit ChainVariances(const ChainDraws& chains) {
    for (const std::vector<double>& chain : chains) {
      means.push_back(mean(chain));
      within += std::pow(standard_deviation(chain), 2) / static_cast<double>(chains.size());
    }
    const auto n = static_cast<double>(chains.front().size());
    marginal = within * (n - 1.0) / n + std::pow(standard_deviation(means), 2);
  }
};

double r_hat(const ChainDraws& chains) {
  const ChainVariances v(chains);
  if (!(v.within > 0.0)) return v.marginal > 0.0 ? INFINITY : 1.0;
  return std::sqrt(v.marginal / v.within);
}

double effective_draws(const ChainDraws& chains) {
  const ChainVariances v(chains);
  const std::size_t n = chains.front().size();
  const auto all = static_cast<double>(chains.size() * n);
  if (!(v.within > 0.0)) return v.marginal > 0.0 ? 0.0 : all;
  const auto correlation = [&](std::size_t lag) {
    if (lag == 0) return 1.0;
    double covariance = 0.0;
    for (std::size_t c = 0; c < chains.size(); ++c) {
      for (std::size_t i = 0; i + lag < n; ++i) {
        covariance += (chains[c][i] - v.means[c]) * (chains[c][i + lag] - v.means[c]);
      }
    }
    return 1.0 - (v.within - covariance / all) / v.marginal;
  };
  // Sums of two neighbouring correlations are positive and decrease: the sum ends at the first
  // negative one, or at the end of the chain.
  double time = -1.0;
  double last = INFINITY;
  for (std::size_t lag = 0; lag + 1 < n; lag += 2) {
    const double even = correlation(lag);
    const double pair = even + correlation(lag + 1);
    if (pair < 0.0 || lag + 5 >= n) {
      time += std::max(even, 0.0);
      break;
    }
    last = std::min(last, pair);
    time += 2.0 * last;
  }
  return all / std::max(time, 1.0 / std::log10(all));
}

/// Shape k and scale of a generalised Pareto distribution.
struct Pareto {
  double k = 0.0;
  double scale = 0.0;
};

/// @param x above 0, ascending
Pareto fit_pareto(std::span<const double> x) {
  const auto n = static_cast<double>(x.size());
  const auto mean_log = [&](double b) {
    double sum = 0.0;
    for (const double value : x) sum += std::log1p(-b * value);
    return sum / n;
  };
  const int trials = 30 + static_cast<int>(std::sqrt(n));
  const double quarter = x[static_cast<std::size_t>(n / 4.0 + 0.5) - 1];
  std::vector<double> b, likelihood;
  for (int i = 1; i <= trials; ++i) {
    b.push_back(1.0 / x.back() + (1.0 - std::sqrt(trials / (i - 0.5))) / (3.0 * quarter));
    const double k = mean_log(b.back());
    likelihood.push_back(n * (std::log(-b.back() / k) - k - 1.0));
  }
  const double most = *std::max_element(likelihood.begin(), likelihood.end());
  double sum = 0.0, weighted = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const double weight = std::exp(likelihood[i] - most);
    sum += weight;
    weighted += weight * b[i];
  }
  const double best = weighted / sum;
  const double k = mean_log(best);
  return {(n * k + 5.0) / (n + 10.0), -k / best};
}

struct SmoothedWeights {
  std::vector<double> log_weight;  // shifted so that the largest raw weight is 0
  double pareto_k = 0.0;
};

SmoothedWeights smoothed_weights(std::vector<double> log_weight, double r_eff) {
  const std::size_t draws = log_weight.size();
  const double most = *std::max_element(log_weight.begin(), log_weight.end());
  for (double& ln : log_weight) ln -= most;
  std::vector<std::size_t> order(draws);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return log_weight[a] != log_weight[b] ? log_weight[a] < log_weight[b] : a < b;
  });
  const auto count = static_cast<double>(draws);
  const auto largest =
      static_cast<std::size_t>(std::ceil(std::min(0.2 * count, 3.0 * std::sqrt(count / r_eff))));
  const double cutoff = std::exp(log_weight[order[draws - largest - 1]]);
  std::vector<double> above;
  for (std::size_t i = draws - largest; i < draws; ++i) {
    const double excess = std::exp(log_weight[order[i]]) - cutoff;
    if (excess > 0.0) above.push_back(excess);
  }
  constexpr std::size_t fewest = 5;
  // Equal weights have no tail.
  if (above.empty() || above.back() <= 1e-12) return {std::move(log_weight), -INFINITY};
  if (above.size() < fewest) return {std::move(log_weight), INFINITY};
  const Pareto tail = fit_pareto(above);
  for (std::size_t j = 0; std::isfinite(tail.k) && j < above.size(); ++j) {
    const double p = (static_cast<double>(j) + 0.5) / static_cast<double>(above.size());
    const double excess = std::abs(tail.k) < std::numeric_limits<double>::epsilon()
                              ? -tail.scale * std::log1p(-p)
                              : tail.scale * std::expm1(-tail.k * std::log1p(-p)) / tail.k;
    log_weight[order[draws - above.size() + j]] = std::min(0.0, std::log(excess + cutoff));
  }
  return {std::move(log_weight), tail.k};
}

}  // namespace

ChainCheck check_chains(const ChainDraws& chains) {
  const ChainDraws split = halves(chains);
  const ChainDraws bulk = rank_normalised(split);
  const double middle = quantile_of(sorted(split), 0.5);
  const ChainDraws folded =
      rank_normalised(mapped(split, [middle](double x) { return std::abs(x - middle); }));
  ChainCheck check{std::max(r_hat(bulk), r_hat(folded)), effective_draws(bulk), INFINITY};
  const std::vector<double> all = sorted(chains);
  for (const double p : {0.05, 0.95}) {
    const double end = quantile_of(all, p);
    const ChainDraws below = mapped(split, [end](double x) { return x <= end ? 1.0 : 0.0; });
    check.tail = std::min(check.tail, effective_draws(below));
  }
  return check;
}

double relative_efficiency(const ChainDraws& chains) {
  const auto all = static_cast<double>(chains.size() * chains.front().size());
  return effective_draws(halves(chains)) / all;
}

double largest_pareto_k(std::size_t draws) {
  return std::min(1.0 - 1.0 / std::log10(static_cast<double>(draws)), 0.7);
}

LeftOutPoint leave_out_of_chains(const std::vector<double>& log_likelihood, std::size_t chains) {
  const double most = *std::max_element(log_likelihood.begin(), log_likelihood.end());
  const std::size_t length = log_likelihood.size() / chains;
  ChainDraws likelihood(chains);
  for (std::size_t i = 0; i < chains * length; ++i) {
    likelihood[i / length].push_back(std::exp(log_likelihood[i] - most));
  }
  const double r_eff = relative_efficiency(likelihood);
  return leave_out(log_likelihood, r_eff > 0.0 ? r_eff : 1.0 / static_cast<double>(length));
}

LeftOutPoint leave_out(const std::vector<double>& log_likelihood, double r_eff) {
  std::vector<double> inverse;
  for (const double ln : log_likelihood) inverse.push_back(-ln);
  const auto [log_weight, pareto_k] = smoothed_weights(std::move(inverse), r_eff);
  const double least = *std::min_element(log_likelihood.begin(), log_likelihood.end());
  LeftOutPoint point{.pareto_k = pareto_k, .r_eff = r_eff};
  double sum = 0.0, predicted = 0.0;
  for (std::size_t s = 0; s < log_weight.size(); ++s) {
    sum += std::exp(log_weight[s]);
    predicted += std::exp(log_weight[s] + log_likelihood[s] - least);
  }
  const double found = predicted / sum;  // over exp(least)
  point.elpd = least + std::log(found);
  double variance = 0.0;
  for (std::size_t s = 0; s < log_weight.size(); ++s) {
    const double part = std::exp(log_weight[s] + log_likelihood[s] - least) / found;
    variance += std::pow((part - std::exp(log_weight[s])) / sum, 2) / r_eff;
  }
  point.mcse = std::sqrt(std::log1p(variance));
  return point;
}

}  // namespace recoil
