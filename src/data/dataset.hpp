#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "data/measured_sizes.hpp"
#include "data/system.hpp"

namespace recoil {

/// The files of a dataset's folder that more than one stage refers to.
inline constexpr const char* package_file_name = "datapackage.json";
/// The recipe of a reconstruction, and its name after other points replaced its own.
inline constexpr const char* recipe_name = "recipe.toml";
inline constexpr const char* set_aside_recipe_name = "recipe-set-aside.toml";

/// One measured point: the mean restitution of `events` impacts at one velocity and diameter, or a
/// point at which the spheres were captured.
struct ImpactPoint {
  std::size_t series = 0;          ///< index into Dataset::series
  double diameter = 0.0;           ///< [m]
  double incident_velocity = 0.0;  ///< V [m/s], > 0
  double restitution = 0.0;        ///< e = V_rebound / V [1], 0 <= e <= 1.2; 0 when all captured
  std::optional<double> restitution_sd;  ///< one standard deviation of `restitution` [1]
  std::optional<double> velocity_sd;     ///< one standard deviation of `incident_velocity` [m/s]
  /// One standard deviation of an error of `incident_velocity` that all points of its setting share
  /// [m/s]; e, a ratio to this velocity, shares it.
  std::optional<double> setting_velocity_sd;
  std::optional<double> diameter_sd;  ///< one standard deviation of `diameter` [m]
  /// One standard deviation of an error of `diameter` that all points of its series share [m].
  std::optional<double> series_diameter_sd;
  int events = 1;            ///< impacts averaged in this point, captured ones included
  int captured = 0;          ///< how many of them did not rebound
  bool counted = false;      ///< `captured` is stated: 0 is a count, not unknown
  bool counts_only = false;  ///< of its rebounds nothing but their number is known
  /// Points of one setting of the apparatus share its error. Empty without such a column: then
  /// points of one series, diameter and incident velocity have one setting.
  std::string setting;
  /// Successive rows of one launch are successive bounces that were timed at the same instants.
  /// Empty: the errors of e are independent.
  std::string launch;
  int line = 0;  ///< line in points.csv, for messages

  bool all_captured() const { return captured >= events; }
};

/// A column of the points as the file has it, before conversion.
struct DataColumn {
  std::string name;
  std::string unit;  ///< "um"; empty for text
};

/// What is unusual about a point that is kept nevertheless.
enum class PointRemark { restitution_above_one, unmarked_zero, unusual_diameter, repeated };

/// All points of one kind.
struct DatasetWarning {
  PointRemark remark = PointRemark::restitution_above_one;
  std::size_t count = 0;
  int first_line = 0;  ///< in points.csv
};

/// A dataset folder as read, in SI units.
struct Dataset {
  std::string id;     ///< the package's name
  std::string title;  ///< for people
  Provenance provenance = Provenance::measured;
  ImpactSystem system;
  /// Names, in order of appearance. Points of one series in the file that differ in a condition
  /// are of different series here.
  std::vector<std::string> series;
  std::vector<Conditions> series_conditions;  ///< as the points of each series state them
  std::vector<ImpactPoint> points;            ///< in file order
  std::vector<DataColumn> columns;            ///< as the schema lists them
  /// The sizes over which every point averages, if the dataset states them: the diameter of a point
  /// is then their mean.
  std::optional<MeasuredSizes> mixed_sizes;
  std::vector<std::string> sources;      ///< one line each: title and address
  std::vector<DatasetWarning> warnings;  ///< in the order of PointRemark
  std::string sha256;  ///< of datapackage.json, the points and mixed_sizes, as hexadecimal
  std::filesystem::path folder;
};

/// The conditions of a series: its own, completed by those of all points.
Conditions conditions_of(const Dataset& dataset, std::size_t series);

/// The distinct diameters of the points [m], ascending.
std::vector<double> distinct_diameters(const Dataset& dataset);

/// The folder's own name, also for "datasets/mica/" and "."; "dataset" where it has none.
std::string name_of_folder(const std::filesystem::path& folder);

/// Reads and validates `folder`: `datapackage.json` (Frictionless Data Package) and the CSV
/// resource that it names. Units are converted here, once.
///
/// The mean restitution of a point is that of the events that rebounded; where all `events` were
/// captured it is 0 or an empty cell. With `rebound_velocity`, e = rebound / incident.
/// @throws InputError with file, line and column of the first mistake.
Dataset load_dataset(const std::filesystem::path& folder);

/// A dataset folder whose points may not be measured yet: where the CSV resource is missing, or has
/// no line below its header, the dataset has no points, and its checksum is that of the package.
/// @throws InputError as `load_dataset` does.
Dataset load_dataset_to_be_measured(const std::filesystem::path& folder);

/// The same from texts instead of files: `datapackage_text` as it would be in
/// `folder/datapackage.json`, `csv_text` as in the resource that it names. No file is touched, and
/// mixed_sizes are left out.
/// @throws InputError as `load_dataset` does.
Dataset parse_dataset(const std::string& datapackage_text, const std::string& csv_text,
                      const std::filesystem::path& folder);

/// A sentence for each reconstruction among `datasets`: its recipe made the points, and what is
/// found in them was put there.
std::vector<std::string> reconstruction_remarks(const std::vector<Dataset>& datasets);

}  // namespace recoil
