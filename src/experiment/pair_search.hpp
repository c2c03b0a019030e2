#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "experiment/pairing.hpp"
#include "experiment/passages.hpp"

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

/// A deviation counts as agreement up to this many standard deviations [1].
inline constexpr double widest_agreement = 4.5;
/// The largest sum of two squared deviations of a link: beyond it lies 1e-4 of chi2 with 2 degrees
/// of freedom [1].
inline constexpr double worst_link = 18.4;

/// The scatter of a deviation as a piecewise linear function of a variable x: the robust standard
/// deviation in classes of equal number, joined at the medians of the classes.
class LocalSpread {
 public:
  /// A constant.
  explicit LocalSpread(double everywhere) : x_{0.0}, sd_{everywhere} {}

  /// @param x, deviation of equal size; classes hold at least 60 values.
  /// @param lowest, highest limits of the result.
  LocalSpread(const std::vector<double>& x, const std::vector<double>& deviation, double lowest,
              double highest);

  double at(double x) const;
  double largest() const;

 private:
  std::vector<double> x_;
  std::vector<double> sd_;
};

/// The properties of a true pair: the plane's height and the scatter of both deviations.
struct PairingModel {
  double log_height = 0.0;        ///< ln(h / options.height)
  LocalSpread height_sd{0.05};    ///< of ln h, against ln of the speed up
  LocalSpread diameter_sd{0.05};  ///< of ln(d_up / d_down), against ln of the diameter
};

/// All possible pairs: a passage up follows one down within the time that the highest plane allows,
/// the diameters agree within the tolerance, the implied height lies in the range, e is at
/// most 1.5. `Link::first` is ln(h_implied / options.height), costs are 0.
/// @throws ComputationError when there are more than 200 per passage.
std::vector<Link> pair_candidates(const std::vector<Passage>& passages,
                                  const PairingOptions& options);

/// The candidates that agree with `model`, with their cost.
std::vector<Link> agreeing(const std::vector<Link>& candidates,
                           const std::vector<Passage>& passages, const PairingModel& model);

/// The height at which most candidates agree, and the scatter about it.
struct Refined {
  PairingModel model;
  double log_height_sd = 0.0;  ///< standard error of the height, relative [1]
  double height_spread = 0.0;
  double diameter_spread = 0.0;
  bool refined = false;  ///< there were enough pairs; else the estimate was kept
};
Refined refine_height(const std::vector<Link>& candidates, const std::vector<Passage>& passages,
                      const PairingOptions& options);

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
