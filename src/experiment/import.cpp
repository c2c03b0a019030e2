#include "experiment/import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "core/error.hpp"
#include "core/files.hpp"
#include "data/folder_names.hpp"
#include "data/text.hpp"
#include "experiment/import_columns.hpp"
#include "experiment/import_digitised.hpp"
#include "experiment/import_flights.hpp"
#include "experiment/import_package.hpp"
#include "experiment/option_values.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

ImportedPoints read_points_of(const ImportRequest& request,
                              const std::vector<std::string>& package_map) {
  switch (request.format) {
    case ImportFormat::webplotdigitizer:
      return read_digitised(request);
    case ImportFormat::heights:
      return read_heights(request);
    case ImportFormat::intervals:
      return read_intervals(request);
    case ImportFormat::csv:
      break;
  }
  return read_columns(request, package_map);
}

/// The diameter that --diameter states for a series.
std::optional<double> stated_diameter(const ImportRequest& request, const std::string& series) {
  std::optional<double> found;
  for (const std::string& word : request.diameters) {
    const auto pair = split_pair(word);
    if (pair && pair->first != series) continue;
    const double value =
        value_with_unit(pair ? pair->second : word, Dimension::length, "--diameter");
    if (pair) return value;
    found = value;
  }
  return found;
}

/// A diameter in the name of a series: "2.58 um", "d = 4.9um on Mo".
std::optional<double> diameter_in_name(const std::string& series) {
  static const std::regex pattern(
      R"re((^|[^0-9.])([0-9]+\.?[0-9]*)\s*(nm|um|µm|mm)($|[^a-zA-Z]))re");
  std::smatch match;
  if (!std::regex_search(series, match, pattern)) return std::nullopt;
  const auto number = parse_number(match[2].str());
  const auto factor = unit_factor(Dimension::length, match[3].str());
  return number && factor ? std::optional<double>(*number * *factor) : std::nullopt;
}

void settle_diameters(const ImportRequest& request, ImportedPoints& imported) {
  const StatedError error =
      stated_error(request.diameter_error, Dimension::length, "--diameter-error");
  std::vector<std::string> named;
  std::vector<std::string> series;
  bool asked = request.diameters.empty();
  for (const std::string& word : request.diameters) {  // also those that nothing will need
    const auto pair = split_pair(word);
    value_with_unit(pair ? pair->second : word, Dimension::length, "--diameter");
  }
  for (ImportedPoint& point : imported.points) {
    if (std::find(series.begin(), series.end(), point.series) == series.end()) {
      series.push_back(point.series);
    }
    asked = asked || !point.diameter;
    if (!point.diameter) point.diameter = stated_diameter(request, point.series);
    if (!point.diameter) {
      point.diameter = diameter_in_name(point.series);
      if (point.diameter && std::find(named.begin(), named.end(), point.series) == named.end()) {
        named.push_back(point.series);
      }
    }
    if (!point.diameter) {
      throw InputError({request.file.string(), point.line, 1},
                       fmt::format("the diameter of series {} is not known", quote(point.series)),
                       "", "give --diameter 4.9um, or --diameter \"SERIES=4.9um\" for each series");
    }
    if (error.stated() && !point.diameter_sd) point.diameter_sd = error.of(*point.diameter);
  }
  for (const std::string& word : request.diameters) {
    const auto pair = split_pair(word);
    if (!pair || std::find(series.begin(), series.end(), pair->first) != series.end()) continue;
    throw InputError({}, fmt::format("--diameter {}: there is no such series", quote(word)), "",
                     did_you_mean(pair->first, series));
  }
  if (!asked) {
    imported.notes.push_back({ImportRemark::diameter_not_used});
  }
  if (!named.empty()) {
    imported.notes.push_back({ImportRemark::diameters_from_names, named});
  }
}

/// The scatter of the experiment on top of what the readings contribute.
void add_scatter(const ImportRequest& request, std::vector<ImportedPoint>& points) {
  const StatedError scatter = stated_error(request.scatter, Dimension::ratio, "--scatter");
  if (!scatter.stated()) return;
  for (ImportedPoint& point : points) {
    if (!point.restitution && !point.rebound_velocity) continue;
    const double e =
        point.restitution ? *point.restitution : *point.rebound_velocity / point.velocity;
    const double sd = std::hypot(point.restitution_sd.value_or(0.0), scatter.of(e));
    if (sd > 0.0) point.restitution_sd = sd;
  }
}

/// Messages of the dataset reader speak of files that nobody has seen yet: points at the line of
/// the imported file from which a point came.
[[noreturn]] void blame_the_source(const InputError& error, const ImportRequest& request,
                                   const fs::path& points_file,
                                   const std::vector<ImportedPoint>& points) {
  const Location& at = error.where();
  // Nothing in the file is to blame for a material.
  Location place{at.file == points_file.string() ? request.file.string() : std::string()};
  const auto row = static_cast<std::size_t>(at.line) - 2;
  if (at.file == points_file.string() && at.line >= 2 && row < points.size()) {
    place.line = points[row].line;
    place.column = 1;
  }
  throw InputError(place, error.problem(), error.why(), error.suggestion());
}

void require_free(const ImportRequest& request) {
  std::error_code failed;
  if (fs::exists(request.into, failed) && !fs::is_directory(request.into, failed)) {
    throw InputError({request.into.string()}, "this is a file, not a folder",
                     "a dataset is a folder", "choose another --into");
  }
  if (request.replace) return;
  for (const char* name : {package_file_name, "points.csv"}) {
    if (!fs::exists(request.into / name, failed)) continue;
    throw InputError({(request.into / name).string()}, "there is a dataset here already", "",
                     "add --replace to replace its points, or choose another --into");
  }
}

/// Points that a recipe made do not become digitised by being imported.
void refuse_reconstructed_points(const ImportRequest& request, const Dataset& imported) {
  const Dataset before = load_dataset(request.into);
  const auto known = [&](const ImpactPoint& point) {
    return std::any_of(before.points.begin(), before.points.end(), [&](const ImpactPoint& old) {
      return std::abs(old.incident_velocity / point.incident_velocity - 1.0) < 1e-9 &&
             std::abs(old.restitution - point.restitution) < 1e-9 &&
             std::abs(old.diameter / point.diameter - 1.0) < 1e-9;
    });
  };
  const auto same = std::count_if(imported.points.begin(), imported.points.end(), known);
  if (2 * static_cast<std::size_t>(same) <= imported.points.size()) return;
  throw InputError(
      {request.file.string()},
      fmt::format("{} of {} points are those of the reconstruction", same, imported.points.size()),
      "a recipe made them; nobody measured or digitised them",
      "import points of an experiment, or --provenance synthetic");
}

/// Keeps the recipe of a former reconstruction where nothing takes it for the folder's.
void set_recipe_aside(const fs::path& folder, std::vector<ImportNote>& notes) {
  std::error_code failed;
  if (!fs::exists(folder / recipe_name, failed)) return;
  fs::rename(folder / recipe_name, folder / set_aside_recipe_name, failed);
  if (failed) {
    throw InputError({(folder / recipe_name).string()}, "the recipe cannot be renamed",
                     failed.message(), "rename it by hand, since the points are no longer its own");
  }
  notes.push_back({ImportRemark::recipe_set_aside});
}

}  // namespace

ImportResult import_points(const ImportRequest& request) {
  require_free(request);
  const auto existing =
      request.replace ? existing_package(request.into) : std::optional<ExistingPackage>();
  ImportedPoints imported =
      read_points_of(request, existing ? existing->map : std::vector<std::string>());
  settle_diameters(request, imported);
  add_scatter(request, imported.points);

  ImportResult result;
  result.notes = std::move(imported.notes);
  const PointsText points = points_text(imported.points);
  const std::string package = imported_package(request, points, existing, result.notes);
  const fs::path points_file = request.into / (existing ? existing->points_path : "points.csv");
  try {
    result.dataset = parse_dataset(package, points.csv, request.into);
  } catch (const InputError& error) {
    blame_the_source(error, request, points_file, imported.points);
  }
  if (existing && existing->provenance == Provenance::reconstruction &&
      result.dataset.provenance != Provenance::synthetic) {
    refuse_reconstructed_points(request, result.dataset);
  }
  // Should the run be cut short in between, new points stand under the old label, which claims no
  // more than they are; without a package the folder is no dataset yet.
  require_writable_folder(request.into);
  write_whole_file(points_file, points.csv);
  write_whole_file(request.into / package_file_name, package);
  set_recipe_aside(request.into, result.notes);
  return result;
}

}  // namespace recoil
