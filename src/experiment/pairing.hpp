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
  bool refine = true;         ///< estimate the height from the data; otherwise use `height`
  double diameter_tolerance = 0.2;   ///< largest relative difference of the two diameters [1]
  double velocity_tolerance = 0.15;  ///< largest relative difference of rebound and return [1]
  std::optional<double> threshold;   ///< least incident velocity at the plane that is used [m/s]
  std::optional<double> angle;       ///< largest angle of a used rebound to the normal [rad]
  bool keep_later = false;           ///< use second and further impacts, too
  std::optional<double> lost_share;  ///< share of rebounds not detected [1]; empty: estimated
};

/// One impact: a passage down and the passage up of its rebound.
struct Impact {
  std::uint32_t down = 0;    ///< index into the passages
  std::uint32_t up = 0;      ///< index into the passages
  double incident = 0.0;     ///< normal velocity at the surface [m/s]
  double rebound = 0.0;      ///< [m/s]
  double restitution = 0.0;  ///< rebound / incident [1]
  double diameter = 0.0;     ///< mean of the two passages [m]
  double angle = 0.0;        ///< of the rebound to the normal, at the surface [rad]
  int number = 1;            ///< 1: from the dispenser; 2, 3, ...: after earlier rebounds
  bool used = true;          ///< no later impact, not too slow, not at too large an angle
};

/// A passage down without a rebound.
struct Unpaired {
  std::uint32_t down = 0;
  double incident = 0.0;  ///< at the surface [m/s]
  int number = 1;
  bool came_back = false;  ///< a later passage down shows that it rebounded undetected
  bool used = true;        ///< as for Impact
};

/// The impacts and their reliability: one member for each key of the result file.
struct PairingResult {
  PairingOptions options;
  std::vector<Impact> impacts;     ///< all pairs, by series and time of the incident passage
  std::vector<Unpaired> unpaired;  ///< all passages down without a rebound
  std::size_t down = 0;            ///< passages towards the surface
  std::size_t up = 0;
  std::size_t orphans = 0;  ///< passages up without a passage down

  double height = 0.0;     ///< of the plane [m], refined
  double height_sd = 0.0;  ///< standard error; 0 when not refined [m]
  bool refined = false;
  double height_spread = 0.0;    ///< scatter of one pair's implied height [1]
  double diameter_spread = 0.0;  ///< scatter of ln(d_up / d_down), the middle one [1]

  double velocity_spread = 0.0;  ///< relative scatter of one velocity, from the returns [1]

  double decoy_share = 0.0;     ///< share of shifted passages down that got a partner by chance [1]
  std::size_t decoys = 0;       ///< number of shifted passages
  double expected_false = 0.0;  ///< estimated number of pairs by chance

  std::size_t returns = 0;        ///< rebounds that were detected when they came down again
  double expected_returns = 0.0;  ///< number of such returns by chance, found at wrong times
  bool returns_usable = true;     ///< there are more returns than by chance, and they are used
  double missed_share = 0.0;      ///< share of passages not detected: orphans / passages up [1]
  double candidates = 0.0;        ///< possible pairs per passage down [1]

  /// 1 - expected_false / impacts.
  double purity() const;
};

/// Finds the impacts in passages that are sorted by series and time, as by `read_passages`.
///
/// A passage down and one up belong together if their diameters agree and if the time between them
/// is `flight::round_trip`, the flight to the surface and back, for the height of the plane, which
/// all pairs share. The restitution is not used, except that it must not exceed 1.5.
/// 1. All pairs with an implied height within `height_range` of the estimate are candidates.
/// 2. The height at which most candidates agree, and the scatter about it, are refined three times.
/// 3. Each passage gets into at most one pair, by ascending squared deviation (`match`).
/// 4. An impact is a later one if its passage down is a rebound that comes down again after 2 v / g
///    with the same speed and diameter, or the same of an undetected rebound.
/// 5. Passages that are added with a shift in time show how often a partner is found by chance.
/// Time O(n log n) in the number of candidates.
/// @throws ComputationError if there are more than 200 candidates per passage
PairingResult pair_passages(const std::vector<Passage>& passages, const PairingOptions& options);

}  // namespace recoil
