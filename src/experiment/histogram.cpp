#include "experiment/histogram.hpp"

#include <algorithm>
#include <cmath>

#include "core/statistics.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_bins = 2000;

std::size_t sturges_bins(std::size_t n) {
  return static_cast<std::size_t>(std::ceil(1.0 + std::log2(static_cast<double>(n)) - 1e-9));
}

Histogram filled(const std::vector<double>& values, std::size_t bins, HistogramRule rule) {
  Histogram histogram;
  histogram.rule = rule;
  if (values.empty()) return histogram;
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  histogram.lower = *lowest;
  histogram.width = (*highest - *lowest) / static_cast<double>(bins);
  if (!(histogram.width > 0.0)) {  // all alike: one bin about them
    bins = 1;
    histogram.width = std::max(std::abs(*lowest) * 1e-3, 1e-12);
    histogram.lower -= 0.5 * histogram.width;
  }
  histogram.counts.assign(bins, 0);
  for (const double value : values) {
    const double place = (value - histogram.lower) / histogram.width;
    ++histogram.counts[std::min(static_cast<std::size_t>(std::max(place, 0.0)), bins - 1)];
  }
  return histogram;
}

}  // namespace

Histogram sturges(const std::vector<double>& values) {
  return filled(values, sturges_bins(std::max<std::size_t>(values.size(), 1)),
                HistogramRule::sturges);
}

Histogram freedman_diaconis(const std::vector<double>& values) {
  std::size_t bins = sturges_bins(std::max<std::size_t>(values.size(), 1));
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  if (!sorted.empty()) {
    const double spread = sorted_quantile(sorted, 0.75) - sorted_quantile(sorted, 0.25);
    const double width = 2.0 * spread / std::cbrt(static_cast<double>(sorted.size()));
    if (width > 0.0) {
      const double wanted = std::ceil((sorted.back() - sorted.front()) / width);
      bins = static_cast<std::size_t>(std::clamp(wanted, 1.0, static_cast<double>(most_bins)));
    }
  }
  return filled(values, bins, HistogramRule::freedman_diaconis);
}

}  // namespace recoil
