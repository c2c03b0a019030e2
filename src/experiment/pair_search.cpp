#include "experiment/pair_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/statistics.hpp"
#include "experiment/flight.hpp"

namespace recoil {
namespace {

constexpr std::size_t none = SIZE_MAX;

/// Matches greedily, and then improves the matching along augmenting paths of three links: from a
/// free `from` to a `to` that another `from` uses, and from that one to a free `to`.
class Chooser {
 public:
  Chooser(const std::vector<Link>& links, std::size_t passages)
      : links_(links), by_from_(passages, none), by_to_(passages, none), start_(passages + 1, 0) {
    for (const Link& link : links) ++start_[link.from + 1];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    list_.resize(links.size());
    std::vector<std::size_t> next = start_;
    for (std::size_t i = 0; i < links.size(); ++i) list_[next[links[i].from]++] = i;
  }

  void take_by_cost() {
    std::vector<std::size_t> order(links_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
      return std::tie(links_[a].cost, a) < std::tie(links_[b].cost, b);
    });
    for (const std::size_t i : order) {
      if (by_from_[links_[i].from] == none && by_to_[links_[i].to] == none) take(i);
    }
  }

  void exchange(double price) {
    for (std::size_t passage = 0; passage + 1 < start_.size(); ++passage) {
      if (by_from_[passage] == none) lengthen(passage, price);
    }
  }

  std::vector<Link> chosen() const {
    std::vector<Link> result;
    for (const std::size_t i : by_from_) {
      if (i != none) result.push_back(links_[i]);
    }
    return result;
  }

  double exchanged() const {
    double expected = 0.0;
    for (const std::size_t mine : by_from_) {
      if (mine == none) continue;
      const std::uint32_t from = links_[mine].from;
      for (std::size_t a = start_[from]; a < start_[from + 1]; ++a) {
        const Link& cross = links_[list_[a]];
        const std::size_t theirs = by_to_[cross.to];
        if (theirs == none || links_[theirs].from <= from) continue;  // each pair once
        const std::uint32_t holder = links_[theirs].from;
        for (std::size_t b = start_[holder]; b < start_[holder + 1]; ++b) {
          const Link& back = links_[list_[b]];
          if (back.to != links_[mine].to) continue;
          const double more = cross.cost + back.cost - links_[mine].cost - links_[theirs].cost;
          expected += 2.0 / (1.0 + std::exp(0.5 * more));
        }
      }
    }
    return expected;
  }

 private:
  void take(std::size_t i) {
    by_from_[links_[i].from] = i;
    by_to_[links_[i].to] = i;
  }

  void lengthen(std::size_t passage, double price) {
    double best = price;
    std::size_t entering = none;
    std::size_t moving = none;
    for (std::size_t a = start_[passage]; a < start_[passage + 1]; ++a) {
      const Link& wanted = links_[list_[a]];
      const std::size_t held = by_to_[wanted.to];
      if (held == none) continue;  // the greedy matching would have taken this link
      const std::size_t holder = links_[held].from;
      for (std::size_t b = start_[holder]; b < start_[holder + 1]; ++b) {
        const Link& other = links_[list_[b]];
        if (by_to_[other.to] != none) continue;
        const double more = wanted.cost + other.cost - links_[held].cost;
        if (more >= best) continue;
        best = more;
        entering = list_[a];
        moving = list_[b];
      }
    }
    if (entering == none) return;
    take(moving);
    take(entering);
  }

  const std::vector<Link>& links_;
  std::vector<std::size_t> by_from_;  ///< passage -> link that uses it as `from`
  std::vector<std::size_t> by_to_;
  std::vector<std::size_t> start_;  ///< passage -> its first link in list_
  std::vector<std::size_t> list_;   ///< links by `from`
};

constexpr std::size_t most_candidates = 200;  ///< per passage
constexpr std::size_t fewest_to_refine = 12;  ///< pairs; with fewer the estimate is kept
/// Of one impact [1]. Errors can bring it above 1; a limit near 1 would select by the errors and
/// bias the mean.
constexpr double largest_restitution = 1.5;
constexpr double lowest_sd = 2e-3;          ///< of either deviation [1]
constexpr double highest_height_sd = 0.15;  ///< [1]

/// The centre of the interval of this width that contains the most values.
double densest(std::vector<double> values, double width) {
  std::ranges::sort(values);
  std::size_t most = 0;
  double centre = 0.0;
  std::size_t begin = 0;
  for (std::size_t end = 0; end < values.size(); ++end) {
    while (values[end] - values[begin] > width) ++begin;
    if (end - begin + 1 <= most) continue;
    most = end - begin + 1;
    centre = values[(begin + end) / 2];
  }
  return centre;
}

}  // namespace

Matching match(const std::vector<Link>& links, std::size_t passages, double price) {
  Chooser chooser(links, passages);
  chooser.take_by_cost();
  chooser.exchange(price);
  return {chooser.chosen(), chooser.exchanged()};
}
LocalSpread::LocalSpread(const std::vector<double>& x, const std::vector<double>& deviation,
                         double lowest, double highest) {
  constexpr std::size_t least = 60;
  constexpr std::size_t most_classes = 8;
  const std::size_t classes = std::clamp<std::size_t>(x.size() / least, 1, most_classes);
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return x[i]; });
  for (std::size_t k = 0; k < classes; ++k) {
    const std::size_t begin = k * x.size() / classes;
    const std::size_t end = (k + 1) * x.size() / classes;
    std::vector<double> places;
    std::vector<double> values;
    for (std::size_t i = begin; i < end; ++i) {
      places.push_back(x[order[i]]);
      values.push_back(deviation[order[i]]);
    }
    x_.push_back(median(places));
    sd_.push_back(std::clamp(robust_sd(std::move(values)), lowest, highest));
  }
}

double LocalSpread::at(double x) const {
  if (x <= x_.front()) return sd_.front();
  if (x >= x_.back()) return sd_.back();
  const auto above = std::ranges::upper_bound(x_, x);
  const auto i = static_cast<std::size_t>(above - x_.begin());
  const double share = (x - x_[i - 1]) / (x_[i] - x_[i - 1]);
  return sd_[i - 1] + share * (sd_[i] - sd_[i - 1]);
}

double LocalSpread::largest() const { return *std::ranges::max_element(sd_); }

std::vector<Link> pair_candidates(const std::vector<Passage>& passages,
                                  const PairingOptions& options) {
  const double range = options.refine ? options.height_range : 1.0 + 0.3;
  const double lowest = options.height / range;
  const double highest = options.height * range;
  const double ratio = 1.0 + options.diameter_tolerance;
  std::vector<Link> links;
  for (std::size_t i = 0; i < passages.size(); ++i) {
    end_if_called_off();
    const Passage& down = passages[i];
    if (down.velocity <= 0.0) continue;
    const double latest = down.time + flight::longest_round_trip(down.velocity, highest);
    const double fastest = largest_restitution * flight::surface_velocity(down.velocity, highest);
    for (std::size_t j = i + 1; j < passages.size(); ++j) {
      const Passage& up = passages[j];
      if (up.series != down.series || up.time > latest) break;
      if (up.velocity >= 0.0 || flight::surface_velocity(-up.velocity, highest) > fastest) continue;
      if (up.diameter > ratio * down.diameter || down.diameter > ratio * up.diameter) continue;
      const double height =
          flight::implied_height(down.velocity, -up.velocity, up.time - down.time);
      if (!(height >= lowest && height <= highest)) continue;
      links.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), 0.0,
                       std::log(height / options.height), std::log(up.diameter / down.diameter)});
    }
    if (links.size() > most_candidates * (i + 1000)) {
      throw ComputationError(fmt::format(
          "too many overlapping flights: more than {} rebounds fit every passage down (up to line "
          "{}); narrow --height-range or --diameter-tolerance, or measure at a lower rate",
          most_candidates, down.line));
    }
  }
  return links;
}

std::vector<Link> agreeing(const std::vector<Link>& candidates,
                           const std::vector<Passage>& passages, const PairingModel& model) {
  const double widest = widest_agreement * model.height_sd.largest();
  const double plane = model.height();
  std::vector<Link> kept;
  for (const Link& link : candidates) {
    if (std::abs(link.first - model.log_height) > widest) continue;
    const Passage& down = passages[link.from];
    const Passage& up = passages[link.to];
    if (flight::surface_velocity(-up.velocity, plane) >
        largest_restitution * flight::surface_velocity(down.velocity, plane)) {
      continue;
    }
    const double height =
        (link.first - model.log_height) / model.height_sd.at(std::log(-up.velocity));
    const double size = link.second / model.diameter_sd.at(std::log(down.diameter));
    const double cost = height * height + size * size;
    if (std::max(std::abs(height), std::abs(size)) > widest_agreement || cost > worst_link)
      continue;
    kept.push_back(link);
    kept.back().cost = cost;
  }
  return kept;
}

Refined refine_height(const std::vector<Link>& candidates, const std::vector<Passage>& passages,
                      const PairingOptions& options) {
  Refined result;
  result.model.estimate = options.height;
  result.model.diameter_sd = LocalSpread(std::min(0.05, options.diameter_tolerance / 3.0));
  if (options.refine && candidates.size() >= fewest_to_refine) {
    std::vector<double> heights;
    for (const Link& link : candidates) heights.push_back(link.first);
    result.model.log_height = densest(std::move(heights), 0.1);
  }
  for (int round = 0; round < 4; ++round) {
    const std::vector<Link> links =
        match(agreeing(candidates, passages, result.model), passages.size(), worst_link).links;
    if (links.size() < fewest_to_refine) return result;
    std::vector<double> heights;
    std::vector<double> sizes;
    std::vector<double> log_up;
    std::vector<double> log_diameter;
    for (const Link& link : links) {
      heights.push_back(link.first);
      sizes.push_back(link.second);
      log_up.push_back(std::log(-passages[link.to].velocity));
      log_diameter.push_back(std::log(passages[link.from].diameter));
    }
    result.model.height_sd = LocalSpread(log_up, heights, lowest_sd, highest_height_sd);
    result.model.diameter_sd =
        LocalSpread(log_diameter, sizes, lowest_sd, options.diameter_tolerance);
    result.height_spread = robust_sd(heights);
    result.diameter_spread = robust_sd(sizes);
    if (!options.refine) continue;
    result.model.log_height = median(heights);
    // standard error of the median of normal variables
    result.log_height_sd =
        std::sqrt(M_PI / 2.0) * result.height_spread / std::sqrt(static_cast<double>(links.size()));
    result.refined = true;
  }
  return result;
}

}  // namespace recoil
