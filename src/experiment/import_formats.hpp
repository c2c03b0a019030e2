#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/json.hpp"
#include "experiment/flight.hpp"
#include "experiment/import_table.hpp"

namespace recoil {

/// A sphere's density [kg/m3], 0 if unknown, and the surrounding air.
struct SphereInAir {
  Air air;
  double density = 0.0;
};

/// True unless the air is too thin to slow down even the smallest sphere, below 1e-3 Pa.
bool air_acts(const Air& air);

/// Computes the flights of the spheres of one import, and records the effect of air on e.
class Flights {
 public:
  Flights(const ImportRequest& request, const SphereInAir& sphere)
      : request_(request), sphere_(sphere) {}

  double gravity() const { return request_.gravity; }  ///< [m/s2]

  /// The flight of a sphere of `series` in air. nullopt in vacuum, and if size, density or air are
  /// unknown or impossible (the dataset is then refused later).
  std::optional<AirFlight> in_air(const std::string& series,
                                  const std::optional<double>& diameter_in_file) const;
  /// `air.fall(height).speed` and `air.launch_for_height(height)`, once for each height.
  double speed_after_fall(const AirFlight& air, double height);
  double launch_for_height(const AirFlight& air, double height);

  /// Records the effect of air on one point. @param in_vacuum e if air drag is neglected
  /// @throws InputError at the cell of `quantity` if only the drag makes e impossible
  void note_drag(const ImportTable& table, std::size_t row, const std::string& quantity,
                 const AirFlight& air, double velocity, double e, double in_vacuum);

  void add_notes(std::vector<ImportNote>& notes) const;

 private:
  const ImportRequest& request_;
  SphereInAir sphere_;
  bool any_ = false;
  AirShare share_;
  /// By series and diameter in the file.
  mutable std::map<std::pair<std::string, std::optional<double>>, std::optional<AirFlight>> known_;
  std::map<std::pair<AirFlight, double>, double> falls_, launches_;  // by height
};

/// Reads drop heights h1 and rebound heights h2. In vacuum e = sqrt(h2 / h1), V = sqrt(2 g h1). In
/// air V is the speed at the end of the fall, and e V is the launch speed that reaches h2 (see
/// AirFlight). The errors are sd(e) = (e/2) sqrt((s1/h1)^2 + (s2/h2)^2) and sd(V) = (V/2) s1/h1. If
/// several points have one height, they share its error: setting_velocity_sd = (V/2) s1/h1 and
/// sd(e) = (e/2) s2/h2. With `average`, drops from one height make one point with the mean e, its
/// standard error from their scatter, and s1 once. A rebound height of zero, or an e below
/// `captured_below`, is a capture and enters no mean.
ImportedPoints read_heights(const ImportRequest& request, const SphereInAir& sphere);

/// Reads durations t of flights between bounces. In vacuum a ball that leaves with v returns after
/// t = 2 v / g with the same speed, so that V = g t_i / 2 and e = t_{i+1} / t_i at the bounce
/// between two flights. In air it leaves with u_i, which follows from t_i, and returns with a lower
/// speed w_i: V = w_i, e = u_{i+1} / w_i. With an error tau of the time of one bounce,
///   sd(e) = (tau / t_i) sqrt(1 + e + e^2) sqrt(2),   sd(V) = g tau / sqrt(2)
/// in vacuum; the relative errors are the same in air.
/// An empty cell splits the launch. The bounce after a stated release height h is a point, too,
/// with V = sqrt(2 g h) in vacuum and e = g t_1 / (2 V), unless the first two flights show that
/// earlier bounces are not listed. h is compared with the height that these flights imply.
ImportedPoints read_intervals(const ImportRequest& request, const SphereInAir& sphere);

/// Reads drop heights h and times T from the release until rest. If all impacts have one e, in
/// vacuum
///   e = (T - t) / (T + t),   t = sqrt(2 h / g),   V = g t,
///   sd(e) = 2 sqrt((t sd(T))^2 + (T sd(t))^2) / (T + t)^2.
/// In air e is the one whose flights take this time. V is that of the first impact.
ImportedPoints read_rest(const ImportRequest& request, const SphereInAir& sphere);

/// Reads heights of successive tops of a launch, of which the first may be the release: e and V of
/// the impact between two of them are those of a drop height and a rebound height (`read_heights`).
/// An empty cell splits the launch. Two points share the error of the height between them; their
/// errors are given as if independent.
ImportedPoints read_tops(const ImportRequest& request, const SphereInAir& sphere);

/// Reads times T_1, T_2 of successive blocks of n_1, n_2 flights of a launch. If all impacts have
/// one e, in vacuum
///   T_2 / T_1 = e^n_1 (1 - e^n_2) / (1 - e^n_1), which is e^n for equal n.
/// In air e is the one whose flights take these times. V is that of the impact between the blocks.
/// The errors follow from those of the three instants at the ends of the blocks; errors of
/// successive points, which share instants, are given as if independent.
ImportedPoints read_blocks(const ImportRequest& request, const SphereInAir& sphere);

/// Reads WebPlotDigitizer's CSV: the names of the series in the first line, each over two columns,
/// with X and Y in the second; or, for one series, two columns of numbers without a header. With
/// `axes` and `reading_error` f (part of an axis), the standard deviations are
///   f (max - min) on a linear axis,   V f ln(max / min) on a logarithmic one.
ImportedPoints read_digitised(const ImportRequest& request);

/// Reads heights of one or several balls over time, as from video analysis: `time` or `frame` (with
/// --fps; without either, a row is a frame), `height` or `pixel` (with --scale, the length of a
/// pixel; without it the scale follows from the acceleration of the fall, which is g). `launch`
/// tells the tracks of one series apart.
///
/// Impacts are the minima above the noise. The flights between them are fitted by least squares,
///   y = c_k + b_k (t - t_k) - a (t - t_k)^2 / 2 + d_k(t),
/// with one a for each ball, without the sample at the minimum, which may belong to either flight.
/// d_k is what the drag of air (see AirFlight) adds to the height of a ball that passes t_k with
/// b_k: zero in vacuum, otherwise integrated by Runge-Kutta steps and iterated until it is that of
/// the fit. Two flights intersect at the impact, where e = -v_after / v_before and V = -v_before.
/// The errors follow from the scatter about the flights and the covariance of c, b and a.
///
/// A frame that shows the height of the frame before it again is left out if the film repeats
/// frames in fast motion, where whole pixels cannot. Heights are taken as downward if their second
/// differences are mostly positive.
ImportedPoints read_track(const ImportRequest& request, const SphereInAir& sphere);

struct ImportPart;

/// Reads the parts of a request, which are launches if there are several.
/// @param system as `imported_system` makes it
/// @param units of the columns of the replaced dataset
ImportedPoints read_parts(const std::vector<ImportPart>& parts, const Json& system,
                          const FieldUnits& units);

/// The datapackage.json of the folder whose points are to be replaced.
struct ExistingPackage {
  Json json;
  Provenance provenance = Provenance::measured;
  std::string points_path;
  FieldUnits units;  ///< of its columns
};

/// nullopt if the folder has no package. @throws InputError if the package is not valid
std::optional<ExistingPackage> existing_package(const std::filesystem::path& folder);

/// The text of points.csv, with the columns that have a value. Diameters are in um, or in mm if all
/// are at least 1 mm; velocities are in m/s, angles in degrees.
struct PointsText {
  std::string csv;
  Json fields;  ///< of the schema
};
PointsText points_text(const std::vector<ImportedPoint>& points);

/// The units in which `points_text` would write lengths below 1 mm and all other quantities. Angles
/// have none: radians and degrees are both usual.
FieldUnits usual_units();

/// The object under the key `recoil` of the new datapackage.json: provenance, materials, overrides
/// that do not contradict them, and conditions. Flights are through air at 101325 Pa and 293 K,
/// unless the request or the replaced package states other conditions.
/// @throws InputError for a missing material or provenance, with the option that states it
Json imported_system(const ImportRequest& request, const std::optional<ExistingPackage>& existing,
                     std::vector<ImportNote>& notes);

/// The sphere and the air that `system` states.
SphereInAir sphere_in_air(const Json& system);

/// The text of the new datapackage.json.
std::string imported_package(const ImportRequest& request, const Json& system,
                             const PointsText& points,
                             const std::optional<ExistingPackage>& existing,
                             std::vector<ImportNote>& notes);

}  // namespace recoil
