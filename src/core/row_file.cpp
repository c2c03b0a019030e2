#include "core/row_file.hpp"

#include <fstream>

#include "core/files.hpp"

namespace recoil {

void write_rows(const std::filesystem::path& file, Json head, const std::vector<Json>& rows) {
  head["rows"] = rows.size();
  std::string text = head.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  for (const Json& row : rows) text += row.dump() + "\n";
  write_whole_file(file, text);
}

std::optional<Json> read_row_head(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string line;
  if (!in || !std::getline(in, line)) return std::nullopt;
  Json head = Json::parse(line, nullptr, false);
  if (!head.is_object() || !head.value("rows", Json()).is_number_unsigned()) return std::nullopt;
  return head;
}

bool read_rows(const std::filesystem::path& file,
               const std::function<bool(const Json& row)>& take) {
  const std::optional<Json> head = read_row_head(file);
  if (!head) return false;
  std::ifstream in(file, std::ios::binary);
  std::string line;
  std::getline(in, line);
  std::size_t rows = 0;
  while (std::getline(in, line)) {
    const Json row = Json::parse(line, nullptr, false);
    if (!row.is_array() || row.empty() || !row[0].is_number_unsigned() || !take(row)) return false;
    ++rows;
  }
  return rows == head->at("rows").get<std::size_t>();
}

}  // namespace recoil
