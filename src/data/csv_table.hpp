#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace recoil {

/// One cell and where its first character stands (lines and columns from 1).
struct CsvField {
  std::string text;
  int line = 0;
  int column = 0;
};

using CsvRow = std::vector<CsvField>;

/// Reads delimiter-separated text (RFC 4180, by libcsv in its strict mode) and hands over one row
/// after the other, the header first. Blank lines are skipped; blanks around unquoted cells are
/// dropped. The text is never held as a table, so a large file costs one row of memory.
///
/// @param file the name that messages give.
/// @throws InputError for an unterminated quote or a quote in the wrong place, and whatever
///   `on_row` throws.
void read_csv(std::string_view text, const std::string& file, char delimiter,
              const std::function<void(const CsvRow&)>& on_row);

}  // namespace recoil
