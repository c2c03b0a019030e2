#include "uncertainty/replicate_table.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/files.hpp"

namespace recoil {
namespace {

using Json = nlohmann::json;

constexpr std::size_t most_replicates = 1000000;

/// One row: [index, [theta...], [std_error...]], or [index] when the refit failed.
bool read_row(const Json& row, ReplicateTable& table) {
  if (!row.is_array() || row.empty() || !row[0].is_number_unsigned()) return false;
  const std::size_t index = row[0].get<std::size_t>();
  if (index >= most_replicates) return false;
  if (index >= table.state.size()) table.grow(index + 1);
  if (row.size() == 1) {
    table.state[index] = ReplicateTable::State::failed;
    return true;
  }
  if (row.size() != 3 || row[1].size() != table.slots || row[2].size() != table.slots) return false;
  for (std::size_t j = 0; j < table.slots; ++j) {
    if (!row[1][j].is_number() || !row[2][j].is_number()) return false;
    table.theta[index * table.slots + j] = row[1][j].get<double>();
    table.std_error[index * table.slots + j] = row[2][j].get<double>();
  }
  table.state[index] = ReplicateTable::State::usable;
  return true;
}

}  // namespace

void ReplicateTable::grow(std::size_t count) {
  if (count <= state.size()) return;
  state.resize(count, State::not_run);
  theta.resize(count * slots, 0.0);
  std_error.resize(count * slots, 0.0);
}

std::size_t ReplicateTable::finished() const {
  return state.size() -
         static_cast<std::size_t>(std::count(state.begin(), state.end(), State::not_run));
}

void save_replicates(const std::filesystem::path& file, const std::string& key,
                     const ReplicateTable& table) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < table.state.size(); ++i) {
    if (table.state[i] == ReplicateTable::State::not_run) continue;
    Json row = Json::array({i});
    if (table.state[i] == ReplicateTable::State::usable) {
      const auto from = static_cast<std::ptrdiff_t>(i * table.slots);
      const auto to = from + static_cast<std::ptrdiff_t>(table.slots);
      row.push_back(std::vector<double>(table.theta.begin() + from, table.theta.begin() + to));
      row.push_back(
          std::vector<double>(table.std_error.begin() + from, table.std_error.begin() + to));
    }
    rows.push_back(std::move(row));
  }
  const Json out = {{"what",
                     "finished replicates of a run that was stopped; the next run goes on "
                     "from here and removes this file"},
                    {"key", key},
                    {"replicates", std::move(rows)}};
  write_whole_file(file, out.dump() + "\n");
}

ReplicateTable load_replicates(const std::filesystem::path& file, const std::string& key,
                               std::size_t slots) {
  ReplicateTable none;
  none.slots = slots;
  std::error_code failed;
  if (!std::filesystem::is_regular_file(file, failed)) return none;
  std::string text;
  try {
    text = read_text_file(file);
  } catch (const InputError&) {
    return none;
  }
  const Json found = Json::parse(text, nullptr, false);
  if (!found.is_object() || found.value("key", Json()) != key) return none;
  const Json rows = found.value("replicates", Json());
  if (!rows.is_array()) return none;
  ReplicateTable table = none;
  for (const Json& row : rows) {
    if (!read_row(row, table)) return none;
  }
  return table;
}

}  // namespace recoil
