#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "data/csv.hpp"
#include "experiment/option_values.hpp"

namespace recoil {

/// Rows of a delimited file; commas, semicolons and tabs are told apart by the first line.
/// @throws InputError when the file has no rows.
std::vector<CsvRow> import_rows(const std::filesystem::path& file);

/// A number in a cell. @throws InputError where it stands
double import_number(const CsvField& cell, const std::string& file, const std::string& what);

/// A quantity that a format knows.
struct ImportQuantity {
  std::string name;  ///< left of '=' in --map
  Dimension dimension = Dimension::text;
  bool needed = false;
};

/// A table with a header whose columns are tied to quantities by --map.
class ImportTable {
 public:
  /// @param map entries "quantity=column:unit"; several columns of a text are joined by '+'
  /// @throws InputError for an unknown quantity or column, a unit that is missing or measures
  ///   something else, and a needed quantity without a column.
  ImportTable(const std::filesystem::path& file, const std::vector<std::string>& map,
              const std::vector<ImportQuantity>& known);

  std::size_t size() const { return rows_.size(); }
  bool has(const std::string& quantity) const { return columns_.contains(quantity); }

  /// In SI; nothing when the cell is empty or there is no such column. @throws InputError
  std::optional<double> value(std::size_t row, const std::string& quantity) const;
  /// The same of a quantity that every row needs.
  double needed(std::size_t row, const std::string& quantity) const;
  std::string text(std::size_t row, const std::string& quantity) const;
  int line(std::size_t row) const { return rows_[row].front().line; }

  /// @throws InputError at the cell of a quantity.
  [[noreturn]] void fail(std::size_t row, const std::string& quantity, const std::string& problem,
                         const std::string& why, const std::string& suggestion) const;

  /// Header names that no quantity uses.
  std::vector<std::string> unused() const;

 private:
  struct Source {
    std::vector<std::size_t> at;  ///< columns
    Dimension dimension = Dimension::text;
    double factor = 1.0;
  };

  void add(const std::string& entry, const std::vector<ImportQuantity>& known);
  std::size_t column_named(const std::string& name) const;
  double unit_of(const ImportQuantity& quantity, const std::string& unit, std::size_t column) const;

  std::string file_;
  CsvRow header_;
  std::vector<CsvRow> rows_;
  std::map<std::string, Source> columns_;
};

}  // namespace recoil
