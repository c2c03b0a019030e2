#pragma once

#include <string>
#include <vector>

namespace recoil::plot {

/// From here to there, on an axis.
struct Range {
  double lower = 0.0;
  double upper = 1.0;

  bool holds(double value) const { return value >= lower && value <= upper; }
  double width() const { return upper - lower; }
};

/// Holds all finite values, with a margin on both sides (a share of the width); [0, 1] when there
/// are none.
Range range_of(const std::vector<double>& values, double margin);

/// The same for a logarithmic axis: the margin is a share of the ratio. Values that are not
/// positive have no place there.
Range log_range_of(const std::vector<double>& values, double margin);

/// The range between two quantiles of the finite values.
Range quantile_range(std::vector<double> values, double lower, double upper);

/// A factor 10^3n that brings numbers of size `magnitude` between 1 and 1000, and the unit that
/// they then have: "10⁻³ s/m".
struct Scaling {
  double factor = 1.0;
  std::string unit;
};
Scaling scaling_for(double magnitude, const std::string& unit);

}  // namespace recoil::plot
