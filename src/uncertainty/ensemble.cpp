#include "uncertainty/ensemble.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace recoil {
namespace {

std::vector<std::vector<double>> halves(const std::vector<std::vector<double>>& chains) {
  std::vector<std::vector<double>> split;
  for (const std::vector<double>& chain : chains) {
    const auto half = static_cast<std::ptrdiff_t>(chain.size() / 2);
    split.emplace_back(chain.begin(), chain.begin() + half);
    split.emplace_back(chain.end() - half, chain.end());
  }
  return split;
}

/// Within, and the marginal variance by within and between.
struct ChainVariances {
  double within = 0.0;
  double marginal = 0.0;
  std::vector<double> means;
};

ChainVariances variances_of(const std::vector<std::vector<double>>& chains) {
  ChainVariances v;
  const auto m = static_cast<double>(chains.size());
  const auto n = static_cast<double>(chains.front().size());
  double grand = 0.0;
  for (const std::vector<double>& chain : chains) {
    double mean = 0.0;
    for (const double x : chain) mean += x / n;
    double square = 0.0;
    for (const double x : chain) square += (x - mean) * (x - mean);
    v.within += square / (n - 1.0) / m;
    v.means.push_back(mean);
    grand += mean / m;
  }
  double between = 0.0;  // over n
  for (const double mean : v.means) between += (mean - grand) * (mean - grand) / (m - 1.0);
  v.marginal = v.within * (n - 1.0) / n + between;
  return v;
}

}  // namespace

Ensemble::Ensemble(LogDensity density, std::vector<std::vector<double>> start, RandomStream random)
    : density_(std::move(density)), walkers_(std::move(start)), random_(random) {
  assert(walkers_.size() % 2 == 0 && walkers_.size() > 2 * walkers_.front().size());
  for (const std::vector<double>& walker : walkers_) log_density_.push_back(density_(walker));
}

void Ensemble::step() {
  const std::size_t half = walkers_.size() / 2;
  const std::size_t p = walkers_.front().size();
  std::vector<double> proposal(p);
  for (const std::size_t first : {std::size_t{0}, half}) {
    const std::size_t other_half = half - first;  // 0 and half, or half and 0
    for (std::size_t k = first; k < first + half; ++k) {
      const std::vector<double>& other = walkers_[other_half + random_.below(half)];
      const double stretch = 0.5 * std::pow(random_.uniform() + 1.0, 2);
      const double chance = std::log(random_.uniform());
      for (std::size_t j = 0; j < p; ++j) {
        proposal[j] = other[j] + stretch * (walkers_[k][j] - other[j]);
      }
      const double there = density_(proposal);
      ++proposed_;
      const double gain =
          (static_cast<double>(p) - 1.0) * std::log(stretch) + there - log_density_[k];
      if (!(chance < gain)) continue;
      ++accepted_;
      walkers_[k] = proposal;
      log_density_[k] = there;
    }
  }
}

double Ensemble::acceptance() const {
  return proposed_ == 0 ? 0.0 : static_cast<double>(accepted_) / static_cast<double>(proposed_);
}

double split_r_hat(const std::vector<std::vector<double>>& chains) {
  const ChainVariances v = variances_of(halves(chains));
  if (!(v.within > 0.0)) return v.marginal > 0.0 ? INFINITY : 1.0;
  return std::sqrt(v.marginal / v.within);
}

double effective_sample_size(const std::vector<std::vector<double>>& chains) {
  const std::vector<std::vector<double>> split = halves(chains);
  const ChainVariances v = variances_of(split);
  const std::size_t n = split.front().size();
  const auto all = static_cast<double>(split.size() * n);
  if (!(v.within > 0.0)) return v.marginal > 0.0 ? 0.0 : all;
  const auto correlation = [&](std::size_t lag) {
    double covariance = 0.0;
    for (std::size_t c = 0; c < split.size(); ++c) {
      double sum = 0.0;
      for (std::size_t i = 0; i + lag < n; ++i) {
        sum += (split[c][i] - v.means[c]) * (split[c][i + lag] - v.means[c]);
      }
      covariance += sum / static_cast<double>(n) / static_cast<double>(split.size());
    }
    const auto length = static_cast<double>(n);
    return 1.0 - (v.within * (length - 1.0) / length - covariance) / v.marginal;
  };
  // Sums of two neighbours are positive and fall (Geyer 1992): the first that is not ends the sum.
  double time = -1.0;
  double last = INFINITY;
  for (std::size_t lag = 0; lag + 1 < n; lag += 2) {
    const double pair = (lag == 0 ? 1.0 : correlation(lag)) + correlation(lag + 1);
    if (!(pair > 0.0)) break;
    last = std::min(last, pair);
    time += 2.0 * last;
  }
  return all / std::max(time, 1.0 / std::log10(all));
}

}  // namespace recoil
