#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/names.hpp"
#include "core/units.hpp"
#include "data/dataset.hpp"
#include "data/json_document.hpp"

namespace recoil {

/// What a column of the points holds.
enum class Quantity {
  series,
  diameter,
  incident_velocity,
  restitution,
  rebound_velocity,
  restitution_sd,
  velocity_sd,
  diameter_sd,
  events,
  captured,
  setting,
  // The conditions, in the order of `Condition`.
  ambient_pressure,
  relative_humidity,
  temperature,
  target_thickness,
  probe_height,
  neutralised,
  surface_rms_roughness,
  velocities_calibrated,
  sizes_calibrated,
};

/// Their names in a schema.
template <>
struct NamesOf<Quantity> {
  static constexpr std::array<std::string_view, 20> names = {"series",
                                                             "diameter",
                                                             "incident_velocity",
                                                             "restitution",
                                                             "rebound_velocity",
                                                             "restitution_sd",
                                                             "velocity_sd",
                                                             "diameter_sd",
                                                             "events",
                                                             "captured",
                                                             "setting",
                                                             "ambient_pressure",
                                                             "relative_humidity",
                                                             "temperature",
                                                             "target_thickness",
                                                             "probe_height",
                                                             "neutralised",
                                                             "surface_rms_roughness",
                                                             "velocities_calibrated",
                                                             "sizes_calibrated"};
};

/// What a quantity measures; a series is a text.
Dimension dimension_of(Quantity quantity);

/// The column of a condition.
Quantity quantity_of(Condition condition);

/// One field of the schema.
struct Column {
  Quantity quantity = Quantity::series;
  std::string name;      ///< as in the header of the CSV file
  std::string unit;      ///< as the schema states it; may be empty for counts, is for series
  double factor = 1.0;   ///< to SI
  bool integer = false;  ///< the schema says so, or the quantity is a count
};

/// `datapackage.json` as read and validated, SI inside.
///
/// The system stands under the key `recoil`: `provenance`, `particle`, `surface`, and directly
/// beside them the optional overrides `stiffness_K` [Pa], `adhesion_energy` [J/m2],
/// `adhesion_force_f0` [N/m] and `reference_diameter` [m] (which the force needs), and
/// `mixed_sizes`, the path of a size distribution over which every point averages. Keys that are
/// not known are refused there and allowed elsewhere, as Frictionless has it.
struct Package {
  std::string id;
  std::string title;
  Provenance provenance = Provenance::measured;
  ImpactSystem system;
  std::string mixed_sizes;     ///< path of the sizes over which every point averages; else empty
  Location mixed_sizes_where;  ///< where it stands
  std::vector<std::string> sources;
  std::string points_path;                  ///< relative, inside the folder
  Location points_where;                    ///< where the path stands
  char delimiter = ',';                     ///< Frictionless `dialect.delimiter`
  std::vector<std::string> missing_values;  ///< cells that mean "not known"; "" always does
  std::vector<Column> columns;
};

/// Reads the text of `datapackage.json`.
/// @param file the name that messages give.
/// @param fallback_id the id when the package has no `name`: its folder's.
/// @throws InputError with the line and column of the first mistake.
Package read_package(const std::string& text, const std::string& file,
                     const std::string& fallback_id);

/// The resource of a package whose `path` is this, if there is one.
std::optional<JsonNode> find_resource(const JsonNode& root, const std::string& path);

/// The units that the fields of a resource state: field -> unit.
std::map<std::string, std::string> field_units(const JsonNode& resource);

}  // namespace recoil
