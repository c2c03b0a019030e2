#pragma once

#include <cmath>
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

/// The errors that a point shares with others, by number: points with the same number share one.
struct SharedNumbers {
  std::size_t setting = 0;         ///< setting of the apparatus
  std::size_t batch = 0;           ///< spheres of one series
  std::size_t size = 0;            ///< spheres of one dataset and diameter
  std::size_t launch = no_launch;  ///< successive bounces of one launch share instants
  std::size_t bounce = 0;          ///< number of the bounce within the launch

  /// No other point shares its instants.
  static constexpr std::size_t no_launch = static_cast<std::size_t>(-1);
};

/// The stated standard deviations of the inputs of a point; 0: none.
struct InputErrors {
  double velocity_sd = 0.0;          ///< of V, independent from point to point [m/s]
  double setting_velocity_sd = 0.0;  ///< of the error of V that its setting shares [m/s]
  double diameter_sd = 0.0;          ///< of d, independent from point to point [m]
  double series_diameter_sd = 0.0;   ///< of the error of d that its series shares [m]
  double batch_diameter_sd = 0.0;    ///< of the error of d that the points of its size share [m]
};

/// The measured values of one point.
struct Observation : SharedNumbers, InputErrors {
  std::size_t dataset = 0;
  std::size_t series = 0;
  int line = 0;              ///< line in the dataset's file of points
  double diameter = 0.0;     ///< [m]
  double velocity = 0.0;     ///< [m/s]
  double restitution = 0.0;  ///< mean e of the impacts that rebounded [1]
  /// Stated sd of that mean, or the one that `gather` assumes where others state theirs [1].
  double sd = 0.0;
  /// No e is known: all spheres were captured, or rebounds were only counted.
  bool censored = false;

  int events = 1;                 ///< number of impacts, captured ones included
  int captured = 0;               ///< number of captured impacts
  bool counted = false;           ///< captures were counted, so `captured = 0` is a measurement
  bool rebound_measured = false;  ///< e is the quotient of two velocities: it shares the error of V

  int rebounds() const { return events - captured; }
  /// Does this point have both rebounds and captures?
  bool mixed() const { return captured > 0 && captured < events; }
  /// Did spheres rebound with unknown e?
  bool counts_only() const { return censored && captured < events; }
  PointConditions conditions() const { return {dataset, diameter, velocity, series}; }
  /// Number of impacts over which an error is averaged: rebounds, or all if no e is known.
  int averaged() const { return censored ? events : rebounds(); }
  /// Does the point carry more information than that `predicted` e^2 has the right sign?
  bool informs(double predicted) const {
    return !censored || mixed() || (captured > 0) == (predicted > 0.0);
  }
  /// Standard deviation of the e of a single impact [1], if `of_mean` is that of the mean of n
  /// independent impacts.
  double event_sd(double of_mean) const {
    return of_mean * std::sqrt(static_cast<double>(rebounds() > 0 ? rebounds() : events));
  }
};

}  // namespace recoil
