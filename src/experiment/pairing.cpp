#include "experiment/pairing.hpp"

#include <algorithm>
#include <cmath>

#include "experiment/flight.hpp"
#include "experiment/pair_search.hpp"
#include "experiment/returns.hpp"

namespace recoil {
namespace {

constexpr std::uint32_t nobody = UINT32_MAX;

struct Pairs {
  std::vector<Link> links;
  double exchanged = 0.0;  ///< expected to be wrong by exchange
};

Pairs pairs_of(const std::vector<Passage>& passages, const std::vector<Link>& candidates,
               const PairingModel& model) {
  const std::vector<Link> links = agreeing(candidates, passages, model);
  const std::vector<std::size_t> chosen = choose_links(links, passages.size(), worst_link);
  Pairs pairs;
  for (const std::size_t i : chosen) pairs.links.push_back(links[i]);
  pairs.exchanged = expected_exchanged(links, chosen, passages.size());
  return pairs;
}

/// Every `stride`-th passage down again at a time when it does not belong, among the real ones:
/// whatever partner it finds it has found by chance, against the competition of the real ones.
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
  std::vector<Passage> foreign;
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
  std::stable_sort(mixed.begin(), mixed.end(), [](const Marked& a, const Marked& b) {
    return a.passage.series < b.passage.series ||
           (a.passage.series == b.passage.series && a.passage.time < b.passage.time);
  });
  std::vector<Passage> stream;
  stream.reserve(mixed.size());
  for (const Marked& marked : mixed) stream.push_back(marked.passage);
  for (const Link& link : pairs_of(stream, pair_candidates(stream, options), model).links) {
    if (mixed[link.from].decoy) ++count.paired;
  }
  return count;
}

/// The number of every passage down: 1 from the dispenser, else one more than what it follows.
class Chains {
 public:
  explicit Chains(std::size_t passages) : previous_(passages, nobody), number_(passages, 0) {}

  void follow(std::uint32_t later, std::uint32_t earlier) { previous_[later] = earlier; }

  /// @param earlier_of an orphan rebound is at least of a first impact.
  int number(std::uint32_t down) {
    std::vector<std::uint32_t> chain;
    std::uint32_t at = down;
    while (number_[at] == 0 && previous_[at] != nobody) {
      chain.push_back(at);
      at = previous_[at];
    }
    if (number_[at] == 0) number_[at] = 1;
    int value = number_[at];
    for (auto it = chain.rbegin(); it != chain.rend(); ++it) number_[*it] = ++value;
    return number_[down];
  }

 private:
  std::vector<std::uint32_t> previous_;
  std::vector<int> number_;
};

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

}  // namespace

double PairingResult::purity() const {
  if (impacts.empty()) return 1.0;
  return std::max(0.0, 1.0 - expected_false / static_cast<double>(impacts.size()));
}

PairingResult pair_passages(const std::vector<Passage>& passages, const PairingOptions& given) {
  PairingResult result;
  result.options = given;
  for (const Passage& passage : passages) ++(passage.velocity > 0.0 ? result.down : result.up);

  PairingOptions options = given;
  std::vector<Link> candidates = pair_candidates(passages, options);
  Refined refined = refine_height(candidates, passages, options);
  const double reach =
      std::abs(refined.model.log_height) + widest_agreement * refined.model.height_sd.largest();
  if (refined.refined && reach > std::log(options.height_range)) {
    // The height lies near an end of the range, which cuts pairs off: search again about it.
    options.height *= std::exp(refined.model.log_height);
    candidates = pair_candidates(passages, options);
    refined = refine_height(candidates, passages, options);
  }
  result.candidates = static_cast<double>(candidates.size()) /
                      static_cast<double>(std::max<std::size_t>(result.down, 1));
  const PairingModel& model = refined.model;
  result.height = options.height * std::exp(model.log_height);
  result.height_sd = result.height * refined.log_height_sd;
  result.refined = refined.refined;
  result.height_spread = refined.height_spread;
  result.diameter_spread = refined.diameter_spread;

  const Pairs found = pairs_of(passages, candidates, model);
  const std::vector<Link>& pairs = found.links;
  std::vector<std::uint32_t> down_of(passages.size(), nobody);  // passage up -> its passage down
  std::vector<bool> open_down(passages.size(), false);
  std::vector<bool> open_next(passages.size(), false);
  for (std::size_t i = 0; i < passages.size(); ++i) {
    open_down[i] = open_next[i] = passages[i].velocity > 0.0;
  }
  for (const Link& pair : pairs) {
    down_of[pair.to] = pair.from;
    open_down[pair.from] = false;
  }
  result.orphans = result.up - pairs.size();
  result.missed_share =
      result.up > 0 ? static_cast<double>(result.orphans) / static_cast<double>(result.up) : 0.0;

  // An orphan rebound stands for its own passage down, which went unseen.
  Chains chains(passages.size());
  const Followers returns = find_returns(passages, options, model);
  result.returns = returns.links.size();
  result.expected_returns = returns.by_chance;
  result.returns_usable = returns.usable || returns.links.empty();
  // Few returns say less than the flight times, which scatter by at least 1 / sqrt(2) of it.
  result.velocity_spread = velocity_scatter(returns, options);
  if (result.height_spread > 0.0) {
    result.velocity_spread =
        std::min(result.velocity_spread, std::sqrt(2.0) * result.height_spread);
  }
  std::vector<bool> came_back(passages.size(), false);
  if (returns.usable) {
    for (const Link& link : returns.links) {
      const std::uint32_t earlier = down_of[link.from];
      chains.follow(link.to, earlier != nobody ? earlier : link.from);
      open_next[link.to] = false;
    }
    const Followers unseen =
        find_unseen(passages, options, model, open_down, open_next, result.velocity_spread);
    for (const Link& link : unseen.usable ? unseen.links : std::vector<Link>{}) {
      chains.follow(link.to, link.from);
      came_back[link.from] = true;
    }
  }

  const double threshold = options.threshold.value_or(0.0);
  for (const Link& pair : pairs) {
    Impact impact = impact_of(passages, pair, result.height);
    impact.number = chains.number(pair.from);
    impact.used = (options.keep_later || impact.number == 1) &&
                  passages[pair.from].velocity >= threshold &&
                  impact.angle <= options.angle.value_or(M_PI);
    result.impacts.push_back(impact);
  }
  for (std::size_t i = 0; i < passages.size(); ++i) {
    if (!open_down[i]) continue;
    Unpaired lone;
    lone.down = static_cast<std::uint32_t>(i);
    lone.incident = flight::surface_velocity(passages[i].velocity, result.height);
    lone.number = chains.number(lone.down);
    lone.came_back = came_back[i];
    lone.used = (options.keep_later || lone.number == 1) && passages[i].velocity >= threshold;
    result.unpaired.push_back(lone);
  }

  const DecoyCount decoys = try_decoys(passages, options, model, result.down);
  result.decoys = decoys.tried;
  if (decoys.tried > 0) {
    result.decoy_share = static_cast<double>(decoys.paired) / static_cast<double>(decoys.tried);
    // n passages without a true partner leave n (1 - q) unpaired.
    const double chance = result.decoy_share / std::max(1.0 - result.decoy_share, 1e-3) *
                          static_cast<double>(result.unpaired.size());
    result.expected_false = std::min(chance + found.exchanged, static_cast<double>(pairs.size()));
  }
  return result;
}

}  // namespace recoil
