#pragma once

#include <span>

namespace recoil {

/// A dimensionless residual and its derivative with respect to the predicted e^2.
struct WeightedResidual {
  double value = 0.0;
  double slope = 0.0;
};

/// Student's t distribution with nu degrees of freedom for residuals, which is robust against
/// outliers.
///
/// A residual r contributes D(r) = (nu + 1) ln(1 + r^2 / nu) instead of r^2; psi = D' / 2 = (nu +
/// 1) r / (nu + r^2) decreases beyond sqrt(nu). The standard deviations describe the normal core,
/// so the calibration is for normal residuals (Huber 1981, Robust Statistics, chapters 4 and 7):
/// the estimate has variance E psi^2 / (E psi')^2, that is 1 / efficiency times that of least
/// squares, and c^2 D with c^2 = E psi' / E psi^2 rises like a chi-squared.
struct StudentNoise {
  double dof = 4.0;           ///< nu
  double mean_slope = 1.0;    ///< E psi' for normal r
  double mean_square = 1.0;   ///< E psi^2
  double gauss_newton = 1.0;  ///< E psi^2 / D, the value that J'J contains instead of E psi'
  double core = 1.0;          ///< scale of t noise with the same E psi^2, for simulations

  double psi(double r) const;
  /// sign(r) c sqrt(D(r)), the residual whose sum of squares is the sum of c^2 D.
  WeightedResidual transformed(const WeightedResidual& normal) const;
  /// The inverse of `transformed`: the r for which it returns `value`.
  double original(double value) const;
  /// The probability that residuals of t noise with this core are as large as `residuals`: twice
  /// the smaller of two probabilities (Bonferroni). One is that of the sum of D, which increases
  /// with every outlier, from a gamma distribution with the mean and variance of D for t, both
  /// times dof / n; for t
  ///   E D = (nu + 1) (psi((nu + 1) / 2) - psi(nu / 2)),
  ///   Var D = (nu + 1)^2 (psi'(nu / 2) - psi'((nu + 1) / 2)),
  /// as 1 / (1 + t^2 / nu) is a beta variate. The other is that of the largest of n residuals. (The
  /// sum of psi^2 would not detect outliers, because psi decreases beyond sqrt(nu).)
  double p_value(std::span<const double> residuals, int dof) const;
  double calibration() const { return mean_slope / mean_square; }  ///< c^2
  /// The factor that turns (J'J)^-1 into the covariance.
  double covariance_factor() const { return gauss_newton / mean_slope; }
  /// Variance of least squares over that of this estimate for normal noise; below 1.
  double efficiency() const { return mean_slope * mean_slope / mean_square; }
};

/// The constants for `dof` degrees of freedom, by quadrature.
StudentNoise student_noise(double dof);

}  // namespace recoil
