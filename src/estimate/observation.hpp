#pragma once

#include <cstddef>

namespace recoil {

/// The conditions of one impact: a sphere of a dataset before contact.
struct PointConditions {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
  std::size_t series = no_series;

  /// The sphere has no series; parameters of a series do not act.
  static constexpr std::size_t no_series = static_cast<std::size_t>(-1);
};

/// The measured values of one point.
struct MeasuredPoint {
  std::size_t dataset = 0;
  std::size_t series = 0;
  std::size_t setting = 0;         ///< setting of the apparatus: its points share an error
  std::size_t launch = no_launch;  ///< successive bounces of one launch share timing errors
  std::size_t bounce = 0;          ///< number of the bounce within the launch
  int line = 0;                    ///< line in the dataset's file of points
  double diameter = 0.0;           ///< [m]
  double velocity = 0.0;           ///< [m/s]
  double restitution = 0.0;        ///< mean e of the impacts that rebounded [1]
  /// No e is known: all spheres were captured, or rebounds were only counted.
  bool censored = false;

  int events = 1;                 ///< number of impacts, captured ones included
  int captured = 0;               ///< number of captured impacts
  bool counted = false;           ///< captures were counted, so `captured = 0` is a measurement
  bool rebound_measured = false;  ///< e is the quotient of two velocities: it shares the error of V
  double velocity_sd = 0.0;       ///< sd of V [m/s]; 0: none
  /// sd of the error of V that its setting shares [m/s]; 0: none.
  double setting_velocity_sd = 0.0;
  double diameter_sd = 0.0;         ///< sd of d [m]; 0: none
  double series_diameter_sd = 0.0;  ///< sd of the error of d that its series shares [m]; 0: none

  /// No other point shares its timing errors.
  static constexpr std::size_t no_launch = static_cast<std::size_t>(-1);

  int rebounds() const { return events - captured; }
  /// Does this point have both rebounds and captures?
  bool mixed() const { return captured > 0 && captured < events; }
  /// Did spheres rebound with unknown e?
  bool counts_only() const { return censored && captured < events; }
  PointConditions conditions() const { return {dataset, diameter, velocity, series}; }
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

/// A measured point with its weights.
struct Observation : MeasuredPoint {
  PointWeights weights;

  /// Does the deviance have a minimum, `peak`? Counts with all or no impacts captured have none.
  bool peaks() const { return weights.scatter > 0.0 && (!censored || mixed()); }
  /// Does the point carry more information than that `predicted` e^2 has the right sign?
  bool informs(double predicted) const {
    return !censored || mixed() || (captured > 0) == (predicted > 0.0);
  }
  /// Standard deviation of the e of a single impact [1], if `weights.sd` is that of the mean of n
  /// independent impacts.
  double event_sd() const;
};

}  // namespace recoil
