#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "experiment/pairing.hpp"
#include "experiment/passages.hpp"

namespace recoil {

/// Two passages that may belong to one sphere, and how well they agree.
struct Link {
  std::uint32_t from = 0;  ///< index of the earlier passage
  std::uint32_t to = 0;    ///< index of the later one
  double cost = 0.0;       ///< sum of squared deviations in standard deviations [1], >= 0
  double first = 0.0;      ///< the first deviation, relative (height, or time above the plane)
  double second = 0.0;     ///< ln of the ratio of the diameters
};

/// Links in which each passage appears at most once as `from` and at most once as `to`.
struct Matching {
  std::vector<Link> links;  ///< ascending in `from`
  /// The expected number of wrong links because two links should have exchanged their partners: the
  /// sum of 2 p over all pairs of links that could, p = 1 / (1 + exp(D / 2)), D the increase of the
  /// cost (the odds of two sets of normal deviations).
  double exchanged = 0.0;
};

/// Chooses many links of low cost. Takes links by ascending cost. If this leaves a passage without
/// a partner although an exchange with another link would pair both, it makes the exchange if the
/// cost rises by at most `price`. O(n log n) for n links.
/// @param passages upper bound of the indices
/// @param price the cost at which a link is as good as none
Matching match(const std::vector<Link>& links, std::size_t passages, double price);

/// A deviation up to this many standard deviations is agreement [1].
inline constexpr double widest_agreement = 4.5;
/// The largest sum of two squared deviations of a link: chi2 with 2 degrees of freedom exceeds it
/// with a probability of 1e-4 [1].
inline constexpr double worst_link = 18.4;

/// The scatter of a deviation as a piecewise linear function of a variable x: the robust standard
/// deviations of classes with equally many values, joined at the medians of the classes.
class LocalSpread {
 public:
  /// A constant scatter.
  explicit LocalSpread(double everywhere) : x_{0.0}, sd_{everywhere} {}

  /// @param x, deviation values; a class has at least 60
  /// @param lowest, highest limits of the result
  LocalSpread(const std::vector<double>& x, const std::vector<double>& deviation, double lowest,
              double highest);

  double at(double x) const;
  double largest() const;

 private:
  std::vector<double> x_;
  std::vector<double> sd_;
};

/// The model of a true pair: the plane's height and the scatter of both deviations.
struct PairingModel {
  double estimate = 1e-3;         ///< first estimate of the height [m]
  double log_height = 0.0;        ///< ln(height / estimate)
  LocalSpread height_sd{0.05};    ///< of ln h, against ln of the speed up
  LocalSpread diameter_sd{0.05};  ///< of ln(d_up / d_down), against ln of the diameter

  double height() const { return estimate * std::exp(log_height); }  ///< [m]
};

/// All possible pairs: a passage up follows one down within the longest round trip from the highest
/// plane, the diameters agree within the tolerance, the implied height is in the range, and e at
/// the highest plane is at most 1.5. `Link::first` is ln(h_implied / options.height), and the costs
/// are 0.
/// @throws ComputationError if there are more than 200 per passage
std::vector<Link> pair_candidates(const std::vector<Passage>& passages,
                                  const PairingOptions& options);

/// The candidates that agree with `model`, with their costs. Their e, at the height of the model,
/// is at most 1.5.
std::vector<Link> agreeing(const std::vector<Link>& candidates,
                           const std::vector<Passage>& passages, const PairingModel& model);

/// The height at which most candidates agree, and the scatter about it.
struct Refined {
  PairingModel model;
  double log_height_sd = 0.0;  ///< standard error of the height, relative [1]
  double height_spread = 0.0;
  double diameter_spread = 0.0;
  bool refined = false;  ///< there were enough pairs; otherwise the estimate is kept
};
Refined refine_height(const std::vector<Link>& candidates, const std::vector<Passage>& passages,
                      const PairingOptions& options);

/// Links from a passage to a later one of the same sphere, with a flight above the plane in
/// between.
struct Followers {
  std::vector<Link> links;
  double by_chance = 0.0;  ///< number found at wrong times (mean of 0.8 and 1.25 times the time)
  double gain = 0.0;       ///< number of links less twice the number by chance
  bool usable = false;     ///< more than by chance, and the stream was not too crowded to search
};

/// Finds rebounds that come down again: a passage down follows one up with the same speed and
/// diameter after 2 v / g, v the mean of both speeds. The tolerances narrow to the scatter of the
/// links.
Followers find_returns(const std::vector<Passage>& passages, const PairingOptions& options,
                       const PairingModel& model);

/// Finds passages down in `open_down` (without a rebound) whose undetected rebound comes down again
/// in `open_next` (not explained yet): with the speed v of the rebound, it follows after
/// `round_trip(down, v, h)` + 2 v / g.
/// @param velocity_sd relative scatter of a velocity, from the returns [1]
Followers find_unseen(const std::vector<Passage>& passages, const PairingModel& model,
                      const std::vector<bool>& open_down, const std::vector<bool>& open_next,
                      double velocity_sd);

/// Relative scatter of one velocity from the returns [1]; from the tolerance if there are few.
double velocity_scatter(const Followers& returns, const PairingOptions& options);

}  // namespace recoil
