#pragma once

#include <filesystem>
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

/// What the readers of all import formats share: words of the command line, tables whose columns
/// --map names, and the points that they make.
namespace recoil {

/// "4.9um", "4.9 um" -> 4.9e-6. @param option names it in messages: "--diameter"
/// @throws InputError when it is not a number with a unit of this dimension.
double value_with_unit(const std::string& word, Dimension dimension, const std::string& option);

/// One standard deviation, relative to the value or absolute.
struct StatedError {
  double relative = 0.0;  ///< [1]
  double absolute = 0.0;  ///< SI

  bool stated() const { return relative > 0.0 || absolute > 0.0; }
  double of(double value) const { return relative * value + absolute; }
};

/// "2%" is relative, "0.5mm" absolute, an empty word states nothing. Restitutions are given without
/// a unit. @throws InputError
StatedError stated_error(const std::string& word, Dimension dimension, const std::string& option);

/// Splits at commas that are not inside quotation marks, blanks around the parts dropped.
std::vector<std::string> split_list(std::string_view text);

/// All parts of options that may be given several times, each a list.
std::vector<std::string> split_lists(const std::vector<std::string>& lists);

/// "name=value" at the first '='; nullopt when there is none.
std::optional<std::pair<std::string, std::string>> split_pair(const std::string& word);

/// An imported point, SI.
struct ImportedPoint {
  std::string series;
  std::string setting;                              ///< empty where the file has none
  std::string launch;                               ///< of timed bounces; empty: none
  PerValue<Quantity, std::optional<double>> value;  ///< of all quantities but texts
  int line = 0;                                     ///< in the file

  /// e, from the rebound velocity where that is given; nullopt where all were captured.
  std::optional<double> restitution() const;
};

struct ImportedPoints {
  std::vector<ImportedPoint> points;
  std::vector<ImportNote> notes;
};

/// The name of the series where the file has none: --series, or the name of the file.
std::string default_series(const ImportRequest& request);

/// The diameter of a sphere of `series` [m]: that of the file, or of --diameter, or of the name of
/// the series ("2.58 um", "d = 4.9um on Mo"); nullopt when it is not stated.
std::optional<double> known_diameter(const ImportRequest& request, const std::string& series,
                                     std::optional<double> in_file);

/// Gives every point its diameter and its error.
/// @throws InputError for a point without one, and for a --diameter that no series has.
void settle_diameters(const ImportRequest& request, ImportedPoints& imported);

/// --gravity [m/s2].
double gravity_of(const ImportRequest& request);

/// How the numbers of the file are written.
NumberFormat number_format(const ImportRequest& request);

/// Rows of the request's file. The delimiter is the tab, semicolon, comma or bar, or else the
/// blank, that gives all lines the same number of cells; a first line `sep=;` states it. Lines that
/// begin with '#' are comments, unless they head the columns. What is not UTF-8 is read as
/// Windows-1252.
/// @param notes what was skipped or assumed
/// @throws InputError when the file has no rows.
std::vector<CsvRow> import_rows(const ImportRequest& request, std::vector<ImportNote>& notes);

/// The text of a table as it is in the file; of a workbook the first sheet, by xlsx2csv or
/// ssconvert. @throws InputError for a workbook where neither is installed, and for UTF-16
std::string table_text(const ImportRequest& request, std::vector<ImportNote>& notes);

/// A quantity that a format knows.
struct ImportQuantity {
  std::string name;  ///< left of '=' in --map
  Dimension dimension = Dimension::text;
  bool needed = false;
};

/// Field -> unit, where something else than the file and --map states it.
using FieldUnits = std::map<std::string, std::string>;

/// A table whose columns are tied to quantities by --map. Columns without a header are called 1, 2,
/// ... A cell "0.85 ± 0.02" (or +-) holds a value and its standard deviation.
class ImportTable {
 public:
  /// Entries of --map are "quantity=column:unit", where the unit may have a factor ("0.35mm"), or
  /// "quantity=100cm", a constant. Several columns "a+b" of a text are joined; of a number they are
  /// replicates: every row of the file is then as many rows here.
  /// @param units of columns called like their quantities, where neither --map nor the file states
  ///   one
  /// @throws InputError for an unknown quantity or column, a unit that is missing or measures
  ///   something else, and a needed quantity without a column.
  ImportTable(const ImportRequest& request, const std::vector<ImportQuantity>& known,
              const FieldUnits& units = {});

  std::size_t size() const { return rows_.size() * replicates_; }
  bool has(const std::string& quantity) const { return columns_.contains(quantity); }
  bool has_replicates() const { return replicates_ > 1; }
  /// Is there such a column, and does this cell say that its value is not known?
  bool lacks(std::size_t row, const std::string& quantity) const;
  /// Is the column of this quantity called by its name?
  bool is_named(const std::string& quantity) const;
  /// Keeps in mind that a row has no use because a cell is empty.
  void leave_out(std::size_t row);
  /// What was skipped, assumed and left out. @throws InputError where all rows were.
  std::vector<ImportNote> notes() const;

  /// In SI; nullopt when the cell is empty or there is no such column. @throws InputError
  std::optional<double> value(std::size_t row, const std::string& quantity) const;
  /// The same for a quantity that every row needs.
  double needed(std::size_t row, const std::string& quantity) const;
  /// @throws InputError unless it is positive.
  double positive(std::size_t row, const std::string& quantity) const;
  std::string text(std::size_t row, const std::string& quantity) const;
  /// The same, or the name of the series where that is empty.
  std::string name(std::size_t row, const std::string& quantity) const;
  int line(std::size_t row) const { return cells(row).front().line; }

  /// @throws InputError unless one of the two quantities has a column. @param how to name it
  void require_one_of(const std::string& one, const std::string& other,
                      const std::string& how) const;
  /// @throws InputError at the cell of a quantity.
  [[noreturn]] void fail(std::size_t row, const std::string& quantity, const std::string& problem,
                         const std::string& why, const std::string& suggestion) const;

  /// Header names that no quantity uses.
  std::vector<std::string> unused() const;

 private:
  struct Source {
    std::vector<std::size_t> at;     ///< columns
    std::vector<Scale> scale;        ///< of each, where they hold numbers
    std::optional<double> constant;  ///< SI, instead of columns
  };

  void read_header();
  void read_map(const std::string& entry);
  void find_columns_by_name();
  void settle_replicates();
  std::vector<std::string> header_names() const;
  std::size_t column_named(const std::string& name) const;
  Scale scale_of(const ImportQuantity& quantity, const std::string& unit, std::size_t column) const;
  const CsvRow& cells(std::size_t row) const { return rows_[row / replicates_]; }
  /// The cell of a quantity in a row, and the scale of its column.
  std::pair<const CsvField*, Scale> cell_of(std::size_t row, const Source& source) const;
  double number(const CsvField& cell, const std::string& text, const std::string& quantity) const;
  std::optional<double> error_beside(std::size_t row, const std::string& quantity) const;

  std::vector<ImportNote> notes_;
  std::string file_;
  std::string series_;  ///< name of the series where the file has none
  NumberFormat format_;
  std::vector<ImportQuantity> known_;
  FieldUnits field_units_;
  CsvRow header_;
  CsvRow units_;       ///< a row below the header that has nothing but units; may be empty
  bool named_ = true;  ///< the columns have a header
  std::vector<CsvRow> rows_;
  std::size_t replicates_ = 1;
  std::map<std::string, Source> columns_;
  std::set<std::size_t> left_out_;  ///< rows
};

}  // namespace recoil
