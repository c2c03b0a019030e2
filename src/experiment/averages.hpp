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

struct AverageOptions {
  std::size_t per_bin = 40;        ///< approximate number of impacts of one point
  std::size_t size_classes = 1;    ///< classes with equally many spheres, unless `size_edges`
  std::vector<double> size_edges;  ///< ascending [m]; impacts outside are left out
  bool mean_diameter = false;  ///< every point has the mean diameter of its series and size class
};

/// The mean of the impacts of one bin of incident velocity, one size class and one series.
struct PointMean {
  std::string series;           ///< name, with the size class if there are several
  double diameter = 0.0;        ///< mean over all impacts of the bin [m]
  double velocity = 0.0;        ///< mean incident velocity at the surface [m/s]
  double velocity_sd = 0.0;     ///< standard error of `velocity` [m/s]; 0: a single impact
  double restitution = 0.0;     ///< mean over the rebounds [1]
  double restitution_sd = 0.0;  ///< standard error of `restitution` [1]; 0: fewer than two rebounds
  double scatter = 0.0;         ///< standard deviation of one rebound [1]
  std::size_t rebounds = 0;
  std::size_t unpaired = 0;   ///< passages down without a rebound
  std::size_t came_back = 0;  ///< unpaired that rebounded, as a later passage shows
  double lost = 0.0;          ///< expected number of unpaired whose rebound was not detected
  double too_slow = 0.0;      ///< expected number of unpaired that did not reach the plane
  bool slow_known = false;    ///< the rebounds determine `too_slow`
  std::size_t captured = 0;   ///< the other unpaired, if their number is significant

  std::size_t events() const { return rebounds + captured; }
};

/// The averages of all bins, and sums over the passages without a rebound.
struct Averages {
  std::vector<PointMean> points;  ///< by series, size class, velocity; those with events() > 0
  std::size_t unpaired = 0;
  std::size_t came_back = 0;
  double lost = 0.0;
  double too_slow = 0.0;
  std::size_t captured = 0;
  double unresolved = 0.0;        ///< other unpaired: an excess that is not significant
  double narrowest = 0.0;         ///< least ln of the ratio of velocities within a bin [1]
  std::size_t single = 0;         ///< impacts with fewer than 5 (or `per_bin`) at their velocity:
                                  ///< each is a point
  double lost_share = 0.0;        ///< share of rebounds not detected [1]: stated or `missed_share`
  double fast_unpaired = 0.0;     ///< share of unpaired among the fastest quarter [1]
  std::size_t fast_impacts = 0;   ///< in that quarter
  std::size_t outside_sizes = 0;  ///< impacts outside of `size_edges`
};

/// Sorts the used impacts and unpaired passages of each series and size class by incident velocity.
/// Divides them at gaps (drop heights) that are wider than 4 standard deviations of a velocity's
/// error and than twice the span of the 5 nearest velocities on both sides, which a gap of
/// continuous velocities is with a probability of 3^-8. Divides each part into bins of about
/// `per_bin` impacts that are at least 6 such deviations wide. Finer bins would sort by the errors,
/// which are anticorrelated with e = V_rebound / V.
///
/// With n detected rebounds and the lost share s, n s / (1 - s) more are expected undetected. The
/// expected number of rebounds too slow to return (below sqrt(2 g h) at the surface) follows from a
/// normal distribution with mean and scatter of the detected ones; it is known only if this mean is
/// at least one standard deviation above the limit. The other unpaired are called captured if a
/// Poisson variable with the mean of lost and too slow is as large as the number of unpaired with a
/// probability below 1 %, divided by the number of bins.
Averages average(const std::vector<Passage>& passages, const std::vector<std::string>& series,
                 const PairingResult& pairs, const AverageOptions& options);

/// The request of `recoil pair`.
struct PairRequest {
  std::string file;
  PairingOptions pairing;
  AverageOptions averaging;
};

/// The result of `recoil pair`.
struct PairedPassages {
  PassageTable table;
  PairingResult pairs;
  Averages averages;
};

/// Pairs the passages of `table` and averages them.
PairedPassages pair_and_average(PassageTable table, const PairRequest& request);

/// @param dashes prefix of options in the message: "--", or "" for Python
/// @throws ComputationError if there are no impacts
void require_impacts(const PairedPassages& paired, const PairRequest& request,
                     const char* dashes = "--");

}  // namespace recoil
