#pragma once

#include <filesystem>
#include <string>

#include "core/json.hpp"

namespace recoil {

/// A cell of a CSV file, quoted where it has to be (RFC 4180).
std::string csv_cell(const std::string& text);

/// A field of a schema. @param unit, description are left out when they are empty.
Json package_field(const std::string& name, const std::string& type, const std::string& unit,
                   const std::string& description = "");

/// A resource: a CSV file in the folder with a list of fields.
Json csv_resource(const std::string& name, const std::string& path, const Json& fields);

/// The system that the dataset in `folder` states under `recoil`, for another one with the same
/// materials: its provenance, its conditions and its sizes are its own. @throws InputError when it
/// is no data package with that key.
Json stated_system(const std::filesystem::path& folder);

/// The text of datapackage.json.
std::string package_text(const Json& package);

}  // namespace recoil
