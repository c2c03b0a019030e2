#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "experiment/imported_points.hpp"

/// The two files of an imported dataset.
namespace recoil {

/// datapackage.json of the folder that is to be replaced.
struct ExistingPackage {
  nlohmann::ordered_json json;
  Provenance provenance = Provenance::measured;
  std::string points_path;
  std::vector<std::string> map;  ///< its columns as entries of --map
};

/// @throws InputError when it is there and not valid.
std::optional<ExistingPackage> existing_package(const std::filesystem::path& folder);

/// points.csv: um (or mm from a millimetre on), m/s; only columns with a value.
struct PointsText {
  std::string csv;
  nlohmann::ordered_json fields;  ///< of the schema
};
PointsText points_text(const std::vector<ImportedPoint>& points);

/// datapackage.json.
/// @throws InputError that names the option for a material or provenance that nobody stated.
std::string imported_package(const ImportRequest& request, const PointsText& points,
                             const std::optional<ExistingPackage>& existing,
                             std::vector<ImportNote>& notes);

}  // namespace recoil
