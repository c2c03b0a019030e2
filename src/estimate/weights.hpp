#pragma once

#include <optional>
#include <span>
#include <vector>

#include "estimate/noise.hpp"
#include "estimate/observations.hpp"

namespace recoil {

struct ImpactModel;
class PointPredictor;

/// The predicted e^2 at which the likelihood of one point is largest, and the deviance D = -2 ln L
/// there.
struct DeviancePeak {
  double at = 0.0;         ///< [1]
  double deviance = 0.0;   ///< D(at)
  double curvature = 0.0;  ///< D''(at), > 0
  double third = 0.0;      ///< D'''(at)
};

/// The weights of one point.
struct PointWeights {
  double sd = 0.0;  ///< standard deviation of the mean e: stated, or estimated [1]
  /// Closeness to capture, (V* / V)^2, at most 1; only if the noise is estimated or pooled [1].
  double proximity = 0.0;
  double input_sd =
      0.0;  ///< sd of e^2 from the errors that no other point shares; without e, all [1]
  double input_bias = 0.0;  ///< shift of e^2 by its curvature over these errors [1]
  double scatter = 0.0;     ///< sd of e^2 from impact to impact [1]; 0: not used
  double shift = 0.0;       ///< mean e^2 of the impacts minus e^2 of the mean impact [1]
  /// sd of the mean e including `input_sd`; used with scatter [1].
  double mean_sd = 0.0;
  DeviancePeak peak;  ///< used if `peaks`

  /// Does the deviance of `point` have a minimum, `peak`? Counts with all or no impacts captured
  /// have none.
  bool peaks(const Observation& point) const {
    return scatter > 0.0 && (!point.censored || point.mixed());
  }
};

/// The weights of the points at some parameters, with the noise that was estimated there.
struct Weights {
  std::vector<PointWeights> points;
  Noise noise;
  std::vector<double> predicted;  ///< e^2 there [points]; empty before the first fit
  /// The change of e^2 by one standard deviation of each source [Observations::sources][points];
  /// empty for a source before the first fit.
  std::vector<std::vector<double>> effects;

  /// The weights of the points `indices` in that order.
  Weights subset(std::span<const std::size_t> indices) const;
};

/// A data set together with weights.
struct WeightedData {
  Observations data;
  Weights weights;
};

/// The weights from which a fit starts: the stated standard deviations, or equal ones.
Weights first_weights(const Observations& data, Noise noise);
Weights first_weights(const Observations& data);

/// The weights of `data` at `theta`: standard deviations (for the variance function and scale of
/// the noise), effective variances, the scatter from impact to impact (event_spread by maximum
/// likelihood), and the effects of shared errors, with setting_sd estimated if it is not stated.
/// @param before weights whose variance function and scale hold, and where searches start
/// @param points predictor for the points of `data`
/// @return nullopt if an impact cannot be solved
std::optional<Weights> weights_at(const ImpactModel& model, const Observations& data,
                                  Weights before, std::span<const double> theta,
                                  PointPredictor& points);

/// The same weights with only the scatter from impact to impact renewed: event_spread by maximum
/// likelihood at `theta`, and the weights that depend on it. The weights themselves if
/// event_spread is 0.
/// @return nullopt if an impact cannot be solved
std::optional<Weights> with_event_spread_at(const ImpactModel& model, const Observations& data,
                                            Weights before, std::span<const double> theta);

/// The part that the uncertainty of event_spread adds to the covariance (J'J)^-1 of an estimate:
/// with T = -2 ln likelihood, g = d^2 T / (d theta d ln omega) / 2, h = d^2 T / (d ln omega)^2 / 2
/// and C = (J'J)^-1,
///   v b b',  b = -C g = d theta / d ln omega,  v = 1 / (h - g'C g) the variance of ln omega,
/// from the joint information of both, inverted by blocks [p x p]. Empty if event_spread is not
/// used, or if C is empty. Derivatives are differences over a tenth of ln omega; v is at most 1 (a
/// factor e).
std::vector<double> event_spread_covariance(const ImpactModel& model, std::span<const double> theta,
                                            const Observations& data, const Weights& weights,
                                            std::span<const double> C);

/// -2 ln likelihood minus the sum of squared residuals, as far as it depends on event_spread: sum
/// over the points with scatter and rebounds of D(peak) + 2 ln mean_sd.
double event_spread_offset(const Observations& data, const Weights& weights);

}  // namespace recoil
