#include "experiment/import_columns.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "data/datapackage.hpp"
#include "data/text.hpp"
#include "experiment/import_table.hpp"

namespace recoil {
namespace {

/// All that a dataset can state of a point.
const std::vector<ImportQuantity>& known_quantities() {
  static const std::vector<ImportQuantity> known = [] {
    std::vector<ImportQuantity> all;
    for (const Quantity quantity : values_of<Quantity>()) {
      all.push_back({std::string(name_of(quantity)), dimension_of(quantity),
                     quantity == Quantity::incident_velocity});
    }
    return all;
  }();
  return known;
}

/// `map`, and what the package knows of columns that it does not speak of and the file has.
std::vector<std::string> completed(const ImportRequest& request,
                                   const std::vector<std::string>& package_map) {
  std::vector<std::string> map = request.map;
  const CsvRow header = import_rows(request.file).front();
  for (const std::string& entry : package_map) {
    const auto pair = split_pair(entry);
    const std::string column = pair->second.substr(0, pair->second.find(':'));
    const bool there = std::any_of(header.begin(), header.end(),
                                   [&](const CsvField& cell) { return cell.text == column; });
    const bool said = std::any_of(request.map.begin(), request.map.end(), [&](const auto& list) {
      const std::vector<std::string> parts = split_list(list);
      return std::any_of(parts.begin(), parts.end(), [&](const std::string& part) {
        const auto other = split_pair(part);
        return other && other->first == pair->first;
      });
    });
    if (there && !said) map.push_back(entry);
  }
  return map;
}

}  // namespace

ImportedPoints read_columns(const ImportRequest& request,
                            const std::vector<std::string>& package_map) {
  const ImportTable table(request.file, completed(request, package_map), known_quantities());
  if (table.has("restitution") == table.has("rebound_velocity")) {
    throw InputError({request.file.string(), 1, 1},
                     table.has("restitution") ? "both restitution and rebound_velocity are there"
                                              : "which column is the rebound?",
                     table.has("restitution") ? "they could contradict each other" : "",
                     "name one with --map restitution=COLUMN or rebound_velocity=COLUMN:m/s");
  }
  const std::string fallback =
      request.series.empty() ? request.file.stem().string() : request.series;
  ImportedPoints out;
  for (std::size_t r = 0; r < table.size(); ++r) {
    ImportedPoint point;
    point.series = table.text(r, "series");
    if (point.series.empty()) point.series = fallback;
    point.diameter = table.value(r, "diameter");
    point.velocity = table.needed(r, "incident_velocity");
    point.restitution = table.value(r, "restitution");
    point.rebound_velocity = table.value(r, "rebound_velocity");
    point.restitution_sd = table.value(r, "restitution_sd");
    point.velocity_sd = table.value(r, "velocity_sd");
    point.diameter_sd = table.value(r, "diameter_sd");
    point.events = table.value(r, "events");
    point.captured = table.value(r, "captured");
    point.setting = table.text(r, "setting");
    for (const Condition condition : values_of<Condition>()) {
      const auto stated = table.value(r, std::string(name_of(condition)));
      if (stated) point.conditions.set(condition, *stated);
    }
    point.line = table.line(r);
    out.points.push_back(point);
  }
  const std::vector<std::string> unused = table.unused();
  if (!unused.empty()) out.notes.push_back({ImportRemark::columns_not_used, unused});
  return out;
}

}  // namespace recoil
