#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/analysis.hpp"
#include "cli/options.hpp"
#include "core/resumable.hpp"

namespace recoil {

/// The options of a command whose pieces several processes can share.
struct ShardFlags {
  std::string shard;               ///< "3/40"; empty: this process computes everything
  std::string parts;               ///< set by `recoil merge`: the folder of the parts
  std::optional<Command> command;  ///< its words are those of the origin
  std::string pieces;              ///< "data sets"

  bool one_of_several() const { return !shard.empty(); }
  bool merging() const { return !parts.empty(); }

  /// Checks, before a shard computes anything, that it has a folder and
  /// something to share.
  /// @throws InputError
  void require_share(const std::string& out, std::size_t count) const;

  /// The origin of this command.
  Origin origin(const FitSpec& spec, const std::vector<Dataset>& datasets, std::uint64_t seed,
                std::size_t count, const std::string& start) const;

  /// The rows to go on from: those that a stopped run left beside `result`
  /// (with --shard, in the folder `result`), or those of all parts for a merge.
  /// Null if the part of this shard exists; a line on standard output reports
  /// it.
  /// @param result empty: nothing is written
  std::shared_ptr<KeptRows> rows(const Origin& origin, const std::filesystem::path& result) const;

  /// With --shard: runs its pieces, and writes them as a part into `folder`.
  void run_share(const Pieces& work, KeptRows& kept, const Origin& origin,
                 const std::filesystem::path& folder) const;
};

/// Adds --shard, and an option that only `recoil merge` uses. `pieces`: see
/// ShardFlags.
void add_shard_flags(const Command& command, const std::string& pieces, ShardFlags& flags);

}  // namespace recoil
