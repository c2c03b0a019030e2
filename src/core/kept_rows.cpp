#include "core/kept_rows.hpp"

#include <charconv>
#include <cstdio>
#include <fstream>
#include <utility>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/interrupt.hpp"
#include "core/quoting.hpp"

namespace recoil {
namespace {

constexpr std::size_t longest_head = 1 << 20;          // [bytes]
constexpr std::uintmax_t most_row_bytes = 1ULL << 30;  // a million replicates of 60 numbers

/// Opens a file of rows, but no pipe or device.
std::ifstream open_rows(const std::filesystem::path& file) {
  std::error_code failed;
  return std::filesystem::is_regular_file(file, failed) ? std::ifstream(file, std::ios::binary)
                                                        : std::ifstream();
}

/// The checksum of head and rows. @param head without its own "sha256"
std::string checksum(const Json& head, std::string_view rows) {
  return sha256_hex(json_line(head) + "\n" + std::string(rows));
}

/// The head in the first line of `in`.
std::optional<Json> head_in(std::istream& in) {
  std::string line;
  for (int c = in.get(); in.good() && c != '\n'; c = in.get()) {
    line += static_cast<char>(c);
    if (line.size() > longest_head) return std::nullopt;
  }
  if (!in.good()) return std::nullopt;
  Json head = parse_json(line);
  if (!head.is_object() || !head.value("rows", Json()).is_number_unsigned() ||
      !head.value("bytes", Json()).is_number_unsigned() ||
      !head.value("sha256", Json()).is_string()) {
    return std::nullopt;
  }
  return head;
}

/// Adds the row of one line, "[7,ROW]". @return whether the line is one
bool add_row(std::string_view line, Rows& rows) {
  if (line.size() < 4 || line.front() != '[' || line.back() != ']') return false;
  std::uint64_t piece = 0;
  const char* const end = line.data() + line.size();
  const auto number = std::from_chars(line.data() + 1, end, piece);
  if (number.ec != std::errc{} || *number.ptr != ',') return false;
  rows[piece] = std::string(number.ptr + 1, end - 1);
  return true;
}

}  // namespace

void write_rows(const std::filesystem::path& file, Json head, const Rows& rows) {
  std::string text;
  for (const auto& [piece, row] : rows) text += fmt::format("[{},{}]\n", piece, row);
  head["rows"] = rows.size();
  head["bytes"] = text.size();
  head["sha256"] = checksum(head, text);
  write_whole_file(file, json_line(head) + "\n" + text);
}

std::optional<Json> read_row_head(const std::filesystem::path& file) {
  std::ifstream in = open_rows(file);
  std::optional<Json> head = head_in(in);
  if (!head) return std::nullopt;
  const std::uintmax_t line = static_cast<std::uintmax_t>(in.tellg());
  std::error_code failed;
  const std::uintmax_t size = std::filesystem::file_size(file, failed);
  if (failed || size != line + head->at("bytes").get<std::uintmax_t>()) return std::nullopt;
  return head;
}

std::optional<Rows> read_rows(const std::filesystem::path& file) {
  std::ifstream in = open_rows(file);
  std::optional<Json> head = head_in(in);
  if (!head) return std::nullopt;
  const std::uintmax_t size = head->at("bytes").get<std::uintmax_t>();
  if (size > most_row_bytes) {
    throw InputError({file.string()}, fmt::format("it has {} MB of rows", size / 1000000),
                     fmt::format("at most {} MB are read", most_row_bytes / 1000000),
                     "divide the work into more shards");
  }
  std::string text(size + 1, '\0');  // one more byte than there should be
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  const std::string stated = head->at("sha256").get<std::string>();
  head->erase("sha256");
  if (checksum(*head, text) != stated) return std::nullopt;
  Rows rows;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (!add_row(std::string_view(text).substr(begin, end - begin), rows)) return std::nullopt;
    begin = end + 1;
  }
  if (rows.size() != head->at("rows").get<std::size_t>()) return std::nullopt;
  return rows;
}

void KeepingPace::keep(const std::function<void()>& write) {
  const Clock::time_point begin = Clock::now();
  try {
    write();
    reported_ = false;
  } catch (const InputError& error) {
    if (!std::exchange(reported_, true)) print_text(stderr, "{}\n", error.what());
  }
  const Clock::time_point end = Clock::now();
  next_ = end + std::max<Clock::duration>(most_lost_, longer_than_writing * (end - begin));
}

KeptRows::KeptRows(std::filesystem::path file, std::string key, KeepingPace pace)
    : file_(std::move(file)), key_(std::move(key)), pace_(pace) {
  if (file_.empty()) return;
  const std::optional<Json> head = read_row_head(file_);
  if (!head || head->value("key", Json()) != key_) return;
  if (std::optional<Rows> rows = read_rows(file_)) rows_ = std::move(*rows);
}

std::optional<Json> KeptRows::find(std::uint64_t piece) const {
  std::string text;
  {
    const std::lock_guard lock(mutex_);
    const auto found = rows_.find(piece);
    if (found == rows_.end()) return std::nullopt;
    text = found->second;
  }
  Json row = parse_json(text);
  return row.is_discarded() ? std::nullopt : std::optional<Json>(std::move(row));
}

bool KeptRows::has(std::uint64_t piece) const {
  const std::lock_guard lock(mutex_);
  return rows_.contains(piece);
}

void KeptRows::put(std::uint64_t piece, const Json& row) {
  end_if_called_off();
  std::string text = json_line(row);
  const std::lock_guard lock(mutex_);
  rows_[piece] = std::move(text);
  if (!file_.empty() && pace_.is_due()) pace_.keep([this] { write(); });
}

void KeptRows::add(Rows rows, const std::filesystem::path& file) {
  const std::lock_guard lock(mutex_);
  folder_ = file.parent_path();
  rows_.merge(rows);
}

void KeptRows::keep() {
  const std::lock_guard lock(mutex_);
  if (!file_.empty()) write();
}

void KeptRows::forget() const {
  std::error_code ignored;
  if (!file_.empty()) std::filesystem::remove(file_, ignored);
}

InputError KeptRows::mistake(const std::string& why) const {
  return {{(file_.empty() ? folder_ : file_).string()},
          "its rows are not those of this computation",
          why,
          file_.empty() ? "remove the parts, and run the shards again"
                        : "remove it, and run the same command again"};
}

std::size_t KeptRows::size() const {
  const std::lock_guard lock(mutex_);
  return rows_.size();
}

std::vector<std::uint64_t> KeptRows::pieces() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::uint64_t> numbers;
  for (const auto& [piece, row] : rows_) numbers.push_back(piece);
  return numbers;
}

void KeptRows::write() const { write_rows(file_, {{"key", key_}}, rows_); }

}  // namespace recoil
