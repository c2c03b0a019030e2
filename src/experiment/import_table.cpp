#include "experiment/import_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <set>

#include "core/files.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

/// The number at the start of a word and the rest of it.
std::optional<std::pair<double, std::string>> number_and_rest(const std::string& word) {
  const std::string_view text = trimmed(word);
  for (std::size_t length = text.size(); length > 0; --length) {
    if (const auto value = parse_number(text.substr(0, length))) {
      return std::pair{*value, std::string(trimmed(text.substr(length)))};
    }
  }
  return std::nullopt;
}

/// The diameter that --diameter states for a series.
std::optional<double> stated_diameter(const ImportRequest& request, const std::string& series) {
  std::optional<double> for_all;
  for (const std::string& word : request.diameters) {
    const auto pair = split_pair(word);
    if (pair && pair->first != series) continue;
    const double value =
        value_with_unit(pair ? pair->second : word, Dimension::length, "--diameter");
    if (pair) return value;
    for_all = value;
  }
  return for_all;
}

/// The diameter in the name of a series: "2.58 um", "d = 4.9um on Mo".
std::optional<double> diameter_in_name(const std::string& series) {
  static const std::regex pattern(
      R"re((^|[^0-9.])([0-9]+\.?[0-9]*)\s*(nm|um|µm|mm)($|[^a-zA-Z]))re");
  std::smatch match;
  if (!std::regex_search(series, match, pattern)) return std::nullopt;
  const auto number = parse_number(match[2].str());
  const auto factor = unit_factor(Dimension::length, match[3].str());
  return number && factor ? std::optional<double>(*number * *factor) : std::nullopt;
}

/// The unit in "V [cm/s]" or "V (cm/s)".
std::string unit_in_brackets(const std::string& name) {
  const std::size_t open = name.find_last_of("[(");
  const std::size_t close = name.find_last_of("])");
  if (open == std::string::npos || close == std::string::npos || close < open) return "";
  return name.substr(open + 1, close - open - 1);
}

}  // namespace

double value_with_unit(const std::string& word, Dimension dimension, const std::string& option) {
  const std::vector<std::string> names = unit_names(dimension);
  if (const auto parts = number_and_rest(word)) {
    const bool plain = dimension == Dimension::ratio && parts->second.empty();
    const auto factor = plain ? 1.0 : unit_factor(dimension, parts->second);
    if (factor) return parts->first * *factor;
  }
  throw InputError({}, fmt::format("{} {} is not a number with a unit", option, quote(word)),
                   fmt::format("units are {}", join(names)),
                   fmt::format("write for example 4.9{}", names.front()));
}

StatedError stated_error(const std::string& word, Dimension dimension, const std::string& option) {
  StatedError error;
  if (word.empty()) return error;
  const auto parts = number_and_rest(word);
  if (parts && parts->second == "%") {
    error.relative = parts->first / 100.0;
  } else {
    error.absolute = value_with_unit(word, dimension, option);
  }
  if (error.relative < 0.0 || error.absolute < 0.0 || !error.stated()) {
    throw InputError({}, fmt::format("{} {} is not positive", option, quote(word)),
                     "it is a standard deviation", "leave the option out if it is not known");
  }
  return error;
}

std::vector<std::string> split_list(std::string_view text) {
  std::vector<std::string> parts;
  std::string part;
  bool quoted = false;
  for (const char c : text) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      parts.emplace_back(trimmed(part));
      part.clear();
    } else {
      part += c;
    }
  }
  parts.emplace_back(trimmed(part));
  std::erase(parts, "");
  return parts;
}

std::vector<std::string> split_lists(const std::vector<std::string>& lists) {
  std::vector<std::string> all;
  for (const std::string& list : lists) {
    for (std::string& part : split_list(list)) all.push_back(std::move(part));
  }
  return all;
}

std::optional<std::pair<std::string, std::string>> split_pair(const std::string& word) {
  const std::size_t at = word.find('=');
  if (at == std::string::npos) return std::nullopt;
  return std::pair{std::string(trimmed(std::string_view(word).substr(0, at))),
                   std::string(trimmed(std::string_view(word).substr(at + 1)))};
}

std::optional<double> ImportedPoint::restitution() const {
  const auto rebound = value[Quantity::rebound_velocity];
  if (!rebound) return value[Quantity::restitution];
  return *rebound / *value[Quantity::incident_velocity];
}

std::string default_series(const ImportRequest& request) {
  return request.series.empty() ? request.file.stem().string() : request.series;
}

std::optional<double> known_diameter(const ImportRequest& request, const std::string& series,
                                     std::optional<double> in_file) {
  if (in_file) return in_file;
  const std::optional<double> stated = stated_diameter(request, series);
  return stated ? stated : diameter_in_name(series);
}

void settle_diameters(const ImportRequest& request, ImportedPoints& imported) {
  const StatedError error =
      stated_error(request.diameter_error, Dimension::length, "--diameter-error");
  for (const std::string& word : request.diameters) {  // including those that are not needed
    const auto pair = split_pair(word);
    value_with_unit(pair ? pair->second : word, Dimension::length, "--diameter");
  }
  std::vector<std::string> series;
  std::vector<std::string> named;  // series whose names hold their diameters
  std::set<std::string> seen;
  std::set<std::string> seen_named;
  bool used = request.diameters.empty();
  for (ImportedPoint& point : imported.points) {
    if (seen.insert(point.series).second) series.push_back(point.series);
    auto& diameter = point.value[Quantity::diameter];
    if (!diameter) {
      used = true;
      diameter = known_diameter(request, point.series, {});
      const bool from_name = diameter && !stated_diameter(request, point.series);
      if (from_name && seen_named.insert(point.series).second) named.push_back(point.series);
    }
    if (!diameter) {
      throw InputError({request.file.string(), point.line, 1},
                       fmt::format("the diameter of series {} is not known", quote(point.series)),
                       "", "give --diameter 4.9um, or --diameter \"SERIES=4.9um\" for each series");
    }
    auto& sd = point.value[Quantity::diameter_sd];
    if (error.stated() && !sd) sd = error.of(*diameter);
  }
  for (const std::string& word : request.diameters) {
    const auto pair = split_pair(word);
    if (!pair || seen.contains(pair->first)) continue;
    throw InputError({}, fmt::format("--diameter {}: there is no such series", quote(word)), "",
                     did_you_mean(pair->first, series));
  }
  if (!used) imported.notes.push_back({ImportRemark::diameter_not_used});
  if (!named.empty()) imported.notes.push_back({ImportRemark::diameters_from_names, named});
}

std::vector<CsvRow> import_rows(const std::filesystem::path& file) {
  const std::string text = read_text_file(file);
  require_text(text, file.string());
  const char delimiter = delimiter_of(std::string_view(text).substr(0, text.find('\n')));
  std::vector<CsvRow> rows;
  read_csv(text, file.string(), delimiter, [&](const CsvRow& row) {
    const bool empty =
        std::all_of(row.begin(), row.end(), [](const CsvField& cell) { return cell.text.empty(); });
    if (!empty) rows.push_back(row);
  });
  if (rows.empty()) {
    throw InputError({file.string(), 1, 1}, "the file is empty", "", "export the points again");
  }
  return rows;
}

ImportTable::ImportTable(const std::filesystem::path& file, const std::vector<std::string>& map,
                         const std::vector<ImportQuantity>& known)
    : file_(file.string()), known_(known), rows_(import_rows(file)) {
  header_ = rows_.front();
  rows_.erase(rows_.begin());
  for (const CsvRow& row : rows_) require_width(row, header_.size(), file_);
  for (const std::string& entry : split_lists(map)) read_map(entry);
  find_columns_by_name();
  for (const ImportQuantity& quantity : known_) {
    if (!quantity.needed || has(quantity.name)) continue;
    throw InputError({file_, header_.front().line, 1},
                     fmt::format("which column is {}?", quantity.name),
                     fmt::format("the header has {}", listed(header_names())),
                     fmt::format("name it with --map {}=COLUMN{}", quantity.name,
                                 quantity.dimension == Dimension::text ? "" : ":UNIT"));
  }
  if (rows_.empty()) {
    throw InputError({file_, header_.front().line, 1}, "there is a header but no row below it", "",
                     "export the points again");
  }
}

/// A column with the name of a quantity stands for it.
void ImportTable::find_columns_by_name() {
  for (const ImportQuantity& quantity : known_) {
    const auto cell = std::find_if(header_.begin(), header_.end(), [&](const CsvField& c) {
      return c.text.substr(0, c.text.find_first_of(" [(")) == quantity.name;
    });
    if (cell != header_.end() && !has(quantity.name)) {
      read_map(fmt::format("{}=\"{}\"", quantity.name, cell->text));
    }
  }
}

void ImportTable::read_map(const std::string& entry) {
  std::vector<std::string> names;
  for (const ImportQuantity& quantity : known_) names.push_back(quantity.name);
  const auto pair = split_pair(entry);
  if (!pair) {
    throw InputError({},
                     fmt::format("--map {} is not of the form quantity=column:unit", quote(entry)),
                     "", fmt::format("quantities are {}", join(names)));
  }
  const auto quantity = std::find_if(
      known_.begin(), known_.end(), [&](const ImportQuantity& q) { return q.name == pair->first; });
  if (quantity == known_.end()) {
    // "velocity" is near to velocity_sd, but the needed quantity is meant: incident_velocity.
    const auto meant = std::find_if(known_.begin(), known_.end(), [&](const ImportQuantity& q) {
      return q.needed && q.name.ends_with("_" + pair->first);
    });
    throw InputError({}, fmt::format("--map: unknown quantity {}", quote(pair->first)),
                     "this format does not have this quantity",
                     did_you_mean(meant == known_.end() ? pair->first : meant->name, names));
  }
  std::string column = pair->second;
  if (column.size() > 1 && column.front() == '"' && column.back() == '"') {
    column = column.substr(1, column.size() - 2);
  }
  std::string unit;
  const std::vector<std::string> header = header_names();
  const bool whole = std::find(header.begin(), header.end(), column) != header.end();
  if (const std::size_t at = column.rfind(':'); !whole && at != std::string::npos) {
    unit = column.substr(at + 1);
    column = column.substr(0, at);
  }
  Source source;
  if (quantity->dimension == Dimension::text) {
    for (std::size_t at = 0; at != std::string::npos;) {
      const std::size_t plus = column.find('+', at);
      source.at.push_back(
          column_named(column.substr(at, plus == std::string::npos ? plus : plus - at)));
      at = plus == std::string::npos ? plus : plus + 1;
    }
  } else {
    source.at = {column_named(column)};
    source.factor = factor_of(*quantity, unit, source.at.front());
  }
  if (!columns_.emplace(quantity->name, source).second) {
    throw InputError({}, fmt::format("--map {} is given twice", quantity->name), "", "remove one");
  }
}

std::vector<std::string> ImportTable::header_names() const {
  std::vector<std::string> names;
  for (const CsvField& cell : header_) names.push_back(cell.text);
  return names;
}

std::size_t ImportTable::column_named(const std::string& name) const {
  const std::vector<std::string> names = header_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  throw InputError({file_, header_.front().line, 1},
                   fmt::format("no column is called {}", quote(name)), "--map asks for it",
                   did_you_mean(name, names));
}

double ImportTable::factor_of(const ImportQuantity& quantity, const std::string& unit,
                              std::size_t column) const {
  const CsvField& cell = header_[column];
  std::string name = unit.empty() ? unit_in_brackets(cell.text) : unit;
  const bool pure =
      quantity.dimension == Dimension::count || quantity.dimension == Dimension::ratio;
  if (name.empty() && pure) name = "1";
  if (name.empty()) {
    throw InputError(cell.in(file_), fmt::format("the unit of {} is not stated", quote(cell.text)),
                     "", fmt::format("write --map {}={}:UNIT", quantity.name, listed({cell.text})));
  }
  return known_factor(quantity.dimension, name, quantity.name, cell.in(file_));
}

std::optional<double> ImportTable::value(std::size_t row, const std::string& quantity) const {
  const auto found = columns_.find(quantity);
  if (found == columns_.end()) return std::nullopt;
  const CsvField& cell = rows_[row][found->second.at.front()];
  if (cell.text.empty()) return std::nullopt;
  return number_in(cell, file_, quantity) * found->second.factor;
}

double ImportTable::needed(std::size_t row, const std::string& quantity) const {
  if (const auto known = value(row, quantity)) return *known;
  fail(row, quantity, fmt::format("{} is empty", quantity), "", "fill it in or remove the row");
}

double ImportTable::positive(std::size_t row, const std::string& quantity) const {
  const double known = needed(row, quantity);
  if (known > 0.0) return known;
  fail(row, quantity, fmt::format("{} = {:g}", quantity, known), "it has to be positive",
       "correct it or remove the row");
}

std::string ImportTable::text(std::size_t row, const std::string& quantity) const {
  const auto found = columns_.find(quantity);
  if (found == columns_.end()) return "";
  std::string joined;
  for (const std::size_t column : found->second.at) {
    if (!joined.empty()) joined += '/';
    joined += rows_[row][column].text;
  }
  return joined;
}

void ImportTable::fail(std::size_t row, const std::string& quantity, const std::string& problem,
                       const std::string& why, const std::string& suggestion) const {
  const auto found = columns_.find(quantity);
  const CsvField& cell = rows_[row][found == columns_.end() ? 0 : found->second.at.front()];
  throw InputError(cell.in(file_), problem, why, suggestion);
}

std::vector<std::string> ImportTable::unused() const {
  std::set<std::size_t> used;
  for (const auto& [quantity, source] : columns_) used.insert(source.at.begin(), source.at.end());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < header_.size(); ++i) {
    if (!used.contains(i)) names.push_back(header_[i].text);
  }
  return names;
}

}  // namespace recoil
