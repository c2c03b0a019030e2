#include "experiment/excel97.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "experiment/workbook_cells.hpp"

namespace recoil {
namespace {

/// Little-endian numbers of a block of bytes. Reading past its end is a damaged file.
class Bytes {
 public:
  Bytes(std::string_view bytes, const WorkbookErrors& errors) : bytes_(bytes), errors_(&errors) {}

  std::size_t size() const { return bytes_.size(); }

  std::string_view part(std::size_t at, std::size_t length) const {
    if (at > bytes_.size() || length > bytes_.size() - at) errors_->fail_damaged("it is cut off");
    return bytes_.substr(at, length);
  }
  template <class Number>
  Number number(std::size_t at) const {
    static_assert(std::endian::native == std::endian::little);
    Number value = {};
    std::memcpy(&value, part(at, sizeof(Number)).data(), sizeof(Number));
    return value;
  }
  std::size_t u8(std::size_t at) const { return number<std::uint8_t>(at); }
  std::size_t u16(std::size_t at) const { return number<std::uint16_t>(at); }
  std::uint32_t u32(std::size_t at) const { return number<std::uint32_t>(at); }

 private:
  std::string_view bytes_;
  const WorkbookErrors* errors_;
};

void append_utf8(std::string& text, std::uint32_t code) {
  const auto put = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (code < 0x80) return put(code);
  if (code < 0x800) {
    put(0xC0 | (code >> 6));
  } else {
    if (code < 0x10000) {
      put(0xE0 | (code >> 12));
    } else {
      put(0xF0 | (code >> 18));
      put(0x80 | ((code >> 12) & 0x3F));
    }
    put(0x80 | ((code >> 6) & 0x3F));
  }
  put(0x80 | (code & 0x3F));
}

/// UTF-8 of UTF-16. A half of a pair alone, and NUL, become U+FFFD.
std::string utf8(const std::u16string& units) {
  constexpr std::uint32_t unknown = 0xFFFD;
  std::string text;
  for (std::size_t i = 0; i < units.size(); ++i) {
    std::uint32_t code = units[i];
    const bool pair = code >= 0xD800 && code < 0xDC00 && i + 1 < units.size() &&
                      units[i + 1] >= 0xDC00 && units[i + 1] < 0xE000;
    if (pair) code = 0x10000 + ((code - 0xD800) << 10) + (units[++i] - 0xDC00U);
    if (code == 0 || (code >= 0xD800 && code < 0xE000)) code = unknown;
    append_utf8(text, code);
  }
  return text;
}

/// The streams of a compound file: chains of sectors, like a file system.
class CompoundFile {
 public:
  CompoundFile(std::string_view bytes, const WorkbookErrors& errors)
      : file_(bytes, errors), errors_(errors) {
    const std::size_t shift = file_.u16(30);
    if (shift != 9 && shift != 12) errors_.fail_damaged("its sectors have no known size");
    sector_ = std::size_t{1} << shift;
    read_table();
    const std::string directory = chain(file_.u32(48));
    const Bytes entries(directory, errors_);
    for (std::size_t at = 0; at + entry_size <= directory.size(); at += entry_size) {
      const std::size_t length = entries.u16(at + 64);  // of the name [bytes], with a NUL
      if (length < 4 || length > 64) continue;
      std::u16string name;
      for (std::size_t i = 0; i + 2 < length; i += 2) {
        name += static_cast<char16_t>(entries.u16(at + i));
      }
      const Entry entry{entries.u32(at + 116), entries.u32(at + 120)};
      if (entries.u8(at + 66) == root_storage) root_ = entry;
      if (entries.u8(at + 66) == stream_object) streams_.emplace(utf8(name), entry);
    }
  }

  bool has(const std::string& name) const { return streams_.contains(name); }

  std::string stream(const std::string& name) const {
    const Entry entry = streams_.at(name);
    const bool small = entry.size < file_.u32(56);
    std::string content = small ? small_chain(entry.first) : chain(entry.first);
    if (entry.size > content.size()) errors_.fail_damaged(name + " is cut off");
    content.resize(entry.size);
    return content;
  }

 private:
  static constexpr std::size_t entry_size = 128;
  static constexpr std::size_t stream_object = 2;
  static constexpr std::size_t root_storage = 5;
  static constexpr std::size_t small_sector = 64;
  static constexpr std::uint32_t last_sector = 0xFFFFFFFA;  // what is greater has other meanings

  struct Entry {
    std::uint32_t first = last_sector + 1;
    std::uint32_t size = 0;
  };

  /// The last sector of a file may be cut off.
  std::string_view sector(std::uint32_t number) const {
    const std::size_t at = (std::size_t{number} + 1) * sector_;
    if (at >= file_.size()) errors_.fail_damaged("a sector is missing");
    return file_.part(at, std::min(sector_, file_.size() - at));
  }

  void append_sectors(std::vector<std::uint32_t>& table, std::string_view content) const {
    const Bytes numbers(content, errors_);
    for (std::size_t at = 0; at + 4 <= content.size(); at += 4) table.push_back(numbers.u32(at));
  }

  /// The table of the next sectors. Its own sectors are listed in the header and in a chain, the
  /// last number of each of whose sectors is the next one.
  void read_table() {
    std::vector<std::uint32_t> own;
    append_sectors(own, file_.part(76, 436));
    std::uint32_t more = file_.u32(68);
    for (std::size_t steps = 0; more <= last_sector; ++steps) {
      if (steps > file_.size() / sector_) errors_.fail_damaged("a chain of sectors is a ring");
      append_sectors(own, sector(more));
      more = own.back();
      own.pop_back();
    }
    if (own.size() > 109 + file_.size() / sector_) errors_.fail_damaged("its table is too long");
    for (const std::uint32_t number : own) {
      if (number <= last_sector) append_sectors(next_, sector(number));
    }
  }

  /// The numbers of a chain. @param most sectors that there can be
  std::vector<std::uint32_t> numbers(std::uint32_t first, const std::vector<std::uint32_t>& next,
                                     std::size_t most) const {
    std::vector<std::uint32_t> chain;
    for (std::uint32_t at = first; at <= last_sector; at = next[at]) {
      if (at >= next.size() || chain.size() > most) {
        errors_.fail_damaged("a chain of sectors is broken");
      }
      chain.push_back(at);
    }
    return chain;
  }

  std::string chain(std::uint32_t first) const {
    std::string content;
    for (const std::uint32_t number : numbers(first, next_, file_.size() / sector_)) {
      content += sector(number);
    }
    return content;
  }

  /// A small stream: sectors of 64 bytes within the stream of the root.
  std::string small_chain(std::uint32_t first) const {
    const std::string all = chain(root_.first);
    std::vector<std::uint32_t> next;
    append_sectors(next, chain(file_.u32(60)));
    const Bytes sectors(all, errors_);
    std::string content;
    for (const std::uint32_t number : numbers(first, next, all.size() / small_sector)) {
      content += sectors.part(number * small_sector, small_sector);
    }
    return content;
  }

  Bytes file_;
  const WorkbookErrors& errors_;
  std::size_t sector_ = 0;
  std::vector<std::uint32_t> next_;
  std::map<std::string, Entry> streams_;
  Entry root_;
};

/// Kinds of records ([MS-XLS] 2.3).
enum Record : std::size_t {
  bof = 0x0809,
  end_of_part = 0x000A,
  bound_sheet = 0x0085,
  file_pass = 0x002F,
  date_1904 = 0x0022,
  format_record = 0x041E,
  style = 0x00E0,
  shared_texts = 0x00FC,
  continued = 0x003C,
  number_cell = 0x0203,
  short_cell = 0x027E,
  short_cells = 0x00BD,
  shared_text_cell = 0x00FD,
  text_cell = 0x0204,
  rich_text_cell = 0x00D6,
  truth_or_error = 0x0205,
  formula = 0x0006,
  formula_text = 0x0207,
};

/// A text that may go on in the next records, each of which states anew how wide its letters are.
class Texts {
 public:
  Texts(const std::vector<Bytes>& parts, const WorkbookErrors& errors)
      : parts_(parts), errors_(errors) {}

  void skip(std::size_t bytes) {
    while (bytes > 0) {
      const std::size_t here = std::min(bytes, left());
      if (here == 0) next_part();
      at_ += here;
      bytes -= here;
    }
  }

  /// A text whose length has two bytes, or one.
  std::string text(bool short_length) {
    std::size_t length = byte();
    if (!short_length) length += byte() << 8;
    std::size_t flags = byte();
    const std::size_t runs = (flags & 8U) != 0 ? byte() + (byte() << 8) : 0;
    std::size_t phonetic = 0;
    for (unsigned shift = 0; (flags & 4U) != 0 && shift < 32; shift += 8)
      phonetic += byte() << shift;
    std::u16string units;
    while (units.size() < length) {
      if (left() == 0) {
        next_part();
        flags = byte();
      }
      std::size_t unit = byte();
      if ((flags & 1U) != 0) unit += byte() << 8;
      units += static_cast<char16_t>(unit);
    }
    skip(4 * runs + phonetic);
    return utf8(units);
  }

 private:
  std::size_t left() const { return parts_[part_].size() - at_; }
  void next_part() {
    if (++part_ == parts_.size()) {
      part_ = 0;
      errors_.fail_damaged("a text is cut off");
    }
    at_ = 0;
  }
  std::size_t byte() {
    while (left() == 0) next_part();
    return parts_[part_].u8(at_++);
  }

  const std::vector<Bytes>& parts_;
  const WorkbookErrors& errors_;
  std::size_t part_ = 0;
  std::size_t at_ = 0;
};

/// The number in four bytes: 30 bits of a whole number or of the upper part of a double, perhaps a
/// hundredth of it.
double short_number(std::uint32_t bits) {
  const bool whole = (bits & 2U) != 0;
  const double value =
      whole ? static_cast<double>(static_cast<std::int32_t>(bits) >> 2)
            : std::bit_cast<double>(static_cast<std::uint64_t>(bits & 0xFFFFFFFCU) << 32U);
  return (bits & 1U) != 0 ? value / 100.0 : value;
}

std::string error_word(std::size_t code) {
  static const std::map<std::size_t, std::string> words = {
      {0x00, "#NULL!"}, {0x07, "#DIV/0!"}, {0x0F, "#VALUE!"}, {0x17, "#REF!"},
      {0x1D, "#NAME?"}, {0x24, "#NUM!"},   {0x2A, "#N/A"}};
  const auto found = words.find(code);
  return found == words.end() ? "#ERROR" : found->second;
}

class Excel97Reader {
 public:
  Excel97Reader(const std::string& stream, const WorkbookErrors& errors, char decimal)
      : stream_(stream, errors), errors_(errors), cells_(errors, decimal) {}

  Sheet read(const std::string& name) {
    each_record(0, [&](std::size_t kind, const Bytes& data, std::size_t at) {
      read_global(kind, data, at);
    });
    const std::size_t chosen = chosen_sheet(sheets_, name, errors_);
    each_record(starts_[chosen], [&](std::size_t kind, const Bytes& data, std::size_t at) {
      read_cell(kind, data, at);
    });
    Sheet sheet{cells_.table(), sheets_[chosen].name, {}};
    for (std::size_t i = 0; i < sheets_.size(); ++i) {
      if (i != chosen) sheet.others.push_back(sheets_[i].name);
    }
    return sheet;
  }

 private:
  /// Calls `read` for the records of the part that begins here. Charts within it are skipped.
  template <class Read>
  void each_record(std::size_t at, const Read& read) const {
    if (stream_.u16(at) != bof) errors_.fail_damaged("a part does not begin");
    if (stream_.u16(at + 4) != 0x0600) errors_.fail_other_kind();
    int depth = 0;
    while (true) {
      const std::size_t kind = stream_.u16(at);
      const std::size_t length = stream_.u16(at + 2);
      const Bytes data(stream_.part(at + 4, length), errors_);
      if (kind == bof) ++depth;
      if (kind == end_of_part && --depth == 0) return;
      if (depth == 1) read(kind, data, at);
      at += 4 + length;
    }
  }

  /// The content of a record and of those that continue it.
  std::vector<Bytes> with_continued(const Bytes& data, std::size_t at) const {
    std::vector<Bytes> parts = {data};
    at += 4 + data.size();
    while (at + 4 <= stream_.size() && stream_.u16(at) == continued) {
      const std::size_t length = stream_.u16(at + 2);
      parts.emplace_back(stream_.part(at + 4, length), errors_);
      at += 4 + length;
    }
    return parts;
  }

  std::string text_at(const Bytes& data, std::size_t at, std::size_t offset,
                      bool short_length) const {
    const std::vector<Bytes> parts = with_continued(data, at);
    Texts texts(parts, errors_);
    texts.skip(offset);
    return texts.text(short_length);
  }

  void read_global(std::size_t kind, const Bytes& data, std::size_t at) {
    if (kind == file_pass) errors_.fail_encrypted();
    if (kind == date_1904) epoch_ = first_day(data.u16(0) == 1);
    if (kind == format_record) dates_[data.u16(0)] = shows_date(text_at(data, at, 2, false));
    if (kind == style) formats_.push_back(data.u16(2));
    if (kind == bound_sheet && data.u8(5) == 0) {  // no chart
      sheets_.push_back({text_at(data, at, 6, true), data.u8(4) != 0});
      starts_.push_back(data.u32(0));
      if (sheets_.size() > most_sheets) errors_.fail_too_large();
    }
    if (kind == shared_texts) {
      const std::vector<Bytes> parts = with_continued(data, at);
      Texts texts(parts, errors_);
      texts.skip(8);
      if (texts_.size() + data.u32(4) > most_texts) errors_.fail_too_large();
      for (std::uint32_t left = data.u32(4); left > 0; --left) texts_.push_back(texts.text(false));
    }
  }

  void read_cell(std::size_t kind, const Bytes& data, std::size_t at) {
    switch (kind) {
      case number_cell:
        return put_number(data, data.u16(2), data.u16(4), data.number<double>(6));
      case short_cell:
        return put_number(data, data.u16(2), data.u16(4), short_number(data.u32(6)));
      case short_cells:
        for (std::size_t i = 4; i + 6 < data.size(); i += 6) {
          put_number(data, data.u16(2) + (i - 4) / 6, data.u16(i), short_number(data.u32(i + 2)));
        }
        return;
      case shared_text_cell:
        if (data.u32(6) >= texts_.size()) errors_.fail_damaged("a text is missing");
        return cells_.put_text(data.u16(0), data.u16(2), texts_[data.u32(6)]);
      case text_cell:
      case rich_text_cell:
        return cells_.put_text(data.u16(0), data.u16(2), text_at(data, at, 6, false));
      case truth_or_error:
        return put_truth_or_error(data, data.u8(7) != 0, data.u8(6));
      case formula:
        return put_formula(data);
      case formula_text:
        if (formula_)
          cells_.put_text(formula_->u16(0), formula_->u16(2), text_at(data, at, 0, false));
        formula_.reset();
        return;
      default:
        return;
    }
  }

  void put_number(const Bytes& data, std::size_t column, std::size_t style_of_cell, double value) {
    const std::size_t row = data.u16(0);
    const std::size_t format = style_of_cell < formats_.size() ? formats_[style_of_cell] : 0;
    const auto stated = dates_.find(format);
    if (!std::isfinite(value)) {
      cells_.put_text(row, column, fmt::format("{}", value));
    } else if (stated != dates_.end() ? stated->second : shows_date(format)) {
      cells_.put_text(row, column, date_text(value, epoch_));
    } else {
      cells_.put_number(row, column, value);
    }
  }

  void put_truth_or_error(const Bytes& data, bool error, std::size_t value) {
    if (error) return cells_.put_text(data.u16(0), data.u16(2), error_word(value));
    cells_.put_number(data.u16(0), data.u16(2), value != 0 ? 1.0 : 0.0);
  }

  /// The stored value of a formula. That of a text is in a record of its own.
  void put_formula(const Bytes& data) {
    formula_.reset();
    if (data.u16(12) != 0xFFFF) {
      return put_number(data, data.u16(2), data.u16(4), data.number<double>(6));
    }
    const std::size_t type = data.u8(6);
    if (type == 0) formula_ = data;
    if (type == 1 || type == 2) put_truth_or_error(data, type == 2, data.u8(8));
  }

  static constexpr std::size_t most_texts = 1'000'000;
  static constexpr std::size_t most_sheets = 10'000;

  Bytes stream_;
  const WorkbookErrors& errors_;
  Cells cells_;
  std::vector<ListedSheet> sheets_;
  std::vector<std::size_t> starts_;  ///< of the sheets in the stream
  std::vector<std::string> texts_;
  std::vector<std::size_t> formats_;   ///< of the styles
  std::map<std::size_t, bool> dates_;  ///< whether a format with a code shows a date
  std::chrono::sys_days epoch_ = first_day(false);
  std::optional<Bytes> formula_;  ///< whose text follows
};

}  // namespace

Sheet read_excel97(std::string_view bytes, const std::string& file, const std::string& name,
                   char decimal) {
  const WorkbookErrors errors(file);
  if (bytes.size() > largest_workbook) errors.fail_too_large();
  const CompoundFile compound(bytes, errors);
  if (compound.has("EncryptedPackage")) errors.fail_encrypted();
  if (!compound.has("Workbook")) errors.fail_other_kind();
  const std::string stream = compound.stream("Workbook");
  return Excel97Reader(stream, errors, decimal).read(name);
}

}  // namespace recoil
