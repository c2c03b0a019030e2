#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/units.hpp"
#include "data/csv.hpp"
#include "data/datapackage.hpp"
#include "experiment/import.hpp"

/// Common to the readers of all import formats: words of the command line, tables whose columns
/// --map assigns, and imported points.
namespace recoil {

/// One standard deviation, relative to the value or absolute.
struct StatedError {
  double relative = 0.0;  ///< [1]
  double absolute = 0.0;  ///< SI

  bool stated() const { return relative > 0.0 || absolute > 0.0; }
  double of(double value) const { return relative * value + absolute; }
};

/// Parses an error: "2%" is relative, "0.5mm" is absolute, and an empty word states none.
/// @param usual the unit of a number without a unit
/// @param option for messages: "--drop-error"
/// @throws InputError
StatedError stated_error(const std::string& word, Dimension dimension, const std::string& usual,
                         const std::string& option);

/// The unit of a quantity that states none: um of a diameter, otherwise the SI unit; empty for
/// texts.
std::string usual_unit(const std::string& quantity, Dimension dimension);

/// Splits at commas outside quotation marks, and removes blanks around the parts.
std::vector<std::string> split_list(std::string_view text);

std::vector<std::string> split_lists(const std::vector<std::string>& lists);

/// Splits "name=value" at the first '='; nullopt if there is none.
std::optional<std::pair<std::string, std::string>> split_pair(const std::string& word);

/// An imported point in SI units.
struct ImportedPoint {
  std::string series;
  std::string setting;                              ///< empty if the file has none
  std::string launch;                               ///< of timed bounces; empty: none
  PerValue<Quantity, std::optional<double>> value;  ///< of all quantities except texts
  int line = 0;                                     ///< in the file
  std::size_t part = 0;                             ///< index of the file, if there are several

  /// e, from the rebound velocity if that is given; nullopt if all were captured.
  std::optional<double> restitution() const;
};

struct ImportedPoints {
  std::vector<ImportedPoint> points;
  std::vector<ImportNote> notes;
};

/// A point of one impact, or the mean of several. @param restitution nullopt: all were captured
ImportedPoint imported_point(const std::string& series, int line, std::optional<double> diameter,
                             double velocity, std::optional<double> restitution);

/// The name of the series if the file has none: --series, or the name of the file.
std::string default_series(const ImportRequest& request);

/// The diameter of a sphere of `series` [m]: from the file, from --diameter, or from the name of
/// the series ("2.58 um", "d = 4.9um on Mo"); nullopt if none of them states it.
std::optional<double> known_diameter(const ImportRequest& request, const std::string& series,
                                     std::optional<double> in_file);

/// Sets the diameter of every point and its error.
/// @throws InputError for a point without a diameter, and for a --diameter of no series
void resolve_diameters(const ImportRequest& request, ImportedPoints& imported);

NumberFormat number_format(const ImportRequest& request);

/// The rows of the request's text. The delimiter is the tab, semicolon, comma, bar or blank that
/// gives all lines the same number of cells; a first line `sep=;` states it. Lines that begin with
/// '#' are comments, except for a header.
/// @param notes gets what was skipped or assumed
/// @throws InputError if the file has no rows
std::vector<CsvRow> import_rows(const ImportRequest& request, std::vector<ImportNote>& notes);

/// The text of the request's file of at most `max_bytes` in UTF-8. A file in another encoding is
/// read as Windows-1252. A sheet of a workbook becomes a table separated by tabs.
/// @throws InputError as `read_bytes` and `read_sheet`, and for UTF-16
std::string table_text(const ImportRequest& request, std::vector<ImportNote>& notes,
                       std::uintmax_t max_bytes = 256ULL << 20);

struct ImportQuantity {
  std::string name;  ///< left of '=' in --map
  Dimension dimension = Dimension::text;
  bool needed = false;
};

/// Units by the names of fields, from another source than the file and --map.
using FieldUnits = std::map<std::string, std::string>;

/// A table whose columns --map assigns to quantities. Columns without a header are called 1, 2, ...
/// A cell "0.85 ± 0.02" (or +-) contains a value and its standard deviation.
class ImportTable {
 public:
  /// Entries of --map are "quantity=column:unit", where the unit may have a factor ("0.35mm"), or
  /// "quantity=100cm", a constant. Several columns "a+b" of a text are joined. Several columns of a
  /// number are replicates: a row of the file then counts as several rows here.
  /// @param units of columns with the name of their quantity, if neither --map nor the file states
  ///   one
  /// @throws InputError for an unknown quantity or column, a missing or wrong unit, and a needed
  ///   quantity without a column
  ImportTable(const ImportRequest& request, const std::vector<ImportQuantity>& known,
              const FieldUnits& units = {});

  std::size_t size() const { return rows_.size() * replicates_; }
  bool has(const std::string& quantity) const { return columns_.contains(quantity); }
  bool has_replicates() const { return replicates_ > 1; }
  /// True if the quantity has a column and its value in this row is missing.
  bool lacks(std::size_t row, const std::string& quantity) const;
  /// True if `quantity` is the error of another one, and a cell of that states it: "0.85 ± 0.02".
  bool has_beside(const std::string& quantity) const;
  /// True if the name of the quantity's column begins with the name of the quantity.
  bool is_named(const std::string& quantity) const;
  /// Records that a row is not used because a cell is empty.
  void leave_out(std::size_t row) { left_out_.insert(row); }
  /// What was skipped, assumed and left out. @throws InputError if all rows were left out
  std::vector<ImportNote> notes() const;

  /// The value in SI; nullopt if the cell is empty or there is no such column. @throws InputError
  std::optional<double> value(std::size_t row, const std::string& quantity) const;
  /// The value of a quantity that every row needs. @throws InputError
  double needed(std::size_t row, const std::string& quantity) const;
  /// The value of such a quantity. @throws InputError unless it is positive
  double positive(std::size_t row, const std::string& quantity) const;
  std::string text(std::size_t row, const std::string& quantity) const;
  /// The text of a quantity, or the name of the series if that is empty.
  std::string name(std::size_t row, const std::string& quantity) const;
  int line(std::size_t row) const { return cells(row).front().line; }

  /// @param how suggestion for the message
  /// @throws InputError unless exactly one of the two quantities has a column
  void require_one_of(const std::string& one, const std::string& other,
                      const std::string& how) const;
  /// @throws InputError at the cell of a quantity
  [[noreturn]] void fail(std::size_t row, const std::string& quantity, const std::string& problem,
                         const std::string& why, const std::string& suggestion) const;

  /// The entries of --map that read the columns of `quantity` as a launch each, for the same table
  /// with rows and columns exchanged: "launch=Data,interval=Bounce 1+Bounce 2:s".
  std::string exchanged_map(const std::string& quantity) const;

  /// The names of columns that no quantity uses.
  std::vector<std::string> unused() const;

 private:
  struct Source {
    std::vector<std::size_t> at;     ///< columns
    std::vector<Scale> scale;        ///< of each column of numbers
    std::optional<double> constant;  ///< in SI, instead of columns
  };

  void read_header(bool transposed);
  void read_map(const std::string& entry);
  void find_columns_by_name();
  bool is_used(std::size_t column) const;
  void resolve_replicates();
  std::vector<std::string> header_names() const;
  std::size_t column_named(const std::string& name) const;
  Scale scale_of(const ImportQuantity& quantity, const std::string& unit, std::size_t column) const;
  const CsvRow& cells(std::size_t row) const { return rows_[row / replicates_]; }
  /// The cell of a quantity in a row; null if the quantity has no column.
  const CsvField* cell_of(std::size_t row, const std::string& quantity) const;
  const Scale& scale_in(std::size_t row, const Source& source) const;
  std::optional<double> error_beside(std::size_t row, const std::string& quantity) const;

  std::vector<ImportNote> notes_;
  std::string file_;
  std::string series_;  ///< name of the series if the file has none
  NumberFormat format_;
  std::vector<ImportQuantity> known_;
  FieldUnits field_units_;
  CsvRow header_;
  CsvRow units_;       ///< a row of units below the header; may be empty
  bool named_ = true;  ///< the columns have a header
  std::vector<CsvRow> rows_;
  std::size_t replicates_ = 1;
  std::map<std::string, Source> columns_;
  std::vector<std::string> found_;  ///< "restitution = e"
  std::set<std::size_t> left_out_;  ///< rows
};

}  // namespace recoil
