#include "uncertainty/replicate_table.hpp"

#include <algorithm>
#include <cmath>

#include "core/row_file.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_replicates = 1000000;

/// One row: [index, [theta...], [std_error..., errors of what is derived...]], or [index] when the
/// refit failed.
bool read_row(const Json& row, ReplicateTable& table) {
  if (!row.is_array() || row.empty() || !row[0].is_number_unsigned()) return false;
  const std::size_t index = row[0].get<std::size_t>();
  if (index >= most_replicates) return false;
  if (index >= table.state.size()) table.grow(index + 1);
  if (row.size() == 1) {
    table.state[index] = ReplicateTable::State::failed;
    return true;
  }
  const auto read = [&row](std::size_t column, std::size_t length, std::vector<double>& to,
                           std::size_t at) {
    if (row[column].size() != length) return false;
    for (std::size_t j = 0; j < length; ++j) {
      if (!row[column][j].is_number()) return false;
      to[at + j] = row[column][j].get<double>();
    }
    return true;
  };
  if (row.size() != 3 || !read(1, table.slots, table.theta, index * table.slots) ||
      !read(2, table.errors(), table.std_error, index * table.errors())) {
    return false;
  }
  table.state[index] = ReplicateTable::State::usable;
  return true;
}

}  // namespace

void ReplicateTable::grow(std::size_t count) {
  if (count <= state.size()) return;
  state.resize(count, State::not_run);
  theta.resize(count * slots, 0.0);
  std_error.resize(count * errors(), 0.0);
}

std::size_t ReplicateTable::finished() const {
  return state.size() -
         static_cast<std::size_t>(std::count(state.begin(), state.end(), State::not_run));
}

void ReplicateTable::take(const ReplicateTable& other) {
  grow(other.state.size());
  const auto copy = [](const std::vector<double>& from, std::vector<double>& to, std::size_t i,
                       std::size_t length) {
    const auto at = static_cast<std::ptrdiff_t>(i * length);
    std::copy_n(from.begin() + at, length, to.begin() + at);
  };
  for (std::size_t i = 0; i < other.state.size(); ++i) {
    if (other.state[i] == State::not_run) continue;
    state[i] = other.state[i];
    copy(other.theta, theta, i, slots);
    copy(other.std_error, std_error, i, errors());
  }
}

void save_replicates(const std::filesystem::path& file, const std::string& key,
                     const ReplicateTable& table, Json head) {
  std::vector<Json> rows;
  for (std::size_t i = 0; i < table.state.size(); ++i) {
    if (table.state[i] == ReplicateTable::State::not_run) continue;
    Json row = Json::array({i});
    if (table.state[i] == ReplicateTable::State::usable) {
      const auto part = [i](const std::vector<double>& values, std::size_t length) {
        const auto from = values.begin() + static_cast<std::ptrdiff_t>(i * length);
        return std::vector<double>(from, from + static_cast<std::ptrdiff_t>(length));
      };
      row.push_back(part(table.theta, table.slots));
      row.push_back(part(table.std_error, table.errors()));
    }
    rows.push_back(std::move(row));
  }
  head["key"] = key;
  write_rows(file, std::move(head), rows);
}

void load_replicates(const std::filesystem::path& file, const std::string& key,
                     ReplicateTable& table) {
  const std::optional<Json> head = read_row_head(file);
  if (!head || head->value("key", Json()) != key) return;
  ReplicateTable found;
  found.slots = table.slots;
  found.derived = table.derived;
  if (read_rows(file, [&found](const Json& row) { return read_row(row, found); }))
    table.take(found);
}

}  // namespace recoil
