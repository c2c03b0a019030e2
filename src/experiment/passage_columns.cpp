#include "experiment/passage_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "core/error.hpp"
#include "core/units.hpp"
#include "data/datapackage.hpp"
#include "data/dataset.hpp"
#include "data/json_document.hpp"
#include "data/system.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

bool needed(PassageField field) {
  return field == PassageField::time || field == PassageField::velocity ||
         field == PassageField::diameter;
}

Dimension dimension_of(PassageField field) {
  switch (field) {
    case PassageField::time:
      return Dimension::time;
    case PassageField::velocity:
    case PassageField::tangential:
      return Dimension::velocity;
    case PassageField::diameter:
      return Dimension::length;
    case PassageField::series:
      break;
  }
  return Dimension::text;
}

/// What the data package says about one file.
struct StatedUnits {
  std::map<std::string, std::string> unit;  ///< column -> unit
  std::optional<Provenance> provenance;
  bool found = false;  ///< the package has a resource of this name
};

StatedUnits read_stated(const std::string& package_text, const std::string& file) {
  StatedUnits stated;
  if (package_text.empty()) return stated;
  const std::filesystem::path path(file);
  const JsonDocument document(package_text, (path.parent_path() / package_file_name).string());
  const auto resource = find_resource(document.root(), path.filename().string());
  if (!resource) return stated;
  stated.found = true;
  stated.unit = field_units(*resource);
  const auto recoil = document.root().find("recoil");
  if (recoil && recoil->find("provenance")) stated.provenance = read_provenance(*recoil);
  return stated;
}

void require_known(const std::map<std::string, std::string>& given, const std::string& option) {
  for (const auto& [field, value] : given) {
    if (value_named<PassageField>(field)) continue;
    throw InputError(
        {}, fmt::format("{} {}={}: there is no field {}", option, field, value, quote(field)), "",
        did_you_mean(field, all_names<PassageField>()));
  }
}

}  // namespace

PassageColumns passage_columns(const std::vector<std::string>& header, const std::string& file,
                               const std::string& package_text, const PassageFormat& format) {
  require_known(format.units, "--unit");
  require_known(format.columns, "--column");
  const StatedUnits stated = read_stated(package_text, file);
  PassageColumns columns;
  columns.width = header.size();
  columns.provenance = stated.provenance;
  std::vector<bool> used(header.size(), false);
  for (const PassageField field : values_of<PassageField>()) {
    const std::string name = to_string(field);
    const auto renamed = format.columns.find(name);
    const std::string& wanted = renamed != format.columns.end() ? renamed->second : name;
    const auto found = std::find(header.begin(), header.end(), wanted);
    if (found == header.end()) {
      if (!needed(field) && renamed == format.columns.end()) continue;
      throw InputError({file, 1, 1}, fmt::format("there is no column {}", quote(wanted)),
                       fmt::format("the columns are {}", listed(header)),
                       fmt::format("name it with --column {}=NAME", name));
    }
    const auto index = static_cast<std::size_t>(found - header.begin());
    const Location place = {file, 1, static_cast<int>(index) + 1};
    if (std::find(found + 1, header.end(), wanted) != header.end()) {
      throw InputError(place, fmt::format("two columns are called {}", quote(wanted)), "",
                       "rename one");
    }
    used[index] = true;
    columns.index[field] = index;
    if (field == PassageField::series) continue;
    const auto by_option = format.units.find(name);
    const auto by_package = stated.unit.find(wanted);
    const std::vector<std::string> known = unit_names(dimension_of(field));
    if (by_option == format.units.end() && by_package == stated.unit.end()) {
      throw InputError(place, fmt::format("the unit of '{}' is not known", name),
                       stated.found ? "datapackage.json beside the file states none"
                                    : "there is no datapackage.json beside the file that lists it",
                       fmt::format("give --unit {}={}", name, fmt::join(known, "|")));
    }
    const std::string& unit =
        by_option != format.units.end() ? by_option->second : by_package->second;
    const std::optional<double> factor = unit_factor(dimension_of(field), unit);
    if (!factor) {
      throw InputError(place, fmt::format("unknown unit {} of '{}'", quote(unit), name), "",
                       fmt::format("use {}", join(known)));
    }
    columns.factor[field] = *factor;
    columns.units.push_back({name, unit});
  }
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (!used[i]) columns.ignored.push_back(printable(header[i]));
  }
  return columns;
}

}  // namespace recoil
