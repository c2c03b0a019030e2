#include "experiment/pairing.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "experiment/flight.hpp"
#include "experiment/pair_search.hpp"

namespace recoil {
namespace {

constexpr std::uint32_t unassigned = UINT32_MAX;

Matching match_pairs(const std::vector<Passage>& passages, const std::vector<Link>& candidates,
                     const PairingModel& model) {
  return match(agreeing(candidates, passages, model), passages.size(), worst_link);
}

/// Counts how often a passage down gets a partner by chance. Every n-th one is added to the stream
/// again, shifted by 1.7 s, as a decoy that competes with the true passages.
struct DecoyCount {
  std::size_t tried = 0;
  std::size_t paired = 0;
};

DecoyCount try_decoys(const std::vector<Passage>& passages, const PairingOptions& options,
                      const PairingModel& model, std::size_t down) {
  constexpr std::size_t wanted = 20000;
  constexpr double shift = 1.7;  ///< longer than a flight above the plane after 4.6 m/s [s]
  if (passages.empty() || down == 0) return {};
  const std::size_t stride = std::max<std::size_t>(10, down / wanted + 1);
  struct Marked {
    Passage passage;
    bool decoy;
  };
  std::vector<Marked> mixed;
  std::size_t series_begin = 0;
  DecoyCount count;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < passages.size(); ++i) {
    if (passages[i].series != passages[series_begin].series) series_begin = i;
    mixed.push_back({passages[i], false});
    if (passages[i].velocity <= 0.0 || ++seen % stride != 0) continue;
    Passage decoy = passages[i];
    const double since = decoy.time - passages[series_begin].time;
    decoy.time += since >= shift ? -shift : shift;
    mixed.push_back({decoy, true});
    ++count.tried;
  }
  std::ranges::stable_sort(mixed, [](const Marked& a, const Marked& b) {
    return std::tie(a.passage.series, a.passage.time) < std::tie(b.passage.series, b.passage.time);
  });
  std::vector<Passage> stream;
  stream.reserve(mixed.size());
  for (const Marked& marked : mixed) stream.push_back(marked.passage);
  for (const Link& link : match_pairs(stream, pair_candidates(stream, options), model).links) {
    if (mixed[link.from].decoy) ++count.paired;
  }
  return count;
}

Impact impact_of(const std::vector<Passage>& passages, const Link& pair, double height) {
  const Passage& down = passages[pair.from];
  const Passage& up = passages[pair.to];
  Impact impact;
  impact.down = pair.from;
  impact.up = pair.to;
  impact.incident = flight::surface_velocity(down.velocity, height);
  impact.rebound = flight::surface_velocity(-up.velocity, height);
  impact.restitution = impact.rebound / impact.incident;
  impact.diameter = 0.5 * (down.diameter + up.diameter);
  impact.angle = std::atan2(std::abs(up.tangential), impact.rebound);
  return impact;
}

/// The candidates, the model refined with them, and the options with the height of the search.
struct Search {
  PairingOptions options;
  std::vector<Link> candidates;
  Refined refined;
};

Search search_pairs(const std::vector<Passage>& passages, const PairingOptions& options) {
  Search search{options, pair_candidates(passages, options), {}};
  search.refined = refine_height(search.candidates, passages, options);
  const PairingModel& model = search.refined.model;
  const double reach = std::abs(model.log_height) + widest_agreement * model.height_sd.largest();
  if (search.refined.refined && reach > std::log(options.height_range)) {
    // The height is near an end of the range, which excludes pairs: search again around it.
    search.options.height = model.height();
    search.candidates = pair_candidates(passages, search.options);
    search.refined = refine_height(search.candidates, passages, search.options);
  }
  return search;
}

/// The passages of the same sphere before and after each passage down.
struct Later {
  std::vector<std::uint32_t> previous;  ///< `unassigned`: it comes from the dispenser
  std::vector<bool> came_back;          ///< it is unpaired, but rebounded undetected

  /// The number of the impact of every passage down: one more than that of the previous passage,
  /// which has a lower index.
  std::vector<int> numbers() const {
    std::vector<int> number(previous.size(), 1);
    for (std::size_t i = 0; i < number.size(); ++i) {
      if (previous[i] != unassigned) number[i] = number[previous[i]] + 1;
    }
    return number;
  }
};

/// @param pairs the links between passages down and passages up
Later find_later_impacts(const std::vector<Passage>& passages, const Search& search,
                         const std::vector<Link>& pairs, PairingResult& result) {
  Later later{std::vector<std::uint32_t>(passages.size(), unassigned),
              std::vector<bool>(passages.size(), false)};
  std::vector<std::uint32_t> down_of = later.previous;  // passage up -> its passage down
  std::vector<bool> open_down;
  for (const Passage& passage : passages) open_down.push_back(passage.velocity > 0.0);
  std::vector<bool> open_next = open_down;
  for (const Link& pair : pairs) {
    down_of[pair.to] = pair.from;
    open_down[pair.from] = false;
  }
  const PairingModel& model = search.refined.model;
  const Followers returns = find_returns(passages, search.options, model);
  result.returns = returns.links.size();
  result.expected_returns = returns.by_chance;
  result.returns_usable = returns.usable || returns.links.empty();
  // The scatter of flight times is at least 1 / sqrt(2) of it, and is better known than few
  // returns.
  result.velocity_spread = velocity_scatter(returns, search.options);
  if (result.height_spread > 0.0) {
    result.velocity_spread =
        std::min(result.velocity_spread, std::sqrt(2.0) * result.height_spread);
  }
  if (!returns.usable) return later;
  for (const Link& link : returns.links) {
    // A rebound without its passage down stands for that passage, which was not detected.
    const std::uint32_t earlier = down_of[link.from];
    later.previous[link.to] = earlier != unassigned ? earlier : link.from;
    open_next[link.to] = false;
  }
  const Followers unseen =
      find_unseen(passages, model, open_down, open_next, result.velocity_spread);
  for (const Link& link : unseen.usable ? unseen.links : std::vector<Link>{}) {
    later.previous[link.to] = link.from;
    later.came_back[link.from] = true;
  }
  return later;
}

void list_impacts(const std::vector<Passage>& passages, const std::vector<Link>& pairs,
                  const Later& later, PairingResult& result) {
  const PairingOptions& options = result.options;
  const std::vector<int> numbers = later.numbers();
  const auto used = [&](std::uint32_t down, int number) {
    return (options.keep_later || number == 1) &&
           passages[down].velocity >= options.threshold.value_or(0.0);
  };
  std::vector<bool> paired(passages.size(), false);
  for (const Link& pair : pairs) {
    paired[pair.from] = true;
    Impact impact = impact_of(passages, pair, result.height);
    impact.number = numbers[pair.from];
    impact.used = used(pair.from, impact.number) && impact.angle <= options.angle.value_or(M_PI);
    result.impacts.push_back(impact);
  }
  for (std::uint32_t i = 0; i < passages.size(); ++i) {
    if (passages[i].velocity <= 0.0 || paired[i]) continue;
    Unpaired lone;
    lone.down = i;
    lone.incident = flight::surface_velocity(passages[i].velocity, result.height);
    lone.number = numbers[i];
    lone.came_back = later.came_back[i];
    lone.used = used(i, lone.number);
    result.unpaired.push_back(lone);
  }
}

}  // namespace

double PairingResult::purity() const {
  if (impacts.empty()) return 1.0;
  return std::max(0.0, 1.0 - expected_false / static_cast<double>(impacts.size()));
}

PairingResult pair_passages(const std::vector<Passage>& passages, const PairingOptions& options) {
  PairingResult result;
  result.options = options;
  for (const Passage& passage : passages) ++(passage.velocity > 0.0 ? result.down : result.up);

  const Search search = search_pairs(passages, options);
  const PairingModel& model = search.refined.model;
  result.candidates = static_cast<double>(search.candidates.size()) /
                      static_cast<double>(std::max<std::size_t>(result.down, 1));
  result.height = model.height();
  result.height_sd = result.height * search.refined.log_height_sd;
  result.refined = search.refined.refined;
  result.height_spread = search.refined.height_spread;
  result.diameter_spread = search.refined.diameter_spread;

  const Matching pairs = match_pairs(passages, search.candidates, model);
  result.orphans = result.up - pairs.links.size();
  result.missed_share =
      result.up > 0 ? static_cast<double>(result.orphans) / static_cast<double>(result.up) : 0.0;
  const Later later = find_later_impacts(passages, search, pairs.links, result);
  list_impacts(passages, pairs.links, later, result);

  const DecoyCount decoys = try_decoys(passages, search.options, model, result.down);
  result.decoys = decoys.tried;
  if (decoys.tried > 0) {
    result.decoy_share = static_cast<double>(decoys.paired) / static_cast<double>(decoys.tried);
    // Of n passages without a true partner, n (1 - q) stay unpaired.
    const double chance = result.decoy_share / std::max(1.0 - result.decoy_share, 1e-3) *
                          static_cast<double>(result.unpaired.size());
    result.expected_false =
        std::min(chance + pairs.exchanged, static_cast<double>(pairs.links.size()));
  }
  return result;
}

}  // namespace recoil
