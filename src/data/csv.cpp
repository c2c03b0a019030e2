#include "data/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "data/text.hpp"

namespace recoil {
namespace {

/// Longer cells are refused [bytes]. They come from an unclosed quotation mark, or from a file that
/// is not a table.
constexpr std::size_t longest_cell = 10000;

class CsvReader {
 public:
  CsvReader(std::string_view text, const std::string& file, char delimiter, char comment)
      : text_(text), file_(file), delimiter_(delimiter), comment_(comment) {}

  /// Reads the next row that is not blank. @returns false at the end of the text.
  bool next(CsvRow& row) {
    row.clear();
    skip_blanks();
    while (!at_end() && (at_line_end() || at_comment())) {
      while (!at_line_end()) step();
      if (!at_end()) step();
      skip_blanks();
    }
    if (at_end()) return false;
    row.push_back(cell());
    while (!at_line_end()) {
      step();  // past the delimiter
      if (delimiter_ == ' ') {
        skip_blanks();
        if (at_line_end()) break;
      }
      row.push_back(cell());
    }
    return true;
  }

 private:
  bool at_end() const { return at_ == text_.size(); }
  char peek() const { return text_[at_]; }
  bool at_line_end() const { return at_end() || peek() == '\n' || peek() == '\r'; }
  bool at_comment() const { return comment_ != '\0' && peek() == comment_; }
  bool at_cell_end() const {
    return at_line_end() || peek() == delimiter_ || (delimiter_ == ' ' && peek() == '\t');
  }
  bool at_blank() const {
    return !at_end() && (peek() == ' ' || (peek() == '\t' && delimiter_ != '\t'));
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
      const std::size_t begin = at_;
      while (!at_cell_end()) {
        if (peek() == '"') fail_inside();
        step();
      }
      if (at_ - begin > longest_cell) fail_too_long(field);
      field.text = trimmed(text_.substr(begin, at_ - begin));
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
    if (delimiter_ != ' ') skip_blanks();
    if (!at_cell_end()) fail_inside();
  }

  void append(CsvField& field) {
    if (field.text.size() == longest_cell) fail_too_long(field);
    field.text += step();
  }

  [[noreturn]] void fail_too_long(const CsvField& field) const {
    throw InputError({file_, field.line, field.column},
                     fmt::format("a cell has more than {} characters", longest_cell), "",
                     "look for a quotation mark that is never closed");
  }

  [[noreturn]] void fail_inside() const {
    throw InputError({file_, line_, column_}, "a quotation mark in the middle of a cell",
                     "a quoted cell begins and ends with one",
                     "write \"\" for a mark inside a quoted cell");
  }

  std::string_view text_;
  const std::string& file_;
  char delimiter_;
  char comment_;
  std::size_t at_ = 0;
  int line_ = 1;
  int column_ = 1;
};

}  // namespace

void read_csv(std::string_view text, const std::string& file, char delimiter,
              const std::function<void(CsvRow&)>& on_row, char comment) {
  CsvReader reader(text, file, delimiter, comment);
  CsvRow row;
  while (reader.next(row)) on_row(row);
}

std::optional<double> parse_number(std::string_view text, const NumberFormat& format) {
  const bool plain_digits = text.find_first_not_of("0123456789.") == text.npos;
  if (plain_digits && format.decimal == "." && format.group.empty()) return parse_number(text);
  std::string plain(trimmed(text));
  replace_all(plain, "\u2212", "-");  // the minus of mathematics
  std::size_t whole =
      std::min({plain.find(format.decimal), plain.find_first_of("eE"), plain.size()});
  const std::size_t mark = format.group.size();
  std::size_t at = mark == 0 ? whole : plain.find(format.group);
  const std::size_t longest = plain.starts_with('-') || plain.starts_with('+') ? 4 : 3;
  if (at < whole && (at == 0 || at > longest)) return std::nullopt;
  for (; at < whole; at += 3) {  // removes the group marks
    const std::size_t end = at + mark + 3;
    const bool three = end <= whole && plain.find_first_not_of("0123456789", at + mark) >= end &&
                       (end == whole || plain.compare(end, mark, format.group) == 0);
    if (!three) return std::nullopt;
    plain.erase(at, mark);
    whole -= mark;
  }
  if (format.decimal != ".") {
    if (plain.find('.') != std::string::npos) return std::nullopt;
    const std::size_t point = plain.find(format.decimal);
    if (point != std::string::npos) plain.replace(point, format.decimal.size(), ".");
  }
  return parse_number(plain);
}

void DecimalCommas::see(std::string_view cell) {
  const std::size_t comma = cell.find(',');
  const bool three_follow = comma != cell.npos && cell.size() == comma + 4;
  comma_ = comma_ || (comma != cell.npos && !three_follow && parse_number(cell, {","}));
  point_ = point_ || (cell.find('.') != cell.npos && parse_number(cell, {}));
}

double number_in(const CsvField& cell, const std::string& file, const std::string& what,
                 const NumberFormat& format) {
  if (const auto value = parse_number(cell.text, format)) return *value;
  std::string word = cell.text;
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  std::string suggestion = "write a decimal number such as 4.9 or 4.9e-6";
  const std::size_t comma = word.find(',');
  if (format.decimal != ".") {
    suggestion = fmt::format(
        "decimals are written with '{}' here{}", format.decimal,
        format.group.empty() ? ", and digits are not grouped"
                             : fmt::format(", digits grouped in threes with '{}'", format.group));
  } else if (comma != std::string::npos) {
    const bool threes = word.size() == comma + 4;  // 1,250
    const std::string joined = word.substr(0, comma) + word.substr(comma + 1);
    word[comma] = '.';
    suggestion =
        !parse_number(word) ? "write decimals with a point"
        : threes && parse_number(joined)
            ? fmt::format("write {} if the comma groups thousands, {} if it is a decimal comma",
                          joined, word)
            : fmt::format(
                  "a decimal comma? write {}, or state it: --decimal-comma at an import, "
                  "decimalChar in a schema",
                  word);
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
                   "this row has " + counted(row.size(), "cell"),
                   fmt::format("the header has {}", width),
                   too_many ? "write decimals with a point (1.5), and quote text that has commas"
                            : "leave a cell empty when its value is not known, but keep the comma");
}

char delimiter_of(std::string_view header) {
  char best = ',';
  for (const char candidate : {';', '\t'}) {
    if (std::ranges::count(header, candidate) > std::ranges::count(header, best)) best = candidate;
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
