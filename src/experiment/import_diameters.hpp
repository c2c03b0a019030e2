#pragma once

#include <optional>
#include <string>

#include "experiment/imported_points.hpp"

namespace recoil {

/// The diameter of a sphere of `series` [m]: that of the file, or of --diameter, or of the name of
/// the series ("2.58 um", "d = 4.9um on Mo"); nothing when nobody says.
std::optional<double> known_diameter(const ImportRequest& request, const std::string& series,
                                     std::optional<double> in_file);

/// Gives every point its diameter and its error.
/// @throws InputError for a point without one, and for a --diameter that no series has.
void settle_diameters(const ImportRequest& request, ImportedPoints& imported);

}  // namespace recoil
