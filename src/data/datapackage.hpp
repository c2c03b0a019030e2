#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/json.hpp"
#include "core/names.hpp"
#include "core/units.hpp"
#include "data/csv.hpp"
#include "data/json_document.hpp"
#include "data/quantity.hpp"
#include "data/system.hpp"

namespace recoil {

/// The quantity that a column of the points holds.
enum class Quantity {
  series,
  diameter,
  incident_velocity,
  restitution,
  rebound_velocity,
  restitution_sd,
  velocity_sd,
  diameter_sd,
  series_diameter_sd,
  events,
  captured,
  setting,
  setting_velocity_sd,
  launch,
  incidence_angle,
  tangential_restitution,
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
  film_thickness,
  sizes_equal,
};
constexpr auto names_of_values(Quantity) {
  constexpr auto own = name_list(
      "series", "diameter", "incident_velocity", "restitution", "rebound_velocity",
      "restitution_sd", "velocity_sd", "diameter_sd", "series_diameter_sd", "events", "captured",
      "setting", "setting_velocity_sd", "launch", "incidence_angle", "tangential_restitution");
  std::array<std::string_view, own.size() + count_of<Condition>> all{};
  for (std::size_t i = 0; i < own.size(); ++i) all[i] = own[i];
  for (const Condition condition : values_of<Condition>()) {
    all[own.size() + static_cast<std::size_t>(condition)] = name_of(condition);
  }
  return all;
}

/// The dimension of a quantity. Series, setting and launch are texts.
Dimension dimension_of(Quantity quantity);

Quantity quantity_of(Condition condition);

/// A field of the schema.
struct Column {
  Quantity quantity = Quantity::series;
  std::string name;      ///< as in the header of the CSV file
  std::string unit;      ///< as the schema states it; empty for texts, may be empty for counts
  Scale scale;           ///< to SI
  bool integer = false;  ///< the schema says so, or the quantity is a count
  bool boolean = false;  ///< cells are `yes` or `no`
  std::vector<std::string> yes, no;  ///< Table Schema: trueValues, falseValues
  NumberFormat format;
  std::vector<std::string> missing_values;  ///< cells that mean "not known"; "" always does
  bool required = false;                    ///< no cell may be empty
  std::optional<double> minimum, maximum;   ///< of the values, in the unit of the column
};

/// `datapackage.json` (Frictionless Data Package) as read and validated, in SI units.
///
/// The key `recoil` contains the system: `provenance`, `particle`, `surface`, the optional
/// overrides `stiffness_K` [Pa], `adhesion_energy` [J/m2], `adhesion_force_f0` [N/m] and
/// `reference_diameter` [m] (needed with the force), and `mixed_sizes`, the path of a size
/// distribution over which every point averages. Unknown keys are refused in this object. Elsewhere
/// they are allowed, as in Frictionless, unless they change the meaning of cells. One member for
/// each key.
struct Package {
  std::string id;
  std::string title;
  Provenance provenance = Provenance::measured;
  ImpactSystem system;
  std::string mixed_sizes;  ///< path of the sizes over which every point averages; else empty
  Location mixed_sizes_where;
  std::vector<std::string> sources;
  std::string points_path;             ///< relative, inside the folder
  Location points_where;               ///< place of the path
  std::optional<double> points_bytes;  ///< stated size of the file
  std::string points_hash_algorithm,
      points_hash;       ///< stated hash of the file, lower case; or empty
  char delimiter = ',';  ///< Frictionless `dialect.delimiter`
  char comment = '\0';   ///< `dialect.commentChar`
  bool header = true;    ///< `dialect.header`; without one, columns come in the order of the fields
  std::vector<Column> columns;
};

/// Reads the text of `datapackage.json`.
/// @param file its name in messages
/// @param fallback_id the id if the package has no `name`
/// @throws InputError with line and column of the first mistake
Package read_package(const std::string& text, const std::string& file,
                     const std::string& fallback_id);

/// The resource of a package with this `path`, if there is one.
std::optional<JsonNode> find_resource(const JsonNode& root, const std::string& path);

/// The units that a resource states, by the names of its fields.
std::map<std::string, std::string> field_units(const JsonNode& resource);

/// A field of a schema. Empty units and descriptions are omitted.
Json package_field(const std::string& name, const std::string& type, const std::string& unit,
                   const std::string& description = "");

/// A resource that describes a CSV file with these fields.
Json csv_resource(const std::string& name, const std::string& path, const Json& fields);

/// The object under `recoil` of the dataset in `folder`, for another dataset with the same
/// materials: without provenance, conditions, method and sizes.
/// @throws InputError if there is no data package with this key
Json stated_system(const std::filesystem::path& folder);

/// A constant that one dataset states and that is not copied to another one with the same
/// materials.
struct LeftOverride {
  std::string key;       ///< as in datapackage.json: "stiffness_K"
  double stated = 0.0;   ///< [Pa], [J/m2] or [N/m]
  double derived = 0.0;  ///< what the materials give, in the same unit
};

/// Removes every override that contradicts the materials (see `derive_contact`) from `system`, an
/// object as under the key `recoil`, because it is a value that only one paper printed. f0 is
/// compared with eq. 12 after the other overrides were removed, and is removed together with its
/// `reference_diameter`. A stated 0 (no adhesion) contradicts nothing. A system that cannot be read
/// stays unchanged, and its reader reports the mistake.
/// @param own keys that the user states; they are kept, and the others are compared with them
std::vector<LeftOverride> leave_out_contradictions(Json& system,
                                                   const std::vector<std::string>& own = {});

}  // namespace recoil
