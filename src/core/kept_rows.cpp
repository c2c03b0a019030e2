#include "core/kept_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/row_file.hpp"

namespace recoil {

bool KeepingPace::keep(const std::function<void()>& write) {
  const Clock::time_point begin = Clock::now();
  bool written = true;
  try {
    write();
  } catch (const InputError& error) {
    written = false;
    if (!told_) fmt::print(stderr, "{}\n", error.what());
  }
  told_ = !written;
  const Clock::time_point end = Clock::now();
  next_ = end + std::max<Clock::duration>(most_lost_, longer_than_writing * (end - begin));
  return written;
}

KeptRows::KeptRows(std::filesystem::path file, std::string key, KeepingPace pace)
    : file_(std::move(file)), key_(std::move(key)), pace_(pace) {
  if (file_.empty()) return;
  const std::optional<Json> head = read_row_head(file_);
  if (!head || head->value("key", Json()) != key_) return;
  const bool whole = read_rows(file_, [this](const Json& row) {
    if (row.size() != 2 || row[1].is_null()) return false;
    rows_[row[0].get<std::size_t>()] = row[1];
    return true;
  });
  if (!whole) rows_.clear();
}

std::optional<Json> KeptRows::find(std::size_t piece) const {
  const std::lock_guard lock(using_);
  const auto found = rows_.find(piece);
  return found == rows_.end() ? std::nullopt : std::optional<Json>(found->second);
}

void KeptRows::put(std::size_t piece, Json row) {
  end_if_called_off();  // what was called off may have ended early, with anything
  const std::lock_guard lock(using_);
  rows_[piece] = std::move(row);
  if (!file_.empty() && pace_.is_due()) pace_.keep([this] { write(); });
}

void KeptRows::keep() {
  const std::lock_guard lock(using_);
  if (!file_.empty()) write();
}

void KeptRows::forget() const {
  std::error_code ignored;
  if (!file_.empty()) std::filesystem::remove(file_, ignored);
}

std::size_t KeptRows::size() const {
  const std::lock_guard lock(using_);
  return rows_.size();
}

void KeptRows::write() const {
  std::vector<Json> lines;
  lines.reserve(rows_.size());
  for (const auto& [piece, row] : rows_) lines.push_back(Json::array({piece, row}));
  write_rows(file_, {{"key", key_}}, lines);
}

std::filesystem::path unfinished_beside(const std::filesystem::path& result) {
  return result.parent_path() / ("unfinished-" + result.filename().string() + ".jsonl");
}

}  // namespace recoil
