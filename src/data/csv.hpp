#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace recoil {

/// One cell and the place of its first character (lines and columns from 1).
struct CsvField {
  std::string text;
  int line = 0;
  int column = 0;

  Location in(const std::string& file) const { return {file, line, column}; }
};

using CsvRow = std::vector<CsvField>;

/// Reads delimiter-separated text (RFC 4180) and calls `on_row` for one row after the other, the
/// header first. Blank lines and blanks around unquoted cells are skipped (see `trimmed`). Only one
/// row is in memory at a time; `on_row` may move it away.
///
/// @param file its name in messages
/// @param delimiter between cells; ' ' stands for any number of blanks and tabs
/// @param comment lines that begin with it are skipped; '\0': none
/// @throws InputError for a quotation mark that is not closed or in the wrong place and for a cell
///   of more than 10,000 bytes; and what `on_row` throws.
void read_csv(std::string_view text, const std::string& file, char delimiter,
              const std::function<void(CsvRow&)>& on_row, char comment = '\0');

/// The notation of numbers in a table: 2.5 or 2,5, and 2500 or 2.500 (Table Schema: decimalChar,
/// groupChar).
struct NumberFormat {
  std::string decimal = ".";
  std::string group = "";  ///< between groups of three digits; empty: none
};

/// Parses a finite number in this format. nullopt for any other text, also with another mark than
/// the format's or with groups that do not have three digits.
std::optional<double> parse_number(std::string_view text, const NumberFormat& format);

/// Finds out whether the numbers of a table have decimal commas: some have a comma that does not
/// group thousands, and none has a point.
class DecimalCommas {
 public:
  void see(std::string_view cell);
  bool found() const { return comma_ && !point_; }

 private:
  bool comma_ = false;
  bool point_ = false;
};

/// The finite number in a cell. @param what it means, for the message: "diameter in um"
/// @throws InputError at the cell
double number_in(const CsvField& cell, const std::string& file, const std::string& what,
                 const NumberFormat& format = {});

/// @throws InputError unless the row has as many cells as the header
void require_width(const CsvRow& row, std::size_t width, const std::string& file);

/// The most frequent of comma, semicolon and tab in a header line.
char delimiter_of(std::string_view header);

/// `text` as a cell of a comma-separated file, quoted if necessary (RFC 4180).
std::string csv_cell(const std::string& text);

}  // namespace recoil
