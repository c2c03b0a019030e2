#pragma once

#include <vector>

#include "estimate/error_source.hpp"

namespace recoil {

// Stated errors of the inputs of a point.

/// `velocity_sd` [m/s], independent from point to point.
const ErrorSource& velocity_error();
/// `setting_velocity_sd` [m/s], shared by the points of a setting.
const ErrorSource& setting_velocity_error();
/// `diameter_sd` [m], independent from point to point, of points that are no batch.
const ErrorSource& diameter_error();
/// `series_diameter_sd` [m], shared by the points of a series.
const ErrorSource& series_diameter_error();
/// `diameter_sd` [m] of a batch, shared by the points of one nominal diameter (`find_batches`).
const ErrorSource& batch_diameter_error();

/// Finds the batches: the points of one dataset and diameter, several, that all state the same
/// `diameter_sd` and no `series_diameter_sd`. Nobody measured the sphere of each such point; the
/// nominal diameter has one error, so `diameter_sd` becomes `batch_diameter_sd`. Numbers the sizes.
void find_batches(std::vector<Observation>& points);

}  // namespace recoil
