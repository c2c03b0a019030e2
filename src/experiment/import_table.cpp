#include "experiment/import_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/files.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

bool is_empty(const CsvRow& row) {
  return std::all_of(row.begin(), row.end(), [](const CsvField& f) { return f.text.empty(); });
}

/// The unit in "V [cm/s]" or "V (cm/s)".
std::string unit_in_brackets(const std::string& name) {
  const std::size_t open = name.find_last_of("[(");
  const std::size_t close = name.find_last_of("])");
  if (open == std::string::npos || close == std::string::npos || close < open) return "";
  return name.substr(open + 1, close - open - 1);
}

}  // namespace

std::vector<CsvRow> import_rows(const std::filesystem::path& file) {
  const std::string text = read_text_file(file);
  require_text(text, file.string());
  std::vector<CsvRow> rows;
  read_csv(text, file.string(), delimiter_of(std::string_view(text).substr(0, text.find('\n'))),
           [&](const CsvRow& row) {
             if (!is_empty(row)) rows.push_back(row);
           });
  if (rows.empty()) {
    throw InputError({file.string(), 1, 1}, "the file is empty", "", "export the points again");
  }
  return rows;
}

double import_number(const CsvField& cell, const std::string& file, const std::string& what) {
  if (const auto value = parse_number(cell.text)) return *value;
  const bool comma = cell.text.find(',') != std::string::npos;
  throw InputError({file, cell.line, cell.column},
                   fmt::format("{} is not a number", quote(cell.text)),
                   fmt::format("{} has to be a finite number", what),
                   comma ? "write decimals with a point" : "write a decimal number such as 4.9");
}

ImportTable::ImportTable(const std::filesystem::path& file, const std::vector<std::string>& map,
                         const std::vector<ImportQuantity>& known)
    : file_(file.string()), rows_(import_rows(file)) {
  header_ = rows_.front();
  rows_.erase(rows_.begin());
  for (const CsvRow& row : rows_) {
    if (row.size() == header_.size()) continue;
    throw InputError({file_, row.front().line, row.back().column},
                     fmt::format("this row has {} cells", row.size()),
                     fmt::format("the header has {}", header_.size()),
                     "leave a cell empty, but keep its comma");
  }
  for (const std::string& list : map) {
    for (const std::string& entry : split_list(list)) add(entry, known);
  }
  // A column that is called like a quantity stands for it.
  for (const ImportQuantity& quantity : known) {
    const bool there = std::any_of(header_.begin(), header_.end(), [&](const CsvField& cell) {
      const std::string plain = cell.text.substr(0, cell.text.find_first_of(" [("));
      return plain == quantity.name;
    });
    if (!there || has(quantity.name)) continue;
    const auto cell = std::find_if(header_.begin(), header_.end(), [&](const CsvField& c) {
      return c.text.substr(0, c.text.find_first_of(" [(")) == quantity.name;
    });
    add(fmt::format("{}=\"{}\"", quantity.name, cell->text), known);
  }
  for (const ImportQuantity& quantity : known) {
    if (!quantity.needed || has(quantity.name)) continue;
    std::vector<std::string> names;
    for (const CsvField& cell : header_) names.push_back(cell.text);
    throw InputError({file_, header_.front().line, 1},
                     fmt::format("which column is {}?", quantity.name),
                     fmt::format("the header has {}", listed(names)),
                     fmt::format("name it with --map {}=COLUMN{}", quantity.name,
                                 quantity.dimension == Dimension::text ? "" : ":UNIT"));
  }
  if (rows_.empty()) {
    throw InputError({file_, header_.front().line, 1}, "there is a header but no row below it", "",
                     "export the points again");
  }
}

void ImportTable::add(const std::string& entry, const std::vector<ImportQuantity>& known) {
  std::vector<std::string> names;
  for (const ImportQuantity& quantity : known) names.push_back(quantity.name);
  const auto pair = split_pair(entry);
  if (!pair) {
    throw InputError({},
                     fmt::format("--map {} is not of the form quantity=column:unit", quote(entry)),
                     "", fmt::format("quantities are {}", join(names)));
  }
  const auto quantity = std::find_if(
      known.begin(), known.end(), [&](const ImportQuantity& q) { return q.name == pair->first; });
  if (quantity == known.end()) {
    // "velocity" is near to velocity_sd, but what has to be there is meant: incident_velocity.
    const auto meant = std::find_if(known.begin(), known.end(), [&](const ImportQuantity& q) {
      return q.needed && q.name.ends_with("_" + pair->first);
    });
    throw InputError({}, fmt::format("--map: unknown quantity {}", quote(pair->first)),
                     "this format does not have this quantity",
                     did_you_mean(meant == known.end() ? pair->first : meant->name, names));
  }
  std::string column = pair->second;
  if (column.size() > 1 && column.front() == '"' && column.back() == '"') {
    column = column.substr(1, column.size() - 2);
  }
  std::string unit;
  const bool whole = std::any_of(header_.begin(), header_.end(),
                                 [&](const CsvField& cell) { return cell.text == column; });
  if (const std::size_t at = column.rfind(':'); !whole && at != std::string::npos) {
    unit = column.substr(at + 1);
    column = column.substr(0, at);
  }
  Source source;
  source.dimension = quantity->dimension;
  if (quantity->dimension == Dimension::text) {
    for (std::size_t at = 0; at != std::string::npos;) {
      const std::size_t plus = column.find('+', at);
      source.at.push_back(
          column_named(column.substr(at, plus == std::string::npos ? plus : plus - at)));
      at = plus == std::string::npos ? plus : plus + 1;
    }
  } else {
    source.at = {column_named(column)};
    source.factor = unit_of(*quantity, unit, source.at.front());
  }
  if (!columns_.emplace(quantity->name, source).second) {
    throw InputError({}, fmt::format("--map {} is given twice", quantity->name), "", "remove one");
  }
}

std::size_t ImportTable::column_named(const std::string& name) const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < header_.size(); ++i) {
    if (header_[i].text == name) return i;
    names.push_back(header_[i].text);
  }
  throw InputError({file_, header_.front().line, 1},
                   fmt::format("no column is called {}", quote(name)), "--map asks for it",
                   did_you_mean(name, names));
}

double ImportTable::unit_of(const ImportQuantity& quantity, const std::string& unit,
                            std::size_t column) const {
  const bool plain =
      quantity.dimension == Dimension::count || quantity.dimension == Dimension::ratio;
  std::string name = unit.empty() ? unit_in_brackets(header_[column].text) : unit;
  if (name.empty() && plain) name = "1";
  const std::vector<std::string> names = unit_names(quantity.dimension);
  if (name.empty()) {
    throw InputError(
        {file_, header_[column].line, header_[column].column},
        fmt::format("the unit of {} is not stated", quote(header_[column].text)), "",
        fmt::format("write --map {}={}:UNIT", quantity.name, listed({header_[column].text})));
  }
  if (const auto factor = unit_factor(quantity.dimension, name)) return *factor;
  throw InputError({file_, header_[column].line, header_[column].column},
                   fmt::format("unknown unit {} of {}", quote(name), quantity.name), "",
                   fmt::format("use {}", join(names)));
}

std::optional<double> ImportTable::value(std::size_t row, const std::string& quantity) const {
  const auto found = columns_.find(quantity);
  if (found == columns_.end()) return std::nullopt;
  const CsvField& cell = rows_[row][found->second.at.front()];
  if (cell.text.empty()) return std::nullopt;
  return import_number(cell, file_, quantity) * found->second.factor;
}

double ImportTable::needed(std::size_t row, const std::string& quantity) const {
  if (const auto known = value(row, quantity)) return *known;
  fail(row, quantity, fmt::format("{} is empty", quantity), "", "fill it in or remove the row");
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
  throw InputError({file_, cell.line, cell.column}, problem, why, suggestion);
}

std::vector<std::string> ImportTable::unused() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < header_.size(); ++i) {
    const bool used = std::any_of(columns_.begin(), columns_.end(), [&](const auto& entry) {
      const auto& at = entry.second.at;
      return std::find(at.begin(), at.end(), i) != at.end();
    });
    if (!used) names.push_back(header_[i].text);
  }
  return names;
}

}  // namespace recoil
