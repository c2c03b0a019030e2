#pragma once

#include <vector>

namespace recoil {

/// How much a deviation scatters, as a piecewise linear function of a variable x: the robust
/// standard deviation in classes of equal number, joined at the medians of the classes.
class LocalSpread {
 public:
  /// The same everywhere.
  explicit LocalSpread(double everywhere) : x_{0.0}, sd_{everywhere} {}

  /// @param x, deviation of equal size; classes hold at least 60 values.
  /// @param lowest, highest limits of the result.
  LocalSpread(const std::vector<double>& x, const std::vector<double>& deviation, double lowest,
              double highest);

  double at(double x) const;
  /// The largest anywhere.
  double largest() const;

 private:
  std::vector<double> x_;
  std::vector<double> sd_;
};

}  // namespace recoil
