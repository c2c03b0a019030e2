#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "experiment/pairing.hpp"
#include "experiment/passages.hpp"

namespace recoil {

/// How impacts become points.
struct AverageOptions {
  std::size_t per_bin = 40;        ///< impacts of one point, about
  std::size_t size_classes = 1;    ///< classes of equal number, unless `size_edges` are given
  std::vector<double> size_edges;  ///< ascending [m]; impacts outside are left out
  bool mean_diameter = false;  ///< every point has the mean diameter of its series and size class
};

/// The mean of the impacts of one bin of incident velocity, one size class and one series.
struct PointMean {
  std::string series;           ///< with the size class where there are several
  double diameter = 0.0;        ///< mean over all impacts of the bin [m]
  double velocity = 0.0;        ///< the same, at the surface [m/s]
  double velocity_sd = 0.0;     ///< standard error of it [m/s]; 0: a single impact
  double restitution = 0.0;     ///< mean over the rebounds [1]
  double restitution_sd = 0.0;  ///< standard error of it [1]; 0: fewer than two rebounds
  double scatter = 0.0;         ///< standard deviation of one rebound [1]
  std::size_t rebounds = 0;
  std::size_t unpaired = 0;   ///< passages down without a rebound
  std::size_t came_back = 0;  ///< of these, proved to have rebounded unseen
  double lost = 0.0;          ///< of the unpaired, expected to have rebounded unseen
  double too_slow = 0.0;      ///< of the unpaired, expected not to have climbed to the plane
  bool slow_known = false;    ///< the rebounds say how many of them are too slow
  std::size_t captured = 0;   ///< the rest, where it is more than the lost could be by accident

  std::size_t events() const { return rebounds + captured; }
};

/// Averages over all bins, and the sums of what became of passages without a rebound.
struct Averages {
  std::vector<PointMean> points;  ///< by series, size class, velocity; those with events() > 0
  std::size_t unpaired = 0;
  std::size_t came_back = 0;
  double lost = 0.0;
  double too_slow = 0.0;
  std::size_t captured = 0;
  double unresolved = 0.0;        ///< unpaired, and none of these: an excess that may be accident
  double narrowest = 0.0;         ///< ln of the ratio of velocities that a bin spans at least [1]
  std::size_t in_small_bins = 0;  ///< impacts left out: fewer than 5 (or `per_bin`) together
  double lost_share = 0.0;        ///< of rebounds that go unseen [1]: stated, or `missed_share`
  double fast_unpaired = 0.0;     ///< share of unpaired among the fastest quarter [1]
  std::size_t fast_impacts = 0;   ///< in that quarter
  std::size_t outside_sizes = 0;  ///< impacts outside of `size_edges`
};

/// Sorts the used impacts and unpaired passages of each series and size class by incident velocity,
/// divides them at gaps wider than 4 standard deviations of a velocity's error (drop heights), and
/// each part into bins of about `per_bin`, but of no less than 6 such deviations: finer bins would
/// be cut by the errors, and an error that is high in V is low in e = V_rebound / V.
///
/// Of n rebounds that were seen, n s / (1 - s) more went unseen, s the lost share. Of the rebounds
/// too slow to return (below sqrt(2 g h) at the surface) as many are expected as a normal
/// distribution with mean and scatter of the seen ones has below that; this is known only where
/// that mean lies above the limit by one standard deviation. What is left is called captured where
/// a Poisson number with the mean of lost and too slow reaches the unpaired with a probability
/// below 1 %, divided by the number of bins.
Averages average(const std::vector<Passage>& passages, const std::vector<std::string>& series,
                 const PairingResult& pairs, const AverageOptions& options);

/// The request of `recoil pair`.
struct PairRequest {
  std::string file;
  PairingOptions pairing;
  AverageOptions averaging;
};

/// The options of `recoil pair` in the units in which they are given.
struct PairArguments {
  std::map<std::string, std::string> units, columns;  ///< by field
  bool positive_away = false;  ///< velocities are positive away from the surface
  double height = 1.0;         ///< [mm]
  double height_range = 1.5;
  bool keep_height = false;
  double diameter_tolerance = 0.2, velocity_tolerance = 0.15;
  bool keep_later = false;
  std::optional<double> threshold;  ///< [m/s]
  std::optional<double> angle;      ///< [degrees]
  std::optional<double> lost_share;
  std::size_t per_bin = 40, size_classes = 1;
  std::vector<double> size_edges;  ///< [um]
  bool mean_diameter = false;
  RECOIL_FIELDS(units, columns, positive_away, height, height_range, keep_height,
                diameter_tolerance, velocity_tolerance, keep_later, threshold, angle, lost_share,
                per_bin, size_classes, size_edges, mean_diameter)

  PairRequest request(const std::string& file) const;
};

/// Its result.
struct PairedPassages {
  PassageTable table;
  PairingResult pairs;
  Averages averages;
};

/// Pairs the passages of `table` and averages them.
PairedPassages pair_and_average(PassageTable table, const PairRequest& request);

/// @param dashes what stands before the name of an option where it is given: "--" or nothing
/// @throws ComputationError when there are no impacts, with what may be wrong.
void require_impacts(const PairedPassages& paired, const PairRequest& request,
                     const char* dashes = "--");

}  // namespace recoil
