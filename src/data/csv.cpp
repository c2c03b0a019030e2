#include "data/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "data/text.hpp"

namespace recoil {
namespace {

/// Longer cells are refused. They come from a quotation mark that is never closed, or from a file
/// that is not a table [bytes].
constexpr std::size_t longest_cell = 10000;

class CsvReader {
 public:
  CsvReader(std::string_view text, const std::string& file, char delimiter)
      : text_(text), file_(file), delimiter_(delimiter) {}

  /// Reads the next row that is not blank. @returns false at the end of the text.
  bool next(CsvRow& row) {
    row.clear();
    skip_blanks();
    while (!at_end() && at_line_end()) {
      step();
      skip_blanks();
    }
    if (at_end()) return false;
    row.push_back(cell());
    while (!at_line_end()) {
      step();  // past the delimiter
      row.push_back(cell());
    }
    return true;
  }

 private:
  bool at_end() const { return at_ == text_.size(); }
  char peek() const { return text_[at_]; }
  bool at_line_end() const { return at_end() || peek() == '\n' || peek() == '\r'; }
  bool at_cell_end() const { return at_line_end() || peek() == delimiter_; }
  bool at_blank() const {
    return !at_end() && (peek() == ' ' || peek() == '\t') && peek() != delimiter_;
  }

  char step() {
    const char byte = text_[at_++];
    const bool line_continues = byte == '\r' && !at_end() && peek() == '\n';
    if ((byte == '\n' || byte == '\r') && !line_continues) {
      ++line_;
      column_ = 1;
    } else if ((static_cast<unsigned char>(byte) & 0xC0U) != 0x80U) {
      ++column_;  // UTF-8 continuation bytes belong to the character before
    }
    return byte;
  }

  void skip_blanks() {
    while (at_blank()) step();
  }

  CsvField cell() {
    skip_blanks();
    CsvField field{"", line_, column_};
    if (!at_end() && peek() == '"') {
      read_quoted(field);
    } else {
      while (!at_cell_end()) {
        if (peek() == '"') fail_inside();
        append(field);
      }
      field.text.erase(field.text.find_last_not_of(" \t") + 1);
    }
    return field;
  }

  void read_quoted(CsvField& field) {
    step();  // past the opening mark
    while (true) {
      if (at_end()) {
        throw InputError({file_, field.line, field.column}, "this quotation mark is never closed",
                         "", "close it with another \"");
      }
      if (peek() == '"') {
        step();
        if (at_end() || peek() != '"') break;  // a doubled mark is one mark of the cell
      }
      append(field);
    }
    skip_blanks();
    if (!at_cell_end()) fail_inside();
  }

  void append(CsvField& field) {
    if (field.text.size() == longest_cell) {
      throw InputError({file_, field.line, field.column},
                       fmt::format("a cell has more than {} characters", longest_cell), "",
                       "look for a quotation mark that is never closed");
    }
    field.text += step();
  }

  [[noreturn]] void fail_inside() const {
    throw InputError({file_, line_, column_}, "a quotation mark in the middle of a cell",
                     "a quoted cell begins and ends with one",
                     "write \"\" for a mark inside a quoted cell");
  }

  std::string_view text_;
  const std::string& file_;
  char delimiter_;
  std::size_t at_ = 0;
  int line_ = 1;
  int column_ = 1;
};

}  // namespace

void read_csv(std::string_view text, const std::string& file, char delimiter,
              const std::function<void(const CsvRow&)>& on_row) {
  CsvReader reader(text, file, delimiter);
  CsvRow row;
  while (reader.next(row)) on_row(row);
}

double number_in(const CsvField& cell, const std::string& file, const std::string& what) {
  if (const auto value = parse_number(cell.text)) return *value;
  std::string word = cell.text;
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::string suggestion = "write a decimal number such as 4.9 or 4.9e-6";
  const std::size_t comma = word.find(',');
  if (comma != std::string::npos) {
    word[comma] = '.';
    suggestion = parse_number(word) ? fmt::format("a decimal comma? write {}", word)
                                    : "write decimals with a point";
  } else if (word.find("nan") != std::string::npos || word.find("inf") != std::string::npos ||
             word == "na" || word == "null" || word == "-") {
    suggestion = "remove the row, or leave the cell empty if the column is optional";
  }
  throw InputError(cell.in(file), fmt::format("{} is not a number", quote(cell.text)),
                   fmt::format("{} has to be a finite number", what), suggestion);
}

void require_width(const CsvRow& row, std::size_t width, const std::string& file) {
  if (row.size() == width) return;
  const bool too_many = row.size() > width;
  throw InputError((too_many ? row[width] : row.back()).in(file),
                   fmt::format("this row has {} cell{}", row.size(), row.size() == 1 ? "" : "s"),
                   fmt::format("the header has {}", width),
                   too_many ? "write decimals with a point (1.5), and quote text that has commas"
                            : "leave a cell empty when its value is not known, but keep the comma");
}

char delimiter_of(std::string_view header) {
  char best = ',';
  for (const char candidate : {';', '\t'}) {
    if (std::count(header.begin(), header.end(), candidate) >
        std::count(header.begin(), header.end(), best)) {
      best = candidate;
    }
  }
  return best;
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c;
    if (c == '"') quoted += c;
  }
  return quoted + "\"";
}

}  // namespace recoil
