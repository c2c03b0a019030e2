#include "data/csv_table.hpp"

#include <csv.h>
#include <fmt/format.h>

#include <new>

#include "core/error.hpp"

namespace recoil {
namespace {

/// Longer cells are refused: they come from a quotation mark that is never closed, or from a file
/// that is no table [bytes].
constexpr std::size_t longest_cell = 10000;

/// libcsv tells the content of a field but not its place, so it is fed one byte at a time and the
/// place of the first byte of each field is kept beside it.
class CsvReader {
 public:
  CsvReader(const std::string& file, char delimiter) : file_(file), delimiter_(delimiter) {
    if (csv_init(&parser_, CSV_STRICT | CSV_STRICT_FINI) != 0) throw std::bad_alloc();
    csv_set_delim(&parser_, static_cast<unsigned char>(delimiter));
  }
  ~CsvReader() { csv_free(&parser_); }
  CsvReader(const CsvReader&) = delete;
  CsvReader& operator=(const CsvReader&) = delete;

  void read(std::string_view text, const std::function<void(const CsvRow&)>& on_row) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      const char byte = text[i];
      note_start(byte);
      if (inside_field_ && ++field_bytes_ > longest_cell) fail_endless();
      if (csv_parse(&parser_, &byte, 1, on_field, on_row_end, this) != 1) fail_inside();
      deliver(on_row);
      step(byte, i + 1 < text.size() ? text[i + 1] : '\0');
    }
    note_start('\n');
    if (csv_fini(&parser_, on_field, on_row_end, this) != 0) fail_at_end();
    deliver(on_row);
  }

 private:
  static void on_field(void* data, std::size_t size, void* self) {
    auto& reader = *static_cast<CsvReader*>(self);
    reader.row_.push_back({std::string(static_cast<const char*>(data), size), reader.field_line_,
                           reader.field_column_});
    reader.inside_field_ = false;
  }

  static void on_row_end(int, void* self) { static_cast<CsvReader*>(self)->row_complete_ = true; }

  void note_start(char byte) {
    if (inside_field_) return;
    field_line_ = line_;
    field_column_ = column_;
    const bool blank = byte == ' ' || byte == '\t';
    const bool ends = byte == delimiter_ || byte == '\n' || byte == '\r';
    if (blank || ends) return;
    inside_field_ = true;
    field_bytes_ = 0;
  }

  void step(char byte, char next) {
    if (byte == '\n' || (byte == '\r' && next != '\n')) {
      ++line_;
      column_ = 1;
    } else if ((static_cast<unsigned char>(byte) & 0xC0U) != 0x80U) {
      ++column_;  // UTF-8 continuation bytes belong to the character before
    }
  }

  void deliver(const std::function<void(const CsvRow&)>& on_row) {
    if (!row_complete_) return;
    row_complete_ = false;
    on_row(row_);
    row_.clear();
  }

  [[noreturn]] void fail_inside() {
    if (csv_error(&parser_) == CSV_ENOMEM) throw std::bad_alloc();
    throw InputError({file_, line_, column_}, "a quotation mark in the middle of a cell",
                     "a quoted cell begins and ends with one",
                     "write \"\" for a mark inside a quoted cell");
  }

  [[noreturn]] void fail_endless() const {
    throw InputError({file_, field_line_, field_column_},
                     fmt::format("a cell has more than {} characters", longest_cell), "",
                     "look for a quotation mark that is never closed");
  }

  [[noreturn]] void fail_at_end() {
    if (csv_error(&parser_) == CSV_ENOMEM) throw std::bad_alloc();
    throw InputError({file_, field_line_, field_column_}, "this quotation mark is never closed", "",
                     "close it with another \"");
  }

  csv_parser parser_{};
  std::string file_;
  char delimiter_;
  int line_ = 1;
  int column_ = 1;
  int field_line_ = 1;
  int field_column_ = 1;
  std::size_t field_bytes_ = 0;
  bool inside_field_ = false;
  bool row_complete_ = false;
  CsvRow row_;
};

}  // namespace

void read_csv(std::string_view text, const std::string& file, char delimiter,
              const std::function<void(const CsvRow&)>& on_row) {
  CsvReader(file, delimiter).read(text, on_row);
}

}  // namespace recoil
