#pragma once

#include <span>
#include <vector>

#include "core/random.hpp"
#include "estimate/observations.hpp"

namespace recoil {

/// |dr / de| of the residual r at predicted e^2 = `restitution_squared`.
double slope_in_restitution(const WeightedResidual& residual, double restitution_squared);

/// The errors that points share, and the whitening of their residuals.
///
/// Every setting of the apparatus (a height, a day) has an error of e, normal with standard
/// deviation sigma, to which a stated error s of its V adds |e + V de/dV| s / V in quadrature (its
/// points have one V, so that both act in the same way). Every series may have an error s of its d,
/// which shifts e by (de/dd) s. With the loads |dr_i / de| times the error of e as the columns of
/// U, one for each setting or series, the weighted residuals r have the covariance I + U U'.
/// Whitening replaces r by (I + U U')^(-1/2) r, whose sum of squares is that of generalised least
/// squares. A captured point has no e, and its load is 0.
///
/// Successive bounces of a launch share the instants t at which they were timed. In e_k = (t_(k+2)
/// - t_(k+1)) / (t_(k+1) - t_k) the errors of t_k, t_(k+1) and t_(k+2), independent and of equal
/// size, have coefficients in the ratio 1 : -(1 + 1/e_k) : 1/e_k. The correlation matrix of the
/// residuals that follows replaces I. The effect of these errors on V is neglected: V de/dV is
/// small compared with e for a ball.
class SharedSettings {
 public:
  explicit SharedSettings(const std::vector<Observation>& points);

  bool none() const { return blocks_.empty(); }
  void whiten(std::span<double> residuals) const { whiten(residuals, 1); }
  /// Whitens every column of `rows` [points x columns, row major]; rows after those of the points
  /// do not change.
  void whiten(std::span<double> rows, std::size_t columns) const;
  /// ln det (I + U U').
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
    /// For blocks with bounces: (correlations + U U')^(-1/2) [points x points].
    std::vector<double> whole;
  };
  void add_block(const std::vector<Observation>& points,
                 const std::vector<const std::vector<Member>*>& columns);

  std::vector<Block> blocks_;
  double log_determinant_ = 0.0;
};

/// Estimates sigma from the scatter between settings, compared with the scatter within them. With
/// m_k the weighted mean deviation of e from the prediction in setting k, v_k its variance from the
/// scatter within settings, and p parameters, sigma solves
///   sum m_k^2 / (v_k + sigma^2) = settings - p
/// (Paule & Mandel 1982, J. Res. Natl. Bur. Stand. 87, 377-385); 0 without a solution.
/// @param trends functions that the m_k may contain and that are removed by weighted least squares,
///   each at the cost of one parameter [functions][points]
double estimated_setting_error(const Observations& data, std::span<const double> predicted,
                               int free_count, std::span<const std::vector<double>> trends = {});

/// Settings minus free parameters and differences between series: the number of deviations from
/// which sigma is estimated.
int spare_settings(const Observations& data, int free_count);

/// Is sigma estimated from too few settings to distinguish it from a misfit of the model?
bool too_few_settings(const Observations& data, int free_count);

/// Recomputes `setting_load` and `size_load` of all points at the predicted e^2. Before that,
/// estimates sigma if it is not stated: together with an offset of every series, and limited to the
/// error of e that the stated errors of V cause.
void renew_settings(std::span<const double> predicted, int free_count, Observations& data);

/// Draws the shared error of e for every point, from its setting, series and launch [points] [1].
/// @param noise_scale scale of the errors of the bounces of a launch, which have no other errors
std::vector<double> draw_setting_errors(const Observations& data, double noise_scale,
                                        RandomStream& random);

/// e^2 if e is read too large by `error`; unchanged for captures.
double shifted_square(double restitution_squared, double error);

/// The number of settings whose points share an error, and the number of their points.
struct SettingCount {
  int settings = 0;
  int points = 0;
};
SettingCount count_settings(const Observations& data);

}  // namespace recoil
