#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace recoil {

/// Two passages that may belong to one sphere, and how badly they agree.
struct Link {
  std::uint32_t from = 0;  ///< index of the earlier passage
  std::uint32_t to = 0;    ///< index of the later one
  double cost = 0.0;       ///< sum of squared deviations in standard deviations [1], >= 0
  double first = 0.0;      ///< the first deviation, relative (height, or time above the plane)
  double second = 0.0;     ///< ln of the ratio of the diameters
};

/// Links of which each passage is in at most one as `from` and in at most one as `to`.
struct Matching {
  std::vector<Link> links;  ///< ascending in `from`
  /// How many are expected to be wrong because two links should have exchanged their partners: over
  /// all pairs of links that could, 2 p with p = 1 / (1 + exp(D / 2)) and D the cost of the
  /// exchange (the odds of two sets of normal deviations).
  double exchanged = 0.0;
};

/// Chooses as many links of low cost as possible. The links are taken by ascending cost; where that
/// leaves a passage without a partner although an exchange with a neighbour would pair both, the
/// exchange is made if it costs at most `price` more. O(n log n) for n links.
/// @param passages indices lie below this.
/// @param price the cost at which a link is as good as none.
Matching match(const std::vector<Link>& links, std::size_t passages, double price);

}  // namespace recoil
