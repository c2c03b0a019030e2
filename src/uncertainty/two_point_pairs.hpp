#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "estimate/two_point.hpp"

namespace recoil {

/// Median and robust standard deviation, (upper - lower quartile) / 1.349, of an estimate over
/// simulated data sets. Nothing when fewer than `fewest_answers` of them have an answer.
struct EstimateScatter {
  std::optional<double> median;
  std::optional<double> spread;
};

/// Root mean square errors of e [1] at points that a calibration has not seen; nothing where there
/// are none, or no answer.
struct HeldOut {
  std::optional<double> series;     ///< the other points of the calibrated diameter
  std::optional<double> diameters;  ///< the other diameters of the dataset
};

/// The calibration on one pair of points.
struct PairQuality {
  std::size_t low_point = 0;  ///< indices into the observations
  std::size_t high_point = 0;
  std::array<int, 5> ended = {};  ///< simulated data sets by TwoPointStatus; too_few_points: one of
                                  ///< the two points was captured in that data set
  EstimateScatter C_H, C_A;       ///< [s/m], of those that converged
  HeldOut held_out;               ///< median over those that converged
  TwoPointRun measured;           ///< the iteration on the points as they were measured
  HeldOut measured_held_out;  ///< and its error on the measured points; nothing unless converged

  /// The share of simulated data sets without an answer [1].
  double without_answer() const;
};

/// What the paper's shortcut costs, as a function of which two points are taken.
struct PairStudy {
  std::size_t dataset = 0;
  double diameter = 0.0;      ///< of the series that is calibrated [m]
  int simulations = 0;        ///< data sets per pair
  std::size_t points = 0;     ///< of the series that can be part of a pair
  std::size_t taken = 0;      ///< of those, taken: all, or evenly spaced ones with both ends
  double truth_C_H = 0.0;     ///< of the full fit: what the data sets were simulated with [s/m]
  double truth_C_A = 0.0;     ///< [s/m]
  EstimateScatter C_H, C_A;   ///< of the full fit on the same data sets
  int full_failed = 0;        ///< full fits without an answer
  HeldOut held_out;           ///< of the full fit
  HeldOut measured_held_out;  ///< error of the full fit itself on all measured points (seen!)
  std::vector<PairQuality> pairs;  ///< by low point, then high point
  std::size_t paper = 0;           ///< the pair of the lowest and the highest velocity
};

/// A diameter whose pairs are to be studied.
struct PairSeries {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
};

struct PairStudyOptions {
  int simulations = 199;  ///< 0: no study
  std::uint64_t seed = 20260101;
  int threads = 0;  ///< 0: all cores. No digit depends on it.
};

/// Simulates data sets from the full fit, e* = e_model + s sd z with s the fit's noise_scale, and
/// calibrates on every pair of points of the same diameter that rebounded, where the fit does not
/// capture, and with velocities that differ by a factor of 1.5 (of a series with more than 16 such
/// points, 16 evenly spaced ones with both ends are taken); beside it all points are fitted again.
///
/// The held-out error is that of predicting a new measurement of the points that a pair did not
/// use, sqrt(mean((e_calibrated - e_model)^2 + s^2 sd^2)): the new noise enters by its variance,
/// so the full fit, which has seen a first measurement of those points, is not favoured. Of each
/// kind of points at most 60, evenly spaced, are judged.
/// @return one study per series that has a pair; none without simulations
std::vector<PairStudy> study_two_point_pairs(const FitResult& fitted,
                                             const std::vector<PairSeries>& series,
                                             const PairStudyOptions& options);

}  // namespace recoil
