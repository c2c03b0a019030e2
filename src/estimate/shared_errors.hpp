#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "estimate/observations.hpp"
#include "estimate/weights.hpp"

namespace recoil {

/// The errors that points share, and the whitening of their residuals.
///
/// One standard deviation of a shared error changes e^2 of point i by the effect of its source, and
/// the residual r_i by |dr_i / d e^2| times that: the load of the point. With the loads of every
/// draw as a column of U, the weighted residuals r have the covariance D + U U'. D is the identity,
/// but 0 for points whose whole scatter is a shared error (bounces of a launch). Whitening replaces
/// r by (D + U U')^(-1/2) r, whose sum of squares is that of generalised least squares. A captured
/// point has no e, and its load is 0.
class SharedErrors {
 public:
  SharedErrors(const Observations& data, const Weights& weights);

  bool none() const { return blocks_.empty(); }
  void whiten(std::span<double> residuals) const { whiten(residuals, 1); }
  /// Whitens every column of `rows` [points x columns, row major]; rows after those of the points
  /// do not change.
  void whiten(std::span<double> rows, std::size_t columns) const;
  /// ln det (D + U U').
  double log_determinant() const { return log_determinant_; }

 private:
  struct Member {
    std::size_t point;
    double load;
  };
  /// Points that share errors with each other. `loads` is their part of U [points x errors, column
  /// major].
  struct Block {
    std::vector<std::size_t> points;
    std::vector<double> loads;
    std::vector<double> inner;  ///< M of (I + U U')^(-1/2) = I - U M U' [errors x errors]
    /// For blocks in which D is not I: (D + U U')^(-1/2) [points x points].
    std::vector<double> whole;
  };
  void add_block(const Observations& data, const std::vector<const std::vector<Member>*>& columns);

  std::vector<Block> blocks_;
  double log_determinant_ = 0.0;
};

/// The loads of each source on the residuals: |dr_i / d e^2| times its effect, 0 for captures
/// [Observations::sources][points].
std::vector<std::vector<double>> loads_of_sources(const Observations& data, const Weights& weights);

/// The draws of the errors of one simulated data set. Points that share an error get the same draw.
class ErrorDraws {
 public:
  explicit ErrorDraws(RandomStream& random) : random_(random) {}

  /// The error of point i from this source, in its standard deviations; 0 if it has no such error.
  double operator()(const ErrorSource& source, const Observation& point, std::size_t i);

 private:
  double draw(const ErrorSource& source, std::uint64_t number);

  RandomStream& random_;
  std::map<std::pair<const ErrorSource*, std::uint64_t>, double> drawn_;
};

/// Draws the errors that points share, as the error of e of every point [points] [1].
/// @param noise_scale scale of the errors that are the whole scatter of a point
std::vector<double> draw_shared_errors(const Observations& data, const Weights& weights,
                                       double noise_scale, RandomStream& random);

/// e^2 if e is read too large by `error`; unchanged for captures.
double shifted_square(double restitution_squared, double error);

/// Has the point a scatter of its own, beside the errors that it shares?
bool has_own_scatter(const Observations& data, std::size_t point);

}  // namespace recoil
