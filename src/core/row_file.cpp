#include "core/row_file.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string_view>

#include "core/files.hpp"

namespace recoil {
namespace {

/// The head in the first line of `in`, where it is one.
std::optional<Json> head_in(std::istream& in) {
  std::string line;
  if (!in || !std::getline(in, line)) return std::nullopt;
  Json head = Json::parse(line, nullptr, false);
  if (!head.is_object() || !head.value("rows", Json()).is_number_unsigned() ||
      !head.value("bytes", Json()).is_number_unsigned() ||
      !head.value("sha256", Json()).is_string()) {
    return std::nullopt;
  }
  return head;
}

/// What follows the head, where it is what was written.
std::optional<std::string> rows_in(std::istream& in, const Json& head) {
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (sha256_hex(text) != head.at("sha256").get<std::string>()) return std::nullopt;
  return text;
}

}  // namespace

void write_rows(const std::filesystem::path& file, Json head, const std::vector<Json>& rows) {
  std::string text;
  for (const Json& row : rows) text += row.dump() + "\n";
  head["rows"] = rows.size();
  head["bytes"] = text.size();
  head["sha256"] = sha256_hex(text);
  write_whole_file(file, head.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n" + text);
}

std::optional<Json> read_row_head(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::optional<Json> head = head_in(in);
  if (!head) return std::nullopt;
  const std::uintmax_t line = static_cast<std::uintmax_t>(in.tellg());
  std::error_code failed;
  const std::uintmax_t size = std::filesystem::file_size(file, failed);
  if (failed || size != line + head->at("bytes").get<std::uintmax_t>()) return std::nullopt;
  return head;
}

bool is_unaltered(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::optional<Json> head = head_in(in);
  return head && rows_in(in, *head);
}

bool read_rows(const std::filesystem::path& file,
               const std::function<bool(const Json& row)>& take) {
  std::ifstream in(file, std::ios::binary);
  const std::optional<Json> head = head_in(in);
  if (!head) return false;
  const std::optional<std::string> text = rows_in(in, *head);
  if (!text) return false;
  std::size_t rows = 0;
  for (std::size_t begin = 0; begin < text->size(); ++rows) {
    const std::size_t end = std::min(text->find('\n', begin), text->size());
    const std::string_view line(text->data() + begin, end - begin);
    const Json row = Json::parse(line, nullptr, false);
    if (!row.is_array() || row.empty() || !row[0].is_number_unsigned() || !take(row)) return false;
    begin = end + 1;
  }
  return rows == head->at("rows").get<std::size_t>();
}

}  // namespace recoil
