#include "experiment/import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/files.hpp"
#include "data/dataset.hpp"
#include "data/text.hpp"
#include "experiment/import_columns.hpp"
#include "experiment/import_diameters.hpp"
#include "experiment/import_digitised.hpp"
#include "experiment/import_flights.hpp"
#include "experiment/import_package.hpp"
#include "experiment/option_values.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

ImportedPoints read_points_of(const ImportRequest& request, const Json& system,
                              const std::vector<std::string>& package_map) {
  switch (request.format) {
    case ImportFormat::webplotdigitizer:
      return read_digitised(request);
    case ImportFormat::heights:
      return read_heights(request, sphere_in_air(system));
    case ImportFormat::intervals:
      return read_intervals(request, sphere_in_air(system));
    case ImportFormat::csv:
      break;
  }
  return read_columns(request, package_map);
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
      "import points of an experiment, or give --provenance synthetic");
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
  read_text_file(request.file);  // a missing file is complained of before anything is asked for
  const auto existing =
      request.replace ? existing_package(request.into) : std::optional<ExistingPackage>();
  ImportResult result;
  const Json system = imported_system(request, existing, result.notes);
  ImportedPoints imported =
      read_points_of(request, system, existing ? existing->map : std::vector<std::string>());
  settle_diameters(request, imported);
  add_scatter(request, imported.points);

  result.notes.insert(result.notes.begin(), imported.notes.begin(), imported.notes.end());
  const PointsText points = points_text(imported.points);
  const std::string package = imported_package(request, system, points, existing, result.notes);
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
  write_whole_files({{points_file, points.csv}, {request.into / package_file_name, package}});
  set_recipe_aside(request.into, result.notes);
  return result;
}

}  // namespace recoil
