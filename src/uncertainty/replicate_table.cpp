#include "uncertainty/replicate_table.hpp"

#include <algorithm>
#include <cmath>

#include "core/row_file.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_replicates = 1000000;

/// Is it one row of such a table: [index, [theta...], [std_error..., errors of what is
/// derived...]], or [index] when the refit failed?
bool is_row(const Json& row, const ReplicateTable& table) {
  if (row[0].get<std::size_t>() >= most_replicates) return false;
  if (row.size() == 1) return true;
  const auto holds = [](const Json& values, std::size_t length) {
    return values.is_array() && values.size() == length &&
           std::all_of(values.begin(), values.end(), [](const Json& v) { return v.is_number(); });
  };
  return row.size() == 3 && holds(row[1], table.slots) && holds(row[2], table.errors());
}

/// @pre is_row(row, table)
void put_row(const Json& row, ReplicateTable& table) {
  const std::size_t index = row[0].get<std::size_t>();
  table.grow(index + 1);
  if (row.size() == 1) {
    table.state[index] = ReplicateTable::State::failed;
    return;
  }
  for (std::size_t j = 0; j < table.slots; ++j) {
    table.theta[index * table.slots + j] = row[1][j].get<double>();
  }
  for (std::size_t j = 0; j < table.errors(); ++j) {
    table.std_error[index * table.errors() + j] = row[2][j].get<double>();
  }
  table.state[index] = ReplicateTable::State::usable;
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
  std::vector<Json> rows;
  const bool whole = read_rows(file, [&](const Json& row) {
    rows.push_back(row);
    return is_row(row, table);
  });
  if (!whole) return;
  for (const Json& row : rows) put_row(row, table);
}

}  // namespace recoil
