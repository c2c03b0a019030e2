#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/names.hpp"
#include "estimate/student.hpp"

namespace recoil {

struct ImpactModel;
struct Observations;
class PointPredictor;

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

template <>
struct NamesOf<VarianceFunction> {
  static constexpr std::array<std::string_view, 5> names = {"stated", "constant", "proportional",
                                                            "capture", "steep"};
};

/// The noise of the points of a fit: what the fit file and the datasets state about it, and what is
/// estimated together with the parameters.
struct Noise {
  /// The `[noise]` table of a fit file.
  struct Spec {
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

  /// One variance function fitted to the points, with its criterion.
  struct Candidate {
    VarianceFunction function = VarianceFunction::constant;
    double scale = 0.0;              ///< s of the function, for a single impact [1]
    double criterion = 0.0;          ///< -2 ln restricted likelihood: smaller is better
    double event_spread = 0.0;       ///< Noise::event_spread under this function
    std::vector<double> theta = {};  ///< the estimate under this function
  };

  Spec spec;
  bool sd_stated = true;  ///< false: the noise is estimated from the residuals
  int sd_set_aside = 0;   ///< points whose stated standard deviation is not used
  int sd_missing = 0;     ///< points with rebounds that state no sd while others do

  VarianceFunction variance = VarianceFunction::stated;
  double scale = 0.0;  ///< s of the function, for a single impact [1]; 0 when stated
  /// All functions that were compared, if the function was chosen.
  std::vector<Candidate> candidates;
  /// Sd of the rounding of e, q / sqrt(12) if all readings are multiples of q = 0.1, 0.01, ...
  /// 1e-6; lower limit of an estimated sd [1]; 0: not rounded
  double rounding_sd = 0.0;
  double event_spread = 0.0;  ///< relative sd of the capture velocity from impact to impact; 0 if
                              ///< rebounds and captures do not overlap (`among_captures`)
  std::optional<StudentNoise> student;  ///< residuals are Student's t, not normal
  /// False: the noise is not stated and cannot be estimated, because the points do not scatter
  /// about the fit; there are then no standard errors and no tests.
  bool known = true;
  /// sd of the error of e that the points of one setting share, stated or estimated [1].
  double setting_sd = 0.0;

  /// Is the error that the points of one setting share estimated from them? By default if a dataset
  /// names its settings and some have several points.
  bool setting_sd_estimated = false;
  /// Does a dataset state an error of V that the points of a setting share?
  bool setting_velocity_stated = false;
  /// Does a dataset state an error of d that the points of a series share?
  bool series_diameter_stated = false;
  /// Do successive bounces of a launch share timing errors?
  bool shares_instants = false;

  /// Do the points of one setting share an error, stated or estimated?
  bool shares_settings() const {
    return setting_sd_estimated || setting_velocity_stated || spec.setting_sd.value_or(0.0) > 0.0;
  }
  /// Do points share any error?
  bool shares_errors() const {
    return shares_settings() || series_diameter_stated || shares_instants;
  }

  /// The estimated sd of a mean of `impacts` impacts [1].
  /// @param restitution_squared predicted e^2 [1]
  /// @param proximity (V* / V)^2, at most 1 [1]
  double estimated_sd(double restitution_squared, double proximity, int impacts) const;
};

/// The predicted e^2 at which the likelihood of one point is largest, and the deviance D = -2 ln L
/// there.
struct DeviancePeak {
  double at = 0.0;         ///< [1]
  double deviance = 0.0;   ///< D(at)
  double curvature = 0.0;  ///< D''(at), > 0
  double third = 0.0;      ///< D'''(at)
};

/// The weights of one point. Except for a stated `sd`, each round of `reweighted_fit` recomputes
/// them at the parameters of the round before.
struct PointWeights {
  double sd = 0.0;  ///< standard deviation of the mean e: stated, or estimated [1]
  /// Closeness to capture, (V* / V)^2, at most 1; only if the noise is estimated [1].
  double proximity = 0.0;
  double input_sd = 0.0;    ///< sd of e^2 that the errors of V and d cause [1]
  double input_bias = 0.0;  ///< shift of e^2 by its curvature over these errors [1]
  double scatter = 0.0;     ///< sd of e^2 from impact to impact [1]; 0: not used
  double shift = 0.0;       ///< mean e^2 of the impacts minus e^2 of the mean impact [1]
  /// sd of the mean e including the errors of V and d; used with scatter [1].
  double mean_sd = 0.0;
  double setting_sd = 0.0;    ///< sd of e from the stated error of V that its setting shares [1]
  double size_sd = 0.0;       ///< d e / d d times the sd of d that its series shares [1]
  double setting_load = 0.0;  ///< |dr / de| of the residual r times the sd of the error of e that
                              ///< its setting shares [1]
  double size_load = 0.0;     ///< |dr / de| size_sd [1]
  DeviancePeak peak;          ///< used if `peaks()`
};

/// Recomputes the weights of `data` at `theta`: estimated standard deviations (for the present
/// variance function and scale), effective variances, the scatter from impact to impact
/// (event_spread by maximum likelihood), and shared errors.
/// @param points predictor for the points of `data`
/// @return the predicted e^2 of every point; nullopt if an impact cannot be solved
std::optional<std::vector<double>> renew_weights(const ImpactModel& model,
                                                 std::span<const double> theta,
                                                 PointPredictor& points, Observations& data);

/// Recomputes only the scatter from impact to impact: event_spread by maximum likelihood at
/// `theta`, and the weights that depend on it. Standard deviations and effective variances do not
/// change. Does nothing if event_spread is 0.
/// @return false if an impact cannot be solved
bool renew_event_spread(const ImpactModel& model, std::span<const double> theta,
                        Observations& data);

/// The part that the uncertainty of event_spread adds to the covariance (J'J)^-1 of an estimate:
/// with T = -2 ln likelihood, g = d^2 T / (d theta d ln omega) / 2, h = d^2 T / (d ln omega)^2 / 2
/// and C = (J'J)^-1,
///   v b b',  b = -C g = d theta / d ln omega,  v = 1 / (h - g'C g) the variance of ln omega,
/// from the joint information of both, inverted by blocks [p x p]. Empty if event_spread is not
/// used, or if C is empty. Derivatives are differences over a tenth of ln omega; v is at most 1 (a
/// factor e).
std::vector<double> event_spread_covariance(const ImpactModel& model, std::span<const double> theta,
                                            const Observations& data, std::span<const double> C);

/// -2 ln likelihood minus the sum of squared residuals, as far as it depends on event_spread: sum
/// over the points with scatter and rebounds of D(peak) + 2 ln mean_sd.
double event_spread_offset(const Observations& data);

}  // namespace recoil
