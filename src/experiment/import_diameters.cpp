#include "experiment/import_diameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "core/error.hpp"
#include "data/text.hpp"
#include "experiment/option_values.hpp"

namespace recoil {
namespace {

/// The diameter that --diameter states for a series.
std::optional<double> stated_diameter(const ImportRequest& request, const std::string& series) {
  std::optional<double> found;
  for (const std::string& word : request.diameters) {
    const auto pair = split_pair(word);
    if (pair && pair->first != series) continue;
    const double value =
        value_with_unit(pair ? pair->second : word, Dimension::length, "--diameter");
    if (pair) return value;
    found = value;
  }
  return found;
}

/// A diameter in the name of a series: "2.58 um", "d = 4.9um on Mo".
std::optional<double> diameter_in_name(const std::string& series) {
  static const std::regex pattern(
      R"re((^|[^0-9.])([0-9]+\.?[0-9]*)\s*(nm|um|µm|mm)($|[^a-zA-Z]))re");
  std::smatch match;
  if (!std::regex_search(series, match, pattern)) return std::nullopt;
  const auto number = parse_number(match[2].str());
  const auto factor = unit_factor(Dimension::length, match[3].str());
  return number && factor ? std::optional<double>(*number * *factor) : std::nullopt;
}

}  // namespace

std::optional<double> known_diameter(const ImportRequest& request, const std::string& series,
                                     std::optional<double> in_file) {
  if (in_file) return in_file;
  const std::optional<double> stated = stated_diameter(request, series);
  return stated ? stated : diameter_in_name(series);
}

void settle_diameters(const ImportRequest& request, ImportedPoints& imported) {
  const StatedError error =
      stated_error(request.diameter_error, Dimension::length, "--diameter-error");
  std::vector<std::string> named;
  std::vector<std::string> series;
  bool asked = request.diameters.empty();
  for (const std::string& word : request.diameters) {  // also those that nothing will need
    const auto pair = split_pair(word);
    value_with_unit(pair ? pair->second : word, Dimension::length, "--diameter");
  }
  for (ImportedPoint& point : imported.points) {
    if (std::find(series.begin(), series.end(), point.series) == series.end()) {
      series.push_back(point.series);
    }
    if (!point.diameter) {
      asked = true;
      point.diameter = known_diameter(request, point.series, {});
      const bool from_name = point.diameter && !stated_diameter(request, point.series);
      if (from_name && std::find(named.begin(), named.end(), point.series) == named.end()) {
        named.push_back(point.series);
      }
    }
    if (!point.diameter) {
      throw InputError({request.file.string(), point.line, 1},
                       fmt::format("the diameter of series {} is not known", quote(point.series)),
                       "", "give --diameter 4.9um, or --diameter \"SERIES=4.9um\" for each series");
    }
    if (error.stated() && !point.diameter_sd) point.diameter_sd = error.of(*point.diameter);
  }
  for (const std::string& word : request.diameters) {
    const auto pair = split_pair(word);
    if (!pair || std::find(series.begin(), series.end(), pair->first) != series.end()) continue;
    throw InputError({}, fmt::format("--diameter {}: there is no such series", quote(word)), "",
                     did_you_mean(pair->first, series));
  }
  if (!asked) {
    imported.notes.push_back({ImportRemark::diameter_not_used});
  }
  if (!named.empty()) {
    imported.notes.push_back({ImportRemark::diameters_from_names, named});
  }
}

}  // namespace recoil
