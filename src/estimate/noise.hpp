#pragma once

#include <optional>
#include <vector>

#include "core/names.hpp"
#include "estimate/student.hpp"

namespace recoil {

/// Initial standard deviation of every impact if none is stated; only ratios matter until the scale
/// is estimated from the residuals [1].
inline constexpr double nominal_sd = 0.02;

/// How the standard deviation of a measured e depends on the predicted one. All but `stated` use
/// one number s for all points and n, the number of rebounds that a point averages:
///   constant       sd = s / sqrt(n)
///   proportional   sd = s sqrt(e^2 + 0.1^2) / sqrt(n): relative noise, with a floor so that no
///                  point close to capture weighs without limit
///   capture        sd(e^2) = s / sqrt(n), that is sd = s / (2 e) far from capture and larger close
///                  to it: for impacts that differ in their energy loss
///   steep          sd = s exp(2 (V* / V)^2) / sqrt(n): sevenfold at capture, 7 % more at 5 V*, and
///                  so over a wider range than `capture`; V* to first order in the damping
/// Constant, proportional and capture are the powers 0, 1 and -1 of the power-of-the-mean family,
/// steep an exponential of a variable of the design (both: Carroll & Ruppert 1988, Transformation
/// and Weighting in Regression, chapter 3).
enum class VarianceFunction { stated, constant, proportional, capture, steep };

constexpr auto names_of_values(VarianceFunction) {
  return name_list("stated", "constant", "proportional", "capture", "steep");
}

/// The `[noise]` table of a fit file.
struct NoiseSpec {
  /// Empty for "auto": the stated standard deviations if there are any, else the function that
  /// the points select.
  std::optional<VarianceFunction> variance;

  bool student = false;      ///< `residuals = "student"`: Student's t instead of the normal
  double student_dof = 4.0;  ///< degrees of freedom of Student's t, at least 1

  /// Standard deviation of an error of e that the points of one setting share [1]; 0: none.
  /// Empty: estimated from the points, if settings are named or `every_setting` is true.
  std::optional<double> setting_sd;
  bool every_setting = false;  ///< points without a named setting share one if series, diameter
                               ///< and velocity are equal

  bool velocity_errors = true;        ///< use the velocity_sd of the points
  double velocity_relative_sd = 0.0;  ///< for points without one; 0: none
  bool diameter_errors = true;        ///< use the diameter_sd of the points
  double diameter_relative_sd = 0.0;  ///< for points without one; 0: none
};

/// A standard deviation from n impacts has a relative error of 1 / sqrt(2 (n - 1)), which is about
/// a fifth for this number.
inline constexpr int few_impacts = 15;

/// What the fit file and the datasets state about the noise.
struct StatedNoise {
  NoiseSpec spec;
  bool sd_stated = true;  ///< false: the noise is estimated from the residuals
  int sd_set_aside = 0;   ///< points whose stated standard deviation is not used
  int sd_missing = 0;     ///< points with rebounds that state no sd while others do
  /// Sd of the rounding of e, q / sqrt(12) if all readings are multiples of q = 0.1, 0.01, ...
  /// 1e-6 [1]; 0: not rounded. It is the lower limit of an estimated sd, and adds to a stated one
  /// that is smaller.
  double rounding_sd = 0.0;
  int sd_rounded = 0;     ///< points to whose stated sd it was added
  int sd_of_few = 0;      ///< points with a stated sd that average several impacts, but few
  bool pools_sd = false;  ///< pool these sds if they agree (`pool_deviations`)
  std::optional<StudentNoise> student;  ///< residuals are Student's t, not normal
  /// Is the error that the points of one setting share estimated from them? By default if a dataset
  /// names its settings and some have several points.
  bool setting_sd_estimated = false;
};

/// What is estimated about the noise, together with the parameters.
struct Noise {
  /// One variance function fitted to the points, with its criterion.
  struct Candidate {
    VarianceFunction function = VarianceFunction::constant;
    double scale = 0.0;              ///< s of the function, for a single impact [1]
    double criterion = 0.0;          ///< -2 ln restricted likelihood: smaller is better
    double event_spread = 0.0;       ///< Noise::event_spread under this function
    std::vector<double> theta = {};  ///< the estimate under this function
  };

  VarianceFunction variance = VarianceFunction::stated;
  double scale = 0.0;  ///< s of the function, for a single impact [1]; 0 when stated
  /// All functions that were compared, if the function was chosen.
  std::vector<Candidate> candidates;
  double event_spread = 0.0;  ///< relative sd of the capture velocity from impact to impact; 0 if
                              ///< rebounds and captures do not overlap (`among_captures`)
  /// sd of the error of e that the points of one setting share, stated or estimated [1].
  double setting_sd = 0.0;
  /// False: the noise is not stated and cannot be estimated, because the points do not scatter
  /// about the fit; there are then no standard errors and no tests.
  bool known = true;
  /// Impacts minus points of the stated sds that `scale` pools; 0: they are used as stated.
  int pooled_dof = 0;
  /// Weight of the deviations of uncertain constants relative to the residuals of the points:
  /// noise_scale of the fit, so that they keep their own errors if those of the points are widened.
  double constants_weight = 1.0;

  /// The estimated sd of a mean of `impacts` impacts [1].
  /// @param restitution_squared predicted e^2 [1]
  /// @param proximity (V* / V)^2, at most 1 [1]
  double estimated_sd(double restitution_squared, double proximity, int impacts) const;
};

/// The function that a fit starts with, and its scale, for data under `stated`.
Noise first_noise(const StatedNoise& stated);

}  // namespace recoil
