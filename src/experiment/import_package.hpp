#pragma once

#include <optional>
#include <string>

#include "core/json.hpp"
#include "experiment/import_flights.hpp"

/// The two files of an imported dataset.
namespace recoil {

/// datapackage.json of the folder whose points are to be replaced.
struct ExistingPackage {
  Json json;
  Provenance provenance = Provenance::measured;
  std::string points_path;
  std::vector<std::string> map;  ///< its columns as entries of --map
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
