#include "experiment/matching.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace recoil {
namespace {

constexpr std::size_t none = SIZE_MAX;

/// Greedy choice, then exchanges along paths of three links: a free `from`, its `to` that another
/// `from` holds, and a free `to` for that one.
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
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return links_[a].cost < links_[b].cost || (links_[a].cost == links_[b].cost && a < b);
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
      if (held == none) continue;  // the greedy choice would have taken it
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

}  // namespace

Matching match(const std::vector<Link>& links, std::size_t passages, double price) {
  Chooser chooser(links, passages);
  chooser.take_by_cost();
  chooser.exchange(price);
  return {chooser.chosen(), chooser.exchanged()};
}

}  // namespace recoil
