#pragma once

#include <cstddef>

namespace recoil {

/// A sphere of one dataset about to hit: where a model is asked for an answer.
struct PointConditions {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
  std::size_t series = no_series;

  /// A sphere of no series in particular: what belongs to a series is left out.
  static constexpr std::size_t no_series = static_cast<std::size_t>(-1);
};

/// What was measured at one point.
struct MeasuredPoint {
  std::size_t dataset = 0;
  std::size_t series = 0;
  std::size_t setting = 0;         ///< of the apparatus: points of one setting share its error
  std::size_t launch = no_launch;  ///< successive bounces of one launch share instants
  std::size_t bounce = 0;          ///< its number within the launch
  int line = 0;                    ///< in the dataset's file of points
  double diameter = 0.0;           ///< [m]
  double velocity = 0.0;           ///< [m/s]
  double restitution = 0.0;        ///< mean e of the impacts that rebounded [1]
  bool censored = false;           ///< no e is known: all spheres were captured, or only counted

  int events = 1;                 ///< impacts, captured ones included
  int captured = 0;               ///< how many of them were captured
  bool counted = false;           ///< captures were counted: `captured = 0` is a measurement
  bool rebound_measured = false;  ///< e is the quotient of two velocities: it shares the error of V
  double velocity_sd = 0.0;       ///< [m/s]; 0: none
  double setting_velocity_sd = 0.0;  ///< of an error that its setting shares [m/s]; 0: none
  double diameter_sd = 0.0;          ///< [m]; 0: none
  double series_diameter_sd = 0.0;   ///< of an error that its series shares [m]; 0: none

  /// No other point was timed at the same instants.
  static constexpr std::size_t no_launch = static_cast<std::size_t>(-1);

  int rebounds() const { return events - captured; }
  /// Are there both rebounds and captures among the impacts of this point?
  bool mixed() const { return captured > 0 && captured < events; }
  /// Did spheres rebound whose e is not known?
  bool counts_only() const { return censored && captured < events; }
  PointConditions conditions() const { return {dataset, diameter, velocity, series}; }
};

/// The predicted e^2 at which one point is most likely, and the deviance D = -2 ln L there.
struct DeviancePeak {
  double at = 0.0;         ///< [1]
  double deviance = 0.0;   ///< D(at)
  double curvature = 0.0;  ///< D''(at), > 0
  double third = 0.0;      ///< D'''(at)
};

/// What weights one point. All but a stated `sd` is renewed round by round at the parameters of the
/// round before, see `renew_weights`.
struct PointWeights {
  double sd = 0.0;            ///< standard deviation of the mean e: stated, or estimated [1]
  double proximity = 0.0;     ///< to capture, (V* / V)^2, at most 1; only where noise is estimated
  double input_sd = 0.0;      ///< sd of e^2 that the errors of V and d cause [1]
  double input_bias = 0.0;    ///< what the curvature of e^2 over these errors amounts to [1]
  double scatter = 0.0;       ///< sd of e^2 from impact to impact [1]; 0: not in use
  double shift = 0.0;         ///< mean e^2 of the impacts minus that of the mean impact [1]
  double mean_sd = 0.0;       ///< sd of the mean e with its share of input_sd, beside scatter [1]
  double setting_sd = 0.0;    ///< sd of e that the stated error of V of its setting causes [1]
  double size_sd = 0.0;       ///< sd of e that the error of d of its series causes [1]
  double setting_load = 0.0;  ///< |dr / de| of the residual times the error of e that the points of
                              ///< its setting share [1]
  double size_load = 0.0;     ///< |dr / de| size_sd, of the points of its series [1]
  DeviancePeak peak;          ///< where scatter is in use and some sphere rebounded
};

/// A point as the estimator sees it.
struct Observation : MeasuredPoint {
  PointWeights weights;

  /// Has its deviance a `peak`? Counts of which all or none are captured have none.
  bool peaks() const { return weights.scatter > 0.0 && (!censored || mixed()); }
  /// Does it say more than that `predicted` e^2 has the right sign?
  bool informs(double predicted) const {
    return !censored || mixed() || (captured > 0) == (predicted > 0.0);
  }
  /// Standard deviation of a single impact's e [1]: n independent impacts make a mean of sd.
  double event_sd() const;
};

}  // namespace recoil
