#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiment/passages.hpp"

namespace recoil {

/// How passages are paired. `recoil pair --help` explains each default.
struct PairingOptions {
  double height = 1e-3;       ///< first estimate of the probe plane's height above the surface [m]
  double height_range = 1.5;  ///< the true height lies within this factor of it [1]
  bool refine = true;         ///< find the height in the data; else `height` is taken as it is
  double diameter_tolerance = 0.2;   ///< largest relative difference of the two diameters [1]
  double velocity_tolerance = 0.15;  ///< largest relative difference of rebound and return [1]
  std::optional<double> threshold;   ///< slowest incident velocity at the plane that is used [m/s]
  std::optional<double> angle;       ///< rebounds within this of the normal are used [rad]
  bool keep_later = false;           ///< second and further impacts are used, too
  std::optional<double>
      lost_share;  ///< share of rebounds that go unseen; estimated when absent [1]
};

/// One impact: a passage down and the passage up that belongs to it.
struct Impact {
  std::uint32_t down = 0;    ///< index into the passages
  std::uint32_t up = 0;      ///< index into the passages
  double incident = 0.0;     ///< normal velocity at the surface [m/s]
  double rebound = 0.0;      ///< [m/s]
  double restitution = 0.0;  ///< rebound / incident [1]
  double diameter = 0.0;     ///< mean of the two passages [m]
  double angle = 0.0;        ///< of the rebound to the normal, at the surface [rad]
  int number = 1;            ///< 1: from the dispenser; 2, 3: came back from a rebound
  bool used = true;          ///< neither a later impact, nor too slow, nor at too large an angle
};

/// A passage down without its rebound.
struct Unpaired {
  std::uint32_t down = 0;
  double incident = 0.0;  ///< at the surface [m/s]
  int number = 1;
  bool came_back = false;  ///< a later passage down shows that it rebounded unseen: lost
  bool used = true;        ///< as for Impact
};

/// The impacts and their reliability.
struct PairingResult {
  PairingOptions options;
  std::vector<Impact> impacts;     ///< all pairs, by series and time of the incident passage
  std::vector<Unpaired> unpaired;  ///< all passages down without a rebound
  std::size_t down = 0;            ///< passages towards the surface
  std::size_t up = 0;
  std::size_t orphans = 0;  ///< passages up without their passage down

  double height = 0.0;     ///< of the plane [m], refined
  double height_sd = 0.0;  ///< standard error; 0 when not refined [m]
  bool refined = false;
  double height_spread = 0.0;    ///< scatter of one pair's implied height [1]
  double diameter_spread = 0.0;  ///< scatter of ln(d_up / d_down), the middle one [1]

  double velocity_spread = 0.0;  ///< relative scatter of one velocity, from the returns [1]

  double decoy_share = 0.0;  ///< share of foreign passages down that find a partner by chance [1]
  std::size_t decoys = 0;    ///< how many were tried
  double expected_false = 0.0;  ///< number of pairs by chance, estimated from it

  std::size_t returns = 0;        ///< rebounds that were seen coming down again
  double expected_returns = 0.0;  ///< the same counted at a wrong time: chance
  bool returns_usable = true;     ///< they exceed chance, and are used
  double missed_share = 0.0;      ///< share of passages that go unseen: orphans / passages up [1]
  double candidates = 0.0;        ///< pairs that were possible, per passage down [1]

  /// 1 - expected_false / impacts.
  double purity() const;
};

/// Finds the impacts in the passages (sorted by series and time, as `read_passages` leaves them).
///
/// A passage down and one up belong together when the time between them is that of the flight to
/// the surface and back, `flight::round_trip`, for one height of the plane common to all, and when
/// their diameters agree. The restitution plays no part, except that none above 1.5 is taken.
/// 1. All pairs with an implied height within `height_range` of the estimate are candidates.
/// 2. The height at which most of them agree, and the scatter about it, are refined three times.
/// 3. Each passage is given to at most one pair, by ascending squared deviation (`choose_links`).
/// 4. A rebound that comes down again after 2 v / g with the same speed and diameter makes the next
///    impact a later one; so does a passage down after the rebound of another that went unseen.
/// 5. Foreign passages, shifted in time, are thrown in to see how often they find a partner.
/// Time O(n log n) in the number of candidates.
/// @throws ComputationError when the stream is so crowded that there are more than 200 candidates
///   per passage.
PairingResult pair_passages(const std::vector<Passage>& passages, const PairingOptions& options);

}  // namespace recoil
