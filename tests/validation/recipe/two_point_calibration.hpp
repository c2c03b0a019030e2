#pragma once

#include <string>

#include "validation/truth/truth.hpp"

namespace recoil {

/// The paper's two-point calibration of the ring-adhesion model, by the truth simulator: what facts
/// of the kind "the ring-adhesion model runs slightly low at 2.58 um" are checked with.
struct TwoPointCalibration {
  bool found = false;
  RingAdhesionTruth model;  ///< with the calibrated C_H and C_A
  std::string why;          ///< when there is no answer
};

struct CalibrationPoint {
  double velocity = 0.0;     ///< [m/s]
  double restitution = 0.0;  ///< [1]
};

/// C_H from `high` (C_A = 0 at first), C_A from `low`, in turn until both stand still
/// (Li, Dunn & Brach 1999, section 4).
TwoPointCalibration calibrate_by_two_points(RingAdhesionTruth model, double diameter,
                                            const CalibrationPoint& low,
                                            const CalibrationPoint& high);

}  // namespace recoil
