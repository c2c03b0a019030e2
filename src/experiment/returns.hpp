#pragma once

#include <cstddef>
#include <vector>

#include "experiment/pair_search.hpp"

namespace recoil {

/// Passages that follow from an earlier one of the same sphere over a flight above the plane.
struct Followers {
  std::vector<Link> links;
  double by_chance = 0.0;  ///< number found at wrong times (mean of 0.8 and 1.25 of the time)
  bool usable = false;     ///< they exceed chance, and the stream was not too crowded to search
};

/// Rebounds that come down again: a passage down with the speed and diameter of one up, the time
/// above the plane 2 v / g after it (v the mean of both speeds). The tolerances narrow to the
/// scatter that the links show.
Followers find_returns(const std::vector<Passage>& passages, const PairingOptions& options,
                       const PairingModel& model);

/// Passages down in `open_down` (without a rebound) that are followed by one in `open_next` (not
/// yet explained) as if they had rebounded unseen: its speed v is that of the rebound, so it comes
/// after `round_trip(down, v, h)` + 2 v / g.
/// @param velocity_sd relative scatter of a velocity, from the returns [1].
Followers find_unseen(const std::vector<Passage>& passages, const PairingOptions& options,
                      const PairingModel& model, const std::vector<bool>& open_down,
                      const std::vector<bool>& open_next, double velocity_sd);

/// Relative scatter of one velocity that the returns show [1]; the tolerance's when there are few.
double velocity_scatter(const Followers& returns, const PairingOptions& options);

}  // namespace recoil
