#pragma once

#include <optional>
#include <string>

#include "core/json.hpp"
#include "experiment/flight.hpp"
#include "experiment/import_table.hpp"

namespace recoil {

/// A sphere's mass density [kg/m3], 0 when it is not known, and the surrounding air.
struct SphereInAir {
  Air air;
  double density = 0.0;
};

/// Is there air with an effect? Below 1e-3 Pa even the smallest sphere is not slowed down.
bool air_acts(const Air& air);

/// Drop height h1 and rebound height h2. In vacuum e = sqrt(h2 / h1), V = sqrt(2 g h1); in air V is
/// the end of the fall and e V the launch that rises to h2 (see AirFlight).
/// sd(e) = (e/2) sqrt((s1/h1)^2 + (s2/h2)^2), sd(V) = (V/2) s1/h1. Where several points come from
/// one height, its error is shared: setting_velocity_sd = (V/2) s1/h1 and sd(e) = (e/2) s2/h2. With
/// `average`, drops from the same height make one point: the mean e, its standard error from their
/// scatter, and s1 once. A rebound height of zero, or an e below `captured_below`, is a capture,
/// and in no mean.
ImportedPoints read_heights(const ImportRequest& request, const SphereInAir& sphere);

/// Flights of duration t between bounces. In vacuum a ball that leaves with v returns after t = 2 v
/// / g and hits with v again, so that V = g t_i / 2 and e = t_{i+1} / t_i at the bounce between
/// them. In air it leaves with the u_i that takes t_i and hits with less, w_i: V = w_i, e = u_{i+1}
/// / w_i. With an error tau of the time of one bounce
///   sd(e) = (tau / t_i) sqrt(1 + e + e^2) sqrt(2),   sd(V) = g tau / sqrt(2)
/// of the vacuum values; the relative errors are the same in air.
/// A cell that is empty splits the launch. The bounce after a stated release height h is a point,
/// V = sqrt(2 g h) in vacuum, e = g t_1 / (2 V), unless the first two flights show that bounces
/// before them are not listed; h is compared with the height that they imply.
ImportedPoints read_intervals(const ImportRequest& request, const SphereInAir& sphere);

/// WebPlotDigitizer's CSV: names of the series in the first line, each over two columns, X and Y in
/// the second; or, for one series, two columns of numbers without a header. With `axes` and
/// `reading_error` f (part of an axis), the standard deviations are
///   f (max - min) on a linear axis,   V f ln(max / min) on a logarithmic one.
ImportedPoints read_digitised(const ImportRequest& request);

/// Heights of one or several balls over time, as video analysis writes them: `time` or `frame`
/// (with --fps), `height` or `pixel` (with --scale, the length of a pixel; without it the fall
/// itself is the scale, g over the measured acceleration).
///
/// Impacts are the minima that stand out of the noise. The flights between them are fitted together
/// by least squares,
///   y = c_k + b_k (t - t_k) - a (t - t_k)^2 / 2,
/// with one a for each ball, without the sample at the minimum, which may lie on either side. Two
/// flights meet at the impact; e = -v_after / v_before and V = -v_before there. The errors follow
/// from the scatter about the parabolas and the covariance of c, b and a. Drag of the air is not
/// taken out.
ImportedPoints read_track(const ImportRequest& request);

/// datapackage.json of the folder whose points are to be replaced.
struct ExistingPackage {
  Json json;
  Provenance provenance = Provenance::measured;
  std::string points_path;
  FieldUnits units;  ///< of its columns
};

/// nullopt when the folder has none. @throws InputError when it is not valid.
std::optional<ExistingPackage> existing_package(const std::filesystem::path& folder);

/// points.csv: um (or mm from a millimetre on), m/s; only columns with a value.
struct PointsText {
  std::string csv;
  Json fields;  ///< of the schema
};
PointsText points_text(const std::vector<ImportedPoint>& points);

/// The object under the key `recoil` of the new datapackage.json: provenance, materials and the
/// overrides that do not contradict them, conditions. Flights are through air of 101325 Pa and 293
/// K unless the request or the replaced package states other conditions.
/// @throws InputError that names the option for a missing material or provenance.
Json imported_system(const ImportRequest& request, const std::optional<ExistingPackage>& existing,
                     std::vector<ImportNote>& notes);

/// The sphere and the air that `system` states.
SphereInAir sphere_in_air(const Json& system);

/// datapackage.json.
std::string imported_package(const ImportRequest& request, const Json& system,
                             const PointsText& points,
                             const std::optional<ExistingPackage>& existing,
                             std::vector<ImportNote>& notes);

}  // namespace recoil
