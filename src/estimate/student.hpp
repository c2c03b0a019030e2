#pragma once

#include <span>

namespace recoil {

/// A residual, dimensionless, and its derivative with respect to the predicted e^2.
struct WeightedResidual {
  double value = 0.0;
  double slope = 0.0;
};

/// Student's t with nu degrees of freedom as the distribution of residuals, against outliers.
///
/// A residual r counts as D(r) = (nu + 1) ln(1 + r^2 / nu) instead of r^2; psi = D' / 2 =
/// (nu + 1) r / (nu + r^2) falls again beyond sqrt(nu). The standard deviations mean the normal
/// core, so everything is calibrated there (Huber 1981, Robust Statistics, chapters 4 and 7):
/// the estimate has variance E psi^2 / (E psi')^2, that is 1 / efficiency times that of least
/// squares, and c^2 D with c^2 = E psi' / E psi^2 rises like a chi-squared.
struct StudentNoise {
  double dof = 4.0;           ///< nu
  double mean_slope = 1.0;    ///< E psi' for normal r
  double mean_square = 1.0;   ///< E psi^2
  double gauss_newton = 1.0;  ///< E psi^2 / D, what J'J holds instead of E psi'
  double core = 1.0;          ///< scale of a t whose psi(r)^2 has the same mean: for simulations

  double psi(double r) const;
  /// sign(r) c sqrt(D(r)): what least squares has to be given to minimise c^2 D.
  WeightedResidual transformed(const WeightedResidual& normal) const;
  /// The r that `transformed` turned into `value`.
  double original(double value) const;
  /// That residuals of t noise with this core are as large as `residuals`: twice the smaller of two
  /// probabilities (Bonferroni). One is that of the sum of D, which grows with every outlier, by a
  /// gamma distribution with the mean and variance of D for t, both times dof / n; for t
  ///   E D = (nu + 1) (psi((nu + 1) / 2) - psi(nu / 2)),
  ///   Var D = (nu + 1)^2 (psi'(nu / 2) - psi'((nu + 1) / 2)),
  /// as 1 / (1 + t^2 / nu) is a beta variate. The other is that of the largest among n. psi itself
  /// falls beyond sqrt(nu) and sees no outlier.
  double p_value(std::span<const double> residuals, int dof) const;
  double calibration() const { return mean_slope / mean_square; }  ///< c^2
  /// What (J'J)^-1 is multiplied by to be the covariance.
  double covariance_factor() const { return gauss_newton / mean_slope; }
  /// Variance of least squares over that of this estimate for normal noise: below 1, the cost.
  double efficiency() const { return mean_slope * mean_slope / mean_square; }
};

/// The constants for `dof` degrees of freedom, by quadrature.
StudentNoise student_noise(double dof);

/// Variance of least squares over that of this estimate where a share `share` of the residuals has
/// a standard deviation `factor` times larger than the rest: above 1, the gain.
double gain_under_outliers(const StudentNoise& student, double share, double factor);

}  // namespace recoil
