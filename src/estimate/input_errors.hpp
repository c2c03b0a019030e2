#pragma once

#include "estimate/error_source.hpp"

namespace recoil {

// Stated errors of the inputs of a point.

/// `velocity_sd` [m/s], independent from point to point.
const ErrorSource& velocity_error();
/// `setting_velocity_sd` [m/s], shared by the points of a setting.
const ErrorSource& setting_velocity_error();
/// `diameter_sd` [m], independent from point to point.
const ErrorSource& diameter_error();
/// `series_diameter_sd` [m], shared by the points of a series.
const ErrorSource& series_diameter_error();

}  // namespace recoil
