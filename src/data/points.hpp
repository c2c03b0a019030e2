#pragma once

#include <string>
#include <string_view>

#include "data/datapackage.hpp"
#include "data/dataset.hpp"

namespace recoil {

/// Reads the points of `package` from the text of its CSV file into `dataset` (series, points and
/// warnings), converting units.
///
/// The mean restitution of a point is that of the events that rebounded; where all `events` were
/// captured it is 0 or an empty cell. With `rebound_velocity`, e = rebound / incident.
///
/// @param file the name that messages give.
/// @throws InputError with the line and column of the first mistake.
void read_points(std::string_view text, const std::string& file, const Package& package,
                 Dataset& dataset);

}  // namespace recoil
