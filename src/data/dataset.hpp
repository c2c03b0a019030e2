#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "data/measured_sizes.hpp"
#include "data/system.hpp"

namespace recoil {

// Names of files in a dataset's folder.
inline constexpr const char* package_file_name = "datapackage.json";
/// The recipe of a reconstruction, and its name after an import has replaced its points.
inline constexpr const char* recipe_name = "recipe.toml";
inline constexpr const char* set_aside_recipe_name = "recipe-set-aside.toml";

/// One measured point: the mean restitution of `events` impacts at one velocity and diameter, or a
/// point at which the spheres were captured. One member for each column of the points.
struct ImpactPoint {
  std::size_t series = 0;  ///< index into Dataset::series
  double diameter = 0.0;   ///< [m]
  /// V [m/s], > 0: the component along the normal, V_n = (stated speed) cos(incidence_angle).
  double incident_velocity = 0.0;
  double incidence_angle = 0.0;  ///< from the normal [rad], below pi / 2; 0 unless stated
  /// e = V_rebound / V [1] of the normal components, 0 <= e <= 1.2; 0 when all captured
  double restitution = 0.0;
  /// e_t = V_t,rebound / V_t of the tangential components [1]; only at an angle above 0
  std::optional<double> tangential_restitution;
  std::optional<double> restitution_sd;  ///< one standard deviation of `restitution` [1]
  std::optional<double> velocity_sd;     ///< one standard deviation of `incident_velocity` [m/s]
  /// One standard deviation of an error of `incident_velocity` that all points of its setting share
  /// [m/s]; e, a ratio to this velocity, shares it.
  std::optional<double> setting_velocity_sd;
  std::optional<double> diameter_sd;  ///< one standard deviation of `diameter` [m]
  /// One standard deviation of an error of `diameter` that all points of its series share [m].
  std::optional<double> series_diameter_sd;
  int events = 1;            ///< impacts averaged in this point, captured ones included
  int captured = 0;          ///< how many of them did not rebound; all if e is 0 and none is stated
  bool counted = false;      ///< `captured` is stated: 0 is a count, not unknown
  bool counts_only = false;  ///< the number of rebounds is known, their velocity is not
  /// Points with the same setting of the apparatus share its error. Empty without such a column:
  /// points with equal series, diameter and incident velocity then share a setting.
  std::string setting;
  /// Successive rows of one launch are successive bounces, and share the times of bounces with
  /// their errors. Empty: the errors of e are independent.
  std::string launch;
  int line = 0;  ///< line in points.csv, for messages

  bool all_captured() const { return captured >= events; }
};

/// A column of the points as the file has it, before conversion.
struct DataColumn {
  std::string name;
  std::string unit;  ///< "um"; empty for text
};

/// Something unusual about a point, which is kept.
enum class PointRemark {
  restitution_above_one,
  unmarked_zero,  ///< e = 0 without `captured`: all its impacts count as captured
  unusual_diameter,
  oblique,  ///< farther from the normal than Li, Dunn & Brach (1999) allowed
  repeated,
  error_above_velocity,  ///< one standard deviation of a velocity is larger than the velocity
  tiny_restitution,      ///< no e of the dataset is above 0.02
  other_bytes,           ///< the file has not the size or hash that datapackage.json states
};

/// All points with the same remark.
struct DatasetWarning {
  PointRemark remark = PointRemark::restitution_above_one;
  std::size_t count = 0;
  int first_line = 0;    ///< in points.csv
  double largest = 0.0;  ///< angle of the oblique points [rad]
};

/// A dataset folder as read, in SI units.
struct Dataset {
  std::string id;     ///< the package's name
  std::string title;  ///< for people
  Provenance provenance = Provenance::measured;
  ImpactSystem system;
  /// Names, in order of appearance. Points that have the same series in the file but different
  /// conditions have different series here.
  std::vector<std::string> series;
  std::vector<Conditions> series_conditions;  ///< as the points of each series state them
  std::vector<ImpactPoint> points;            ///< in file order
  std::vector<DataColumn> columns;            ///< as the schema lists them
  /// The sizes over which every point averages, if stated. The diameter of a point is their mean.
  std::optional<MeasuredSizes> mixed_sizes;
  std::vector<std::string> sources;      ///< one line each: title and address
  std::vector<DatasetWarning> warnings;  ///< in the order of PointRemark
  std::string sha256;  ///< of datapackage.json, the points and mixed_sizes, as hexadecimal
  std::filesystem::path folder;
};

/// The conditions of a series, and those of the whole dataset where it states none.
Conditions conditions_of(const Dataset& dataset, std::size_t series);

/// The distinct diameters of the points [m], ascending.
std::vector<double> distinct_diameters(const Dataset& dataset);

/// The last part of a path, also for "datasets/mica/"; "dataset" if it is empty, "." or "..".
std::string name_of_folder(const std::filesystem::path& folder);

/// Reads and validates a dataset: `datapackage.json` (Frictionless Data Package) and the CSV
/// resource that it names. All units are converted to SI here.
///
/// The restitution of a point is the mean over the events that rebounded. If all `events` were
/// captured it is 0 or an empty cell, and a 0 without `captured` means that. With
/// `rebound_velocity`, e = rebound / incident. With `incidence_angle`, `incident_velocity` is the
/// speed of the sphere: it and its errors are multiplied by the cosine here, and nowhere else.
/// @throws InputError with file, line and column of the first mistake
Dataset load_dataset(const std::filesystem::path& folder);

/// Reads a dataset that may have no points yet. If the CSV resource is missing or has only a
/// header, the dataset has no points, and its checksum is that of the package.
/// @throws InputError as `load_dataset`
Dataset load_dataset_to_be_measured(const std::filesystem::path& folder);

/// Like `load_dataset`, from the texts of `folder/datapackage.json` and of its CSV resource. It
/// reads no file, and no mixed_sizes.
/// @throws InputError as `load_dataset`
Dataset parse_dataset(const std::string& datapackage_text, const std::string& csv_text,
                      const std::filesystem::path& folder);

/// The checksum of a dataset with these texts.
std::string checksum_of(const std::string& datapackage_text, const std::string& csv_text);

/// For each reconstruction among `datasets`, a sentence that its points are computed from a recipe.
std::vector<std::string> reconstruction_remarks(const std::vector<Dataset>& datasets);

}  // namespace recoil
