#pragma once

#include <span>
#include <vector>

#include "core/random.hpp"
#include "estimate/observations.hpp"

namespace recoil {

/// |dr / de| where the model predicts e^2 = `restitution_squared`, r = `residual`.
double slope_in_restitution(const WeightedResidual& residual, double restitution_squared);

/// The errors that points share. Every setting of the apparatus (a height, a day) has an error of
/// e, normal with standard deviation sigma, to which a stated error s of its V adds
/// |e + V de/dV| s / V in quadrature (its points have one V, so that both act alike). Every series
/// may have an error s of its d, which moves e by (de/dd) s. With the loads |dr_i / de| times the
/// error of e as the columns of U, one for each setting or series, the weighted residuals r have
/// the covariance I + U U'. Whitening takes them to (I + U U')^(-1/2) r, whose sum of squares is
/// that of the generalised least squares. A captured point has no e, and its load is 0.
///
/// Successive bounces of a launch share the instants t at which they were timed: e_k = (t_(k+2) -
/// t_(k+1)) / (t_(k+1) - t_k) errs as 1, -(1 + 1/e_k), 1/e_k times the errors of the three, which
/// are independent and alike. Their residuals have the correlation matrix that follows, instead of
/// I. What these errors do to V is left out: V de/dV is small beside e for a ball.
class SharedSettings {
 public:
  explicit SharedSettings(const std::vector<Observation>& points);

  bool none() const { return blocks_.empty(); }
  void whiten(std::span<double> residuals) const { whiten(residuals, 1); }
  /// Every column of `rows` [points x columns, row major]; what follows the points stays.
  void whiten(std::span<double> rows, std::size_t columns) const;
  /// ln det (I + U U').
  double log_determinant() const { return log_determinant_; }

 private:
  struct Member {
    std::size_t point;
    double load;
  };
  /// Points that share errors with one another, and U of them [points x errors, column major].
  struct Block {
    std::vector<std::size_t> points;
    std::vector<double> loads;
    std::vector<double> inner;  ///< M of (I + U U')^(-1/2) = I - U M U' [errors x errors]
    std::vector<double> whole;  ///< with bounces instead: the root itself [points x points]
  };
  void add_block(const std::vector<Observation>& points,
                 const std::vector<const std::vector<Member>*>& columns);

  std::vector<Block> blocks_;
  double log_determinant_ = 0.0;
};

/// sigma from what lies between settings against what lies within them. With m_k the weighted mean
/// of the deviations of e from what `predicted` says (e^2), v_k its variance by the scatter within
/// settings, and p parameters,
///   sum m_k^2 / (v_k + sigma^2) = settings - p
/// (Paule & Mandel 1982, J. Res. Natl. Bur. Stand. 87, 377-385); 0 where that has no solution.
/// @param trends further functions that may be in the deviations, taken out of the m_k by weighted
///   least squares, each at the cost of one parameter [functions][points]
double estimated_setting_error(const Observations& data, std::span<const double> predicted,
                               int free_count, std::span<const std::vector<double>> trends = {});

/// Settings less free parameters and differences of series: the deviations that an estimate of
/// sigma rests on.
int spare_settings(const Observations& data, int free_count);

/// Is sigma estimated from too few settings to separate it from a misfit of the model?
bool too_few_settings(const Observations& data, int free_count);

/// Renews `setting_load` and `size_load` of all points where they predict e^2 = `predicted`, and
/// before it, where it is not stated, sigma: estimated beside an offset of every series, and no
/// larger than what the stated errors of the velocities make of e.
void renew_settings(std::span<const double> predicted, int free_count, Observations& data);

/// An error of e for every point, which it shares with its setting, series and launch [1].
/// @param noise_scale of the errors of the bounces of a launch, whose own errors these are
std::vector<double> draw_setting_errors(const Observations& data, double noise_scale,
                                        RandomStream& random);

/// e^2 where e reads too large by `error`; below capture nothing is read.
double shifted_square(double restitution_squared, double error);

/// How many settings there are whose points share an error, and how many points they have.
struct SettingCount {
  int settings = 0;
  int points = 0;
};
SettingCount count_settings(const Observations& data);

}  // namespace recoil
