#include "experiment/averages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "core/statistics.hpp"
#include "core/units.hpp"
#include "experiment/flight.hpp"

namespace recoil {
namespace {

/// A used impact or unpaired passage.
struct Arrival {
  std::uint32_t series = 0;
  std::size_t size_class = 0;
  double velocity = 0.0;
  double diameter = 0.0;
  double restitution = -1.0;  ///< negative: unpaired
  bool came_back = false;
};

std::vector<Arrival> arrivals_of(const std::vector<Passage>& passages, const PairingResult& pairs) {
  std::vector<Arrival> arrivals;
  for (const Impact& impact : pairs.impacts) {
    if (!impact.used) continue;
    arrivals.push_back({passages[impact.down].series, 0, impact.incident, impact.diameter,
                        impact.restitution, false});
  }
  for (const Unpaired& lone : pairs.unpaired) {
    if (!lone.used) continue;
    const Passage& passage = passages[lone.down];
    arrivals.push_back({passage.series, 0, lone.incident, passage.diameter, -1.0, lone.came_back});
  }
  return arrivals;
}

/// Edges of the size classes: the stated ones, or quantiles that include all spheres.
std::vector<double> class_edges(const std::vector<Arrival>& arrivals,
                                const AverageOptions& options) {
  if (!options.size_edges.empty()) return options.size_edges;
  if (arrivals.empty()) return {0.0, 1.0};
  std::vector<double> sizes;
  for (const Arrival& arrival : arrivals) sizes.push_back(arrival.diameter);
  std::ranges::sort(sizes);
  std::vector<double> edges = {sizes.front()};
  for (std::size_t k = 1; k < options.size_classes; ++k) {
    const double edge = sizes[k * sizes.size() / options.size_classes];
    if (edge > edges.back()) edges.push_back(edge);
  }
  edges.push_back(sizes.back());
  return edges;
}

/// Fewer impacts at one velocity are no bin, and each is a point.
std::size_t least_in_bin(std::size_t per_bin) { return std::min<std::size_t>(5, per_bin); }

/// The first indices of the bins of sorted velocities, and the number of velocities at the end.
/// @param error relative standard deviation of one velocity
std::vector<std::size_t> cuts(std::span<const Arrival> sorted, std::size_t per_bin, double error) {
  constexpr double widest_gap = 4.0;     // errors
  constexpr double emptiness = 2.0;      // spans of the nearest velocities on both sides
  constexpr double narrowest_bin = 6.0;  // errors
  const auto span_of = [&](std::size_t from, std::size_t to) {
    return std::log(sorted[to].velocity / sorted[from].velocity);
  };
  const std::size_t near = least_in_bin(per_bin);
  std::vector<std::size_t> parts = {0};
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const double gap = span_of(i - 1, i);
    const double around =
        span_of(i - std::min(i, near), i - 1) + span_of(i, std::min(i + near, sorted.size()) - 1);
    const bool wide = gap > widest_gap * error && gap > emptiness * around;
    if (wide && i - parts.back() >= 3) parts.push_back(i);
  }
  parts.push_back(sorted.size());
  std::vector<std::size_t> begins;
  for (std::size_t part = 0; part + 1 < parts.size(); ++part) {
    const std::size_t first = parts[part];
    const std::size_t n = parts[part + 1] - first;
    // The central 90 %. For a single velocity with normal errors its width is 3.3 errors.
    const double width = std::log(sorted[first + (19 * (n - 1)) / 20].velocity /
                                  sorted[first + (n - 1) / 20].velocity);
    const std::size_t by_number = std::max<std::size_t>((n + per_bin / 2) / per_bin, 1);
    const double by_width = error > 0.0 ? width / (narrowest_bin * error) : 1e9;
    const std::size_t bins =
        std::clamp<std::size_t>(static_cast<std::size_t>(std::min(by_width, 1e9)), 1, by_number);
    for (std::size_t k = 0; k < bins; ++k) begins.push_back(first + k * n / bins);
  }
  begins.push_back(sorted.size());
  return begins;
}

struct Moments {
  double mean = 0.0;
  double sd = 0.0;
};

/// Mean and standard deviation of the values that are known (not negative).
Moments moments_of(std::span<const Arrival> arrivals, double Arrival::*value) {
  std::vector<double> known;
  for (const Arrival& arrival : arrivals) {
    if (arrival.*value >= 0.0) known.push_back(arrival.*value);
  }
  const Moments result = {mean(known), standard_deviation(known)};
  return result.sd < 1e-9 * result.mean ? Moments{result.mean, 0.0} : result;  // rounding only
}

/// Divides the unpaired passages of a bin among lost, too slow and captured.
/// @param largest_p an excess of unpaired passages is captured if its probability is below this
void sort_unpaired(PointMean& point, double lost_share, double height, double largest_p) {
  const auto unpaired = static_cast<double>(point.unpaired);
  const auto rebounds = static_cast<double>(point.rebounds);
  const double expected = rebounds * lost_share / (1.0 - lost_share);
  if (point.rebounds >= 5 && point.scatter > 0.0) {
    const double slowest = flight::slowest_return(height) / point.velocity;
    const double distance = (point.restitution - slowest) / point.scatter;
    point.slow_known = distance >= 1.0;
    if (point.slow_known) {
      const double hidden = 0.5 * std::erfc(distance / std::numbers::sqrt2);
      point.too_slow = rebounds * hidden / (1.0 - hidden);
    }
  }
  const double certain = std::max(expected, static_cast<double>(point.came_back));
  const double explained = certain + point.too_slow;
  point.lost = std::min(certain, unpaired);
  point.too_slow = std::min(point.too_slow, unpaired - point.lost);
  if (poisson_at_least(point.unpaired, explained) >= largest_p) return;
  // If few rebounds could reach the plane, the absence of rebounds does not indicate capture.
  constexpr double most_hidden = 0.5;
  if (point.rebounds < 5 && flight::slowest_return(height) > most_hidden * point.velocity) return;
  const double rest = std::round(unpaired - explained);
  point.captured = rest > 0.0 ? static_cast<std::size_t>(rest) : 0;
}

PointMean mean_of(std::span<const Arrival> bin) {
  PointMean point;
  for (const Arrival& arrival : bin) {
    ++(arrival.restitution < 0.0 ? point.unpaired : point.rebounds);
    point.came_back += arrival.came_back ? 1 : 0;
  }
  const Moments velocity = moments_of(bin, &Arrival::velocity);
  const Moments restitution = moments_of(bin, &Arrival::restitution);
  point.velocity = velocity.mean;
  point.velocity_sd = velocity.sd / std::sqrt(static_cast<double>(bin.size()));
  point.diameter = moments_of(bin, &Arrival::diameter).mean;
  point.restitution = restitution.mean;
  point.scatter = restitution.sd;
  if (point.rebounds > 1) {
    point.restitution_sd = restitution.sd / std::sqrt(static_cast<double>(point.rebounds));
  }
  return point;
}

/// Computes the share of unpaired among the fastest quarter of each series. The lost share cannot
/// be larger unless the instrument misses fewer of the slow rebounds.
void count_fastest(std::vector<Arrival> arrivals, Averages& result) {
  std::ranges::sort(arrivals, [](const Arrival& a, const Arrival& b) {
    return std::tie(a.series, a.velocity) < std::tie(b.series, b.velocity);
  });
  std::size_t unpaired = 0;
  for (auto begin = arrivals.begin(); begin != arrivals.end();) {
    const auto end = std::find_if(
        begin, arrivals.end(), [&](const Arrival& other) { return other.series != begin->series; });
    for (begin += (end - begin) * 3 / 4; begin != end; ++begin) {
      ++result.fast_impacts;
      unpaired += begin->restitution < 0.0 ? 1 : 0;
    }
  }
  if (result.fast_impacts > 0) {
    result.fast_unpaired = static_cast<double>(unpaired) / static_cast<double>(result.fast_impacts);
  }
}

std::string series_name(const std::string& series, const std::vector<double>& edges,
                        std::size_t size_class) {
  if (edges.size() <= 2) return series;
  return fmt::format("{} {:.4g}-{:.4g} um", series, edges[size_class] / units::um,
                     edges[size_class + 1] / units::um);
}

}  // namespace

Averages average(const std::vector<Passage>& passages, const std::vector<std::string>& series,
                 const PairingResult& pairs, const AverageOptions& options) {
  Averages result;
  std::vector<Arrival> arrivals = arrivals_of(passages, pairs);
  count_fastest(arrivals, result);
  result.lost_share = std::min(pairs.options.lost_share.value_or(pairs.missed_share), 0.9);
  result.narrowest = 6.0 * pairs.velocity_spread;
  const std::vector<double> edges = class_edges(arrivals, options);
  const std::size_t all = arrivals.size();
  std::erase_if(arrivals, [&](const Arrival& a) {
    return a.diameter < edges.front() || a.diameter > edges.back();
  });
  result.outside_sizes = all - arrivals.size();
  for (Arrival& arrival : arrivals) {
    const auto above = std::ranges::upper_bound(edges, arrival.diameter);
    arrival.size_class =
        std::min(static_cast<std::size_t>(above - edges.begin()), edges.size() - 1) - 1;
  }
  std::ranges::stable_sort(arrivals, [](const Arrival& a, const Arrival& b) {
    return std::tie(a.series, a.size_class, a.velocity) <
           std::tie(b.series, b.size_class, b.velocity);
  });
  for (auto begin = arrivals.begin(); begin != arrivals.end();) {
    const auto end = std::find_if(begin, arrivals.end(), [&](const Arrival& other) {
      return other.series != begin->series || other.size_class != begin->size_class;
    });
    const std::span<const Arrival> group(&*begin, static_cast<std::size_t>(end - begin));
    begin = end;
    const double all_sizes = moments_of(group, &Arrival::diameter).mean;
    const std::vector<std::size_t> begins = cuts(group, options.per_bin, pairs.velocity_spread);
    for (std::size_t k = 0; k + 1 < begins.size(); ++k) {
      const std::span<const Arrival> bin = group.subspan(begins[k], begins[k + 1] - begins[k]);
      const auto add = [&](PointMean point) {
        if (options.mean_diameter) point.diameter = all_sizes;
        point.series = series_name(series[group.front().series], edges, group.front().size_class);
        result.points.push_back(std::move(point));
      };
      if (bin.size() >= least_in_bin(options.per_bin)) {
        add(mean_of(bin));
        continue;
      }
      for (std::size_t i = 0; i < bin.size(); ++i) {
        const bool rebound = bin[i].restitution >= 0.0;
        if (rebound) add(mean_of(bin.subspan(i, 1)));
        ++(rebound ? result.single : result.unpaired);
        result.came_back += bin[i].came_back ? 1 : 0;
      }
    }
  }
  for (PointMean& point : result.points) {
    sort_unpaired(point, result.lost_share, pairs.height,
                  0.01 / static_cast<double>(result.points.size()));
    result.unpaired += point.unpaired;
    result.came_back += point.came_back;
    result.lost += point.lost;
    result.too_slow += point.too_slow;
    result.captured += point.captured;
  }
  std::erase_if(result.points, [](const PointMean& point) { return point.events() == 0; });
  result.unresolved = std::max(
      0.0, static_cast<double>(result.unpaired - result.captured) - result.lost - result.too_slow);
  return result;
}

PairedPassages pair_and_average(PassageTable table, const PairRequest& request) {
  PairedPassages paired;
  paired.table = std::move(table);
  paired.pairs = pair_passages(paired.table.passages, request.pairing);
  paired.averages =
      average(paired.table.passages, paired.table.series, paired.pairs, request.averaging);
  return paired;
}

void require_impacts(const PairedPassages& paired, const PairRequest& request, const char* dashes) {
  if (!paired.pairs.impacts.empty()) return;
  throw ComputationError(fmt::format(
      "{0}: no impacts found (no passage up follows a passage down within the time that a plane "
      "{1:g} mm above the surface allows); check {2}height, the units and {2}positive",
      request.file, request.pairing.height / units::mm, dashes));
}

}  // namespace recoil
