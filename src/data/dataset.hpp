#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/names.hpp"
#include "data/material.hpp"
#include "data/measured_sizes.hpp"

namespace recoil {

/// Where points come from. It travels with everything computed from them.
enum class Provenance { measured, digitised, reconstruction, synthetic };

/// The words used in files and on the screen.
template <>
struct NamesOf<Provenance> {
  static constexpr std::array<std::string_view, 4> names = {"measured", "digitised",
                                                            "reconstruction", "synthetic"};
};

/// One measured point: the mean restitution of `events` impacts at one velocity and diameter, or a
/// point at which the spheres were captured.
struct ImpactPoint {
  std::size_t series = 0;          ///< index into Dataset::series
  double diameter = 0.0;           ///< [m]
  double incident_velocity = 0.0;  ///< V [m/s], > 0
  double restitution = 0.0;        ///< e = V_rebound / V [1], 0 <= e <= 1.2; 0 when all captured
  std::optional<double> restitution_sd;  ///< one standard deviation of `restitution` [1]
  std::optional<double> velocity_sd;     ///< one standard deviation of `incident_velocity` [m/s]
  std::optional<double> diameter_sd;     ///< one standard deviation of `diameter` [m]
  int events = 1;                        ///< impacts averaged in this point, captured ones included
  int captured = 0;                      ///< how many of them did not rebound
  bool counted = false;                  ///< `captured` is stated: 0 is a count, not a gap
  /// Points of one setting of the apparatus share its error. Empty where no column says so: then
  /// points of one series, diameter and incident velocity have one setting.
  std::string setting;
  int line = 0;  ///< line in points.csv, for messages

  bool all_captured() const { return captured >= events; }
};

/// A column of the points as the file has it, before conversion.
struct DataColumn {
  std::string name;
  std::string unit;  ///< "um"; empty for text
};

/// What is unusual about a point that is kept all the same.
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
  std::vector<Conditions> series_conditions;  ///< that the points of each series state themselves
  std::vector<ImpactPoint> points;            ///< in file order
  std::vector<DataColumn> columns;            ///< as the schema lists them
  /// Of the spheres over which every point averages, where the dataset says that its points do: a
  /// point's diameter is then the mean of them.
  std::optional<MeasuredSizes> mixed_sizes;
  std::vector<std::string> sources;      ///< one line each: title and address
  std::vector<DatasetWarning> warnings;  ///< by remark, those that there are
  std::string sha256;  ///< of datapackage.json, the points and mixed_sizes, as hexadecimal
  std::filesystem::path folder;
};

/// The conditions of a series: its own, and of what it leaves open those of all points.
Conditions conditions_of(const Dataset& dataset, std::size_t series);

/// The distinct diameters of the points [m], ascending.
std::vector<double> distinct_diameters(const Dataset& dataset);

/// Reads and validates `folder`: `datapackage.json` (Frictionless Data Package) and the CSV
/// resource that it names. Units are converted here, once. Every mistake throws.
/// @throws InputError with file, line and column of the first mistake.
Dataset load_dataset(const std::filesystem::path& folder);

/// The same from texts instead of files: `datapackage_text` as it would stand in
/// `folder/datapackage.json`, `csv_text` as in the resource that it names. No file is touched, and
/// mixed_sizes are left out.
/// @throws InputError as `load_dataset` does.
Dataset parse_dataset(const std::string& datapackage_text, const std::string& csv_text,
                      const std::filesystem::path& folder);

/// A sentence for each reconstruction among `datasets`: its recipe made the points, and what is
/// found in them was put there.
std::vector<std::string> reconstruction_remarks(const std::vector<Dataset>& datasets);

}  // namespace recoil
