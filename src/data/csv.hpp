#pragma once

#include <functional>
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

/// Reads delimiter-separated text (RFC 4180) and hands over one row after the other, the header
/// first. Blank lines are skipped; blanks around unquoted cells are dropped. The text is never held
/// as a table, so a large file costs one row of memory.
///
/// @param file the name that messages give.
/// @throws InputError for a quotation mark that is not closed or in the wrong place and for a cell
///   of more than 10,000 bytes; and what `on_row` throws.
void read_csv(std::string_view text, const std::string& file, char delimiter,
              const std::function<void(const CsvRow&)>& on_row);

/// The finite number in a cell. @param what it has to be, for the message: "diameter in um"
/// @throws InputError at the cell
double number_in(const CsvField& cell, const std::string& file, const std::string& what);

/// @throws InputError for a row that has not as many cells as the header.
void require_width(const CsvRow& row, std::size_t width, const std::string& file);

/// The delimiter of a file with this header: the most frequent of comma, semicolon and tab.
char delimiter_of(std::string_view header);

/// `text` as a cell of a comma-separated file, quoted where it has to be (RFC 4180).
std::string csv_cell(const std::string& text);

}  // namespace recoil
