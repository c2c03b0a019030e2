#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/json.hpp"

namespace recoil {

/// Replicates by index, some of them not run yet. Rows are written from different threads.
struct ReplicateTable {
  enum class State : std::uint8_t { not_run, usable, failed };

  std::size_t slots = 0;
  std::size_t derived = 0;        ///< further quantities of which only the error is kept
  std::vector<State> state;       ///< [count]
  std::vector<double> theta;      ///< [count x slots]
  std::vector<double> std_error;  ///< [count x (slots + derived)]

  /// Makes room for `count` replicates; those that exist stay.
  void grow(std::size_t count);
  std::size_t finished() const;
  std::size_t errors() const { return slots + derived; }
};

/// Writes the finished replicates, every digit of them, as a file of rows (core/row_file.hpp) whose
/// `head` gets `key`: whole or not at all.
void save_replicates(const std::filesystem::path& file, const std::string& key,
                     const ReplicateTable& table, Json head = Json::object());

/// Takes over what `file` holds, if it was written under `key`; a file that is missing, damaged or
/// of another key leaves the table as it is. Replicates are cheap, wrong ones are not.
void load_replicates(const std::filesystem::path& file, const std::string& key,
                     ReplicateTable& table);

}  // namespace recoil
