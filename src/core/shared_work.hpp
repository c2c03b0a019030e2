#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "core/kept_rows.hpp"
#include "core/parts.hpp"

namespace recoil {

/// Long work in numbered pieces, each of which is a pure function of its number.
struct SharedWork {
  std::string label;  ///< of its progress bar
  std::size_t pieces = 0;
  int threads = 0;  ///< 0: all cores
  /// What came of a piece, as JSON that gives every digit back and is not null; called from any
  /// thread.
  std::function<Json(std::size_t piece)> run;
};

/// Runs those pieces of one shard that `kept` does not have, and puts them there.
/// @throws Interrupted when the user stops it; what was finished is kept then
void run_pieces(const SharedWork& work, const Shard& shard, KeptRows& kept);

/// Runs the pieces of one shard and writes them as its part into `folder`, whole or not at all.
/// What is finished is kept in `unfinished_path` meanwhile.
/// @throws Interrupted as `run_pieces` does
void write_part(const SharedWork& work, const Origin& origin, const Shard& shard,
                const std::filesystem::path& folder);

/// Where a shard that was stopped keeps what is finished.
std::filesystem::path unfinished_path(const std::filesystem::path& folder, const Origin& origin,
                                      const Shard& shard);

/// Hands the rows that `parts` hold on to `take`, one part after the other; a damaged file gives
/// none of its rows.
/// @return whether a piece was handed on [pieces]
std::vector<bool> read_parts(const std::vector<std::filesystem::path>& parts, std::size_t pieces,
                             const std::function<void(std::size_t piece, const Json& row)>& take);

}  // namespace recoil
