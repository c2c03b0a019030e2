#include "mechanism/mixed_sizes.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/units.hpp"
#include "mechanism/survivors_mean.hpp"

namespace recoil {
namespace {

/// The part of the spheres that is smaller than a diameter, at the ends of the bins.
using Cumulative = std::vector<std::pair<double, double>>;  // part, diameter

Cumulative cumulative_of(const MeasuredSizes& sizes) {
  Cumulative knots;
  double below = 0.0;
  for (const SizeBin& bin : sizes.bins) {
    const double part = bin.weight / sizes.total();
    if (bin.width > 0.0) {
      knots.emplace_back(below, bin.diameter - 0.5 * bin.width);
      knots.emplace_back(below + part, bin.diameter + 0.5 * bin.width);
    } else {
      knots.emplace_back(below + 0.5 * part, bin.diameter);
    }
    below += part;
  }
  return knots;
}

double quantile(const Cumulative& knots, double part) {
  if (part <= knots.front().first) return knots.front().second;
  const auto above = std::find_if(knots.begin(), knots.end(),
                                  [&](const auto& knot) { return knot.first >= part; });
  if (above == knots.end()) return knots.back().second;
  const auto below = above - 1;
  const double width = above->first - below->first;
  if (!(width > 0.0)) return above->second;
  return below->second + (above->second - below->second) * (part - below->first) / width;
}

}  // namespace

MixedSizes mixed_sizes_of(const MeasuredSizes& sizes) {
  MixedSizes out;
  constexpr int parts = 50;  // of a bin, over which ln d is averaged
  double mean_log = 0.0;
  double square = 0.0;
  const std::vector<SizeBin> fine = spread_within_bins(sizes.bins, parts);
  for (const SizeBin& bin : fine) {
    mean_log += bin.weight / sizes.total() * std::log(bin.diameter);
  }
  for (const SizeBin& bin : fine) {
    square += bin.weight / sizes.total() * std::pow(std::log(bin.diameter) - mean_log, 2);
  }
  if (!(square > 0.0)) return out;
  out.spread = std::sqrt(square);
  const Cumulative knots = cumulative_of(sizes);
  const double least = gsl_cdf_ugaussian_P(-spread_reach);
  for (std::size_t k = 0; k < spread_nodes; ++k) {
    const double part = (gsl_cdf_ugaussian_P(spread_positions()[k]) - least) / (1.0 - 2.0 * least);
    out.shape[k] = std::log(quantile(knots, part) / sizes.mean_diameter()) / out.spread;
  }
  out.slowest_seen = std::sqrt(2.0 * standard_gravity * sizes.probe_height.value_or(0.0));
  return out;
}

}  // namespace recoil
