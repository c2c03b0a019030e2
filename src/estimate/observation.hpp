#pragma once

#include <cstddef>

#include "estimate/noise.hpp"

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
