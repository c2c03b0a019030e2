#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "estimate/observation.hpp"

namespace recoil {

/// What is assumed about the error of the laws: a Gaussian process g in ln V and ln d, relative to
/// the loss of energy.
struct LawErrorPrior {
  double size = 0.0;     ///< standard deviation s of g [1]
  double length = 1.0;   ///< correlation length of g in ln V [1]
  bool by_size = false;  ///< every size of every dataset has its own g; false: g is smooth in ln d

  bool at_capture = false;  ///< g falls as 1 / V^2 from the slowest point of a size on

  bool operator==(const LawErrorPrior&) const = default;
};

/// The factor of the loss, 1 + g. An impact cannot gain energy, so that below g = -1/2 the factor
/// goes on with the same slope as -1 / (4 g), which is above 0.
struct LossFactor {
  double value;  ///< [1]
  double slope;  ///< its derivative by g [1]
  explicit LossFactor(double g)
      : value(g < -0.5 ? -0.25 / g : 1.0 + g), slope(g < -0.5 ? 0.25 / (g * g) : 1.0) {}
};

/// The error of the laws: no law of an impact is exact. The model's loss of energy has an unknown
/// factor,
///   1 - e^2 = (1 - e_model^2) (1 + g(ln V, ln d)),
/// (`LossFactor`) with g normal, its mean 0, its covariance s^2 k and
///   k = exp(-(D ln V)^2 / (2 length^2)) exp(-(D ln d)^2 / (2 length_d^2)),
/// or, `by_size`, the first factor for one size and 0 between two. It is a discrepancy in the sense
/// of Kennedy & O'Hagan (2001, J. R. Stat. Soc. B 63, 425-464). With independent normal
/// coefficients z_j,
///   g = sum_j z_j phi_j(ln V, ln d),
/// where the phi_j are the columns of the pivoted Cholesky factor of s^2 k at the points of the fit
/// and below them, until the rest of the variance is less than `left_out` s^2. Slower than these,
/// g is constant.
class LawError {
 public:
  /// Correlation length in ln d of an error that sizes share [1].
  static constexpr double length_in_size = 1.6;

  /// @param points the conditions at which g is needed
  LawError(const LawErrorPrior& prior, std::span<const PointConditions> points);

  const LawErrorPrior& prior() const { return prior_; }
  /// The number of coefficients z.
  std::size_t count() const { return pivots_.size(); }
  /// phi_j at a point [count()].
  void functions(const PointConditions& at, std::span<double> phi) const;
  /// g at a point for the coefficients z [count()].
  double operator()(const PointConditions& at, std::span<const double> z) const;

 private:
  struct Place {
    double log_velocity, log_diameter;
    std::size_t size;  ///< index into `sizes_`
  };
  struct Size {
    std::size_t dataset;
    double log_diameter;
    double slowest;  ///< ln V below which g is constant
    auto key() const { return std::pair(dataset, log_diameter); }
  };
  Place place_of(const PointConditions& at) const;
  double correlation(const Place& a, const Place& b) const;
  double decay(const Place& at) const;

  LawErrorPrior prior_;
  std::vector<Size> sizes_;  ///< in ascending order of their keys
  std::vector<Place> pivots_;
  std::vector<double> factor_;  ///< Cholesky factor of k at the pivots [count x count], row major
};

}  // namespace recoil
