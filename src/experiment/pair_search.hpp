#pragma once

#include <cstddef>
#include <vector>

#include "experiment/matching.hpp"
#include "experiment/pairing.hpp"
#include "experiment/passages.hpp"

namespace recoil {

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

}  // namespace recoil
