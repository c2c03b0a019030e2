#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>

#include "core/statistics.hpp"
#include "experiment/flight.hpp"
#include "experiment/pair_search.hpp"

namespace recoil {
namespace {

using std::numbers::sqrt2;

constexpr std::size_t most_visits = 400'000'000;  ///< a few seconds; a larger search is given up

double squared(double x) { return x * x; }

/// Cost of the deviation in size; nullopt if the sizes disagree.
std::optional<double> size_cost(const Passage& a, const Passage& b, const PairingModel& model) {
  const double deviation =
      std::log(b.diameter / a.diameter) / model.diameter_sd.at(std::log(a.diameter));
  if (std::abs(deviation) > widest_agreement) return std::nullopt;
  return squared(deviation);
}

/// Relative scatter of the velocity of a passage with `speed`, due to the measurement and to the
/// scatter dh of its height in the probe volume, g dh / v^2.
double local_scatter(double velocity_sd, double speed, double height, const PairingModel& model) {
  const double place = height * model.height_sd.at(std::log(speed));
  return std::hypot(velocity_sd, std::min(standard_gravity * place / (speed * speed), 0.2));
}

/// Finds returns with the time above the plane multiplied by `scale`; nullopt if it takes too long.
std::optional<std::vector<Link>> returns_at(const std::vector<Passage>& passages,
                                            const PairingOptions& options,
                                            const PairingModel& model, double velocity_sd,
                                            double scale, std::size_t stride = 1) {
  const double height = model.height();
  std::vector<Link> links;
  std::size_t visits = 0;
  for (std::size_t j = 0; j < passages.size(); ++j) {
    const Passage& up = passages[j];
    if (up.velocity >= 0.0 || j % stride != 0) continue;
    const double speed = -up.velocity;
    const double sd = local_scatter(velocity_sd, speed, height, model);
    const double widest = std::min(std::max(options.velocity_tolerance, widest_agreement * sd),
                                   std::min(widest_agreement * sqrt2 * sd, 0.6));
    const double middle = scale * flight::time_above(speed);
    const auto first = std::lower_bound(
        passages.begin() + static_cast<std::ptrdiff_t>(j + 1), passages.end(),
        up.time + middle * (1.0 - widest), [&up](const Passage& later, double time) {
          return std::tie(later.series, later.time) < std::tie(up.series, time);
        });
    for (auto k = static_cast<std::size_t>(first - passages.begin());
         k < passages.size() && passages[k].series == up.series; ++k) {
      const Passage& down = passages[k];
      if (++visits > most_visits) return std::nullopt;
      if (down.time > up.time + middle * (1.0 + widest)) break;
      if (down.velocity <= 0.0) continue;
      const double ratio = std::log(down.velocity / speed);
      if (std::abs(ratio) > widest) continue;
      const double lateness = std::log((down.time - up.time) /
                                       (scale * flight::time_above(0.5 * (speed + down.velocity))));
      const auto size = size_cost(up, down, model);
      const double cost =
          squared(ratio / (sqrt2 * sd)) + squared(lateness * sqrt2 / sd) + size.value_or(0.0);
      if (!size || cost > worst_link + 3.0) continue;  // three deviations instead of two
      links.push_back(
          {static_cast<std::uint32_t>(j), static_cast<std::uint32_t>(k), cost, lateness, ratio});
    }
  }
  return match(links, passages.size(), worst_link).links;
}

std::vector<double> sorted_costs(const std::vector<Link>& links) {
  std::vector<double> costs;
  for (const Link& link : links) costs.push_back(link.cost);
  std::ranges::sort(costs);
  return costs;
}

double count_below(const std::vector<double>& sorted, double cost) {
  return static_cast<double>(std::ranges::upper_bound(sorted, cost) - sorted.begin());
}

/// Runs `search(scale)` for the right time and for two wrong times, which give links by chance
/// only. Keeps the links up to the cost with the largest gain.
template <class Search>
Followers judged(const Search& search) {
  Followers result;
  const auto links = search(1.0);
  const auto early = links ? search(0.8) : std::nullopt;
  const auto late = early ? search(1.25) : std::nullopt;
  if (!late) return result;
  const std::vector<double> right = sorted_costs(*links);
  const std::vector<double> before = sorted_costs(*early);
  const std::vector<double> after = sorted_costs(*late);
  const auto by_chance = [&](double cost) {
    return 0.5 * (count_below(before, cost) + count_below(after, cost));
  };
  double limit = -1.0;
  for (double cost = 0.5; cost < worst_link + 4.0; cost += 0.5) {
    const double gain = count_below(right, cost) - 2.0 * by_chance(cost);
    if (gain <= result.gain) continue;
    result.gain = gain;
    limit = cost;
  }
  for (const Link& link : *links) {
    if (link.cost <= limit) result.links.push_back(link);
  }
  result.by_chance = by_chance(limit);
  result.usable = limit > 0.0;
  return result;
}

double widest_scatter(const PairingOptions& options) {
  return options.velocity_tolerance / (widest_agreement / sqrt2);
}

}  // namespace

double velocity_scatter(const Followers& returns, const PairingOptions& options) {
  constexpr std::size_t fewest_to_narrow = 20;
  const double widest = widest_scatter(options);
  if (returns.links.size() < fewest_to_narrow) return widest;
  std::vector<double> ratios;
  std::vector<double> lateness;
  for (const Link& link : returns.links) {
    lateness.push_back(link.first);
    ratios.push_back(link.second);
  }
  // The scatter of the ratio of two speeds is sqrt(2) times that of one, of their mean 1 / sqrt(2).
  const double sd = std::max(robust_sd(ratios) / sqrt2, robust_sd(lateness) * sqrt2);
  return std::clamp(sd, 1e-3, widest);
}

Followers find_returns(const std::vector<Passage>& passages, const PairingOptions& options,
                       const PairingModel& model) {
  // The scatter of the velocities is that with the largest gain for a part of the stream.
  constexpr std::size_t enough = 20000;
  const std::size_t stride = passages.size() / enough + 1;
  double sd = widest_scatter(options);
  double most = 0.0;
  for (double trial = sd; trial > 2e-3; trial /= 1.35) {
    const double gain = judged([&](double scale) {
                          return returns_at(passages, options, model, trial, scale, stride);
                        }).gain;
    if (gain <= most) continue;
    most = gain;
    sd = trial;
  }
  return judged([&](double scale) { return returns_at(passages, options, model, sd, scale); });
}

Followers find_unseen(const std::vector<Passage>& passages, const PairingModel& model,
                      const std::vector<bool>& open_down, const std::vector<bool>& open_next,
                      double velocity_sd) {
  const double height = model.height();
  const auto search = [&](double scale) -> std::optional<std::vector<Link>> {
    std::vector<Link> links;
    std::size_t visits = 0;
    for (std::size_t i = 0; i < passages.size(); ++i) {
      if (!open_down[i]) continue;
      const Passage& down = passages[i];
      const double latest = down.time + flight::longest_round_trip(down.velocity, height) +
                            1.3 * scale * flight::time_above(down.velocity);
      for (std::size_t k = i + 1; k < passages.size(); ++k) {
        const Passage& next = passages[k];
        if (next.series != down.series || next.time > latest) break;
        if (++visits > most_visits) return std::nullopt;
        if (!open_next[k] || next.velocity > down.velocity) continue;
        const double below = flight::round_trip(down.velocity, next.velocity, height);
        const double above = next.time - down.time - below;
        if (!(above > 0.0)) continue;
        const double lateness = std::log(above / (scale * flight::time_above(next.velocity)));
        const double sd = local_scatter(velocity_sd, next.velocity, height, model);
        if (std::abs(lateness) > widest_agreement * sd) continue;
        const auto size = size_cost(down, next, model);
        const double cost = squared(lateness / sd) + size.value_or(0.0);
        if (!size || cost > worst_link) continue;
        links.push_back(
            {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k), cost, lateness, 0.0});
      }
    }
    return match(links, passages.size(), worst_link).links;
  };
  return judged(search);
}

}  // namespace recoil
