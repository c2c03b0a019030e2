#include "experiment/event_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "core/error.hpp"
#include "core/units.hpp"
#include "data/json_document.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

constexpr std::size_t series_field = static_cast<std::size_t>(EventField::series);

bool needed(std::size_t field) {
  const auto name = static_cast<EventField>(field);
  return name == EventField::time || name == EventField::velocity || name == EventField::diameter;
}

std::vector<std::string> unit_words(std::size_t field) {
  switch (static_cast<EventField>(field)) {
    case EventField::time:
      return {"s", "ms", "us"};
    case EventField::velocity:
    case EventField::tangential:
      return unit_names(Dimension::velocity);
    default:
      return unit_names(Dimension::length);
  }
}

/// The factor to SI, or nothing for a unit that does not measure the field.
std::optional<double> factor_of(std::size_t field, const std::string& unit) {
  switch (static_cast<EventField>(field)) {
    case EventField::time:
      if (unit == "s") return 1.0;
      if (unit == "ms") return 1e-3;
      if (unit == "us") return 1e-6;
      return std::nullopt;
    case EventField::velocity:
    case EventField::tangential:
      return unit_factor(Dimension::velocity, unit);
    default:
      return unit_factor(Dimension::length, unit);
  }
}

/// What the data package says about one file.
struct StatedUnits {
  std::map<std::string, std::string> unit;  ///< column -> unit
  std::string provenance;
  bool found = false;  ///< the package has a resource of this name
};

StatedUnits read_stated(const std::string& package_text, const std::string& file) {
  StatedUnits stated;
  if (package_text.empty()) return stated;
  const std::filesystem::path path(file);
  const std::string package = (path.parent_path() / "datapackage.json").string();
  const JsonDocument document(package_text, package);
  const auto resources = document.root().find("resources");
  for (const JsonNode& resource : resources ? resources->items() : std::vector<JsonNode>{}) {
    const auto place = resource.find("path");
    if (!place || place->string() != path.filename().string()) continue;
    stated.found = true;
    const auto schema = resource.find("schema");
    const auto fields = schema ? schema->find("fields") : std::nullopt;
    for (const JsonNode& field : fields ? fields->items() : std::vector<JsonNode>{}) {
      const auto name = field.find("name");
      const auto unit = field.find("unit");
      if (name && unit) stated.unit[name->string()] = unit->string();
    }
  }
  const auto recoil = document.root().find("recoil");
  const auto provenance = recoil && stated.found ? recoil->find("provenance") : std::nullopt;
  if (provenance) stated.provenance = provenance->string();
  return stated;
}

void require_known(const std::map<std::string, std::string>& given, const std::string& option) {
  for (const auto& [field, value] : given) {
    const auto& known = event_fields();
    if (std::find(known.begin(), known.end(), field) != known.end()) continue;
    throw InputError({}, fmt::format("{} {}={}: no field {}", option, field, value, quote(field)),
                     "events have no other", did_you_mean(field, known));
  }
}

}  // namespace

const std::vector<std::string>& event_fields() {
  static const std::vector<std::string> names = {"time", "velocity", "tangential_velocity",
                                                 "diameter", "series"};
  return names;
}

EventColumns event_columns(const std::vector<std::string>& header, const std::string& file,
                           const std::string& package_text, const EventFormat& format) {
  require_known(format.units, "--unit");
  require_known(format.columns, "--column");
  const StatedUnits stated = read_stated(package_text, file);
  EventColumns columns;
  columns.width = header.size();
  columns.provenance = stated.provenance;
  std::vector<bool> used(header.size(), false);
  for (std::size_t field = 0; field < event_field_count; ++field) {
    const std::string& name = event_fields()[field];
    const auto renamed = format.columns.find(name);
    const std::string& wanted = renamed != format.columns.end() ? renamed->second : name;
    const auto found = std::find(header.begin(), header.end(), wanted);
    if (found == header.end()) {
      if (!needed(field) && renamed == format.columns.end()) continue;
      throw InputError({file, 1, 1}, fmt::format("no column {}", quote(wanted)),
                       "impacts are found by time, velocity and diameter",
                       fmt::format("columns here: {}; say --column {}=NAME", listed(header), name));
    }
    const auto index = static_cast<std::size_t>(found - header.begin());
    if (std::find(found + 1, header.end(), wanted) != header.end()) {
      throw InputError({file, 1, 1}, fmt::format("two columns {}", quote(wanted)),
                       "only one could count", "rename one");
    }
    used[index] = true;
    columns.index[field] = static_cast<int>(index);
    if (field == series_field) continue;
    const auto by_option = format.units.find(name);
    const auto by_package = stated.unit.find(wanted);
    if (by_option == format.units.end() && by_package == stated.unit.end()) {
      throw InputError({file, 1, static_cast<int>(index) + 1},
                       fmt::format("the unit of '{}' is not known", name),
                       stated.found ? "datapackage.json beside the file states none"
                                    : "there is no datapackage.json beside the file that lists it",
                       fmt::format("say --unit {}={}", name, fmt::join(unit_words(field), "|")));
    }
    const std::string& unit =
        by_option != format.units.end() ? by_option->second : by_package->second;
    const std::optional<double> factor = factor_of(field, unit);
    if (!factor) {
      throw InputError(
          {file, 1, static_cast<int>(index) + 1}, fmt::format("'{}' in {}", name, quote(unit)),
          "this unit is not known for it", fmt::format("use {}", join(unit_words(field))));
    }
    columns.factor[field] = *factor;
    columns.unit_source +=
        fmt::format("{}{} [{}]", columns.unit_source.empty() ? "" : ", ", name, unit);
  }
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (!used[i]) columns.ignored.push_back(printable(header[i]));
  }
  return columns;
}

}  // namespace recoil
