#pragma once

#include <optional>
#include <string>

#include "core/json.hpp"
#include "experiment/import_flights.hpp"
#include "experiment/imported_points.hpp"

/// The two files of an imported dataset.
namespace recoil {

/// datapackage.json of the folder that is to be replaced.
struct ExistingPackage {
  Json json;
  Provenance provenance = Provenance::measured;
  std::string points_path;
  std::vector<std::string> map;  ///< its columns as entries of --map
};

/// @throws InputError when it is there and not valid.
std::optional<ExistingPackage> existing_package(const std::filesystem::path& folder);

/// points.csv: um (or mm from a millimetre on), m/s; only columns with a value.
struct PointsText {
  std::string csv;
  Json fields;  ///< of the schema
};
PointsText points_text(const std::vector<ImportedPoint>& points);

/// What stands under the key `recoil` of the new datapackage.json: provenance, materials and the
/// overrides that do not contradict them, conditions. Flights are through air of 101325 Pa and 293
/// K unless the request or the package that is replaced say otherwise.
/// @throws InputError that names the option for a material or provenance that nobody stated.
Json imported_system(const ImportRequest& request, const std::optional<ExistingPackage>& existing,
                     std::vector<ImportNote>& notes);

/// What the readers of flights need of it.
SphereInAir sphere_in_air(const Json& system);

/// datapackage.json.
std::string imported_package(const ImportRequest& request, const Json& system,
                             const PointsText& points,
                             const std::optional<ExistingPackage>& existing,
                             std::vector<ImportNote>& notes);

}  // namespace recoil
