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

/// Chooses links such that every passage is used at most once as `from` and once as `to`: as many
/// as possible of low cost. The links are taken by ascending cost; where taking one has left two
/// others without a partner that together fit nearly as well, the exchange is made when it pairs
/// more passages for at most `price` more cost. O(n log n) for n links.
///
/// @param passages indices lie below this.
/// @param price the cost at which a link is as good as none.
/// @returns the indices of the chosen links, ascending in `from`.
std::vector<std::size_t> choose_links(const std::vector<Link>& links, std::size_t passages,
                                      double price);

/// How many of the `chosen` links are expected to be wrong because two of them had exchanged their
/// partners: over all pairs of chosen links that could, 2 p with p = 1 / (1 + exp(D / 2)) and D the
/// cost of the exchange (the odds of two sets of normal deviations).
double expected_exchanged(const std::vector<Link>& links, const std::vector<std::size_t>& chosen,
                          std::size_t passages);

}  // namespace recoil
