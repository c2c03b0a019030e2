#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "analysis/analysis.hpp"
#include "core/parts.hpp"
#include "report/words_parts.hpp"

namespace recoil {

/// What makes a command one of several processes, as given.
struct ShardFlags {
  std::string shard;                  ///< "3/40"; empty: the whole is computed here
  std::string parts;                  ///< set by `recoil merge`: the folder whose parts are taken
  const CLI::App* command = nullptr;  ///< whose words the parts carry

  bool one_of_several() const { return !shard.empty(); }
  bool merging() const { return !parts.empty(); }
  Shard chosen() const { return shard_named(shard).value_or(Shard{}); }
};

/// --shard, and an option that only `recoil merge` uses. `pieces` is what is shared: "replicates".
void add_shard_flags(CLI::App& command, const std::string& pieces, ShardFlags& flags);

/// Where the parts of a computation come from: the words of the command, this program, this
/// processor, and what the command knows of its `inputs` and of what its pieces `start` from.
Origin origin_of(const ShardFlags& flags, const std::string& inputs, std::uint64_t seed,
                 std::size_t pieces, const std::string& start);

/// Of a fit file and its data.
std::string inputs_of(const FitSpec& spec, const std::vector<Dataset>& datasets);

/// Complains before a shard computes anything: about a missing folder, or nothing to share.
void require_share(const std::string& out, std::size_t pieces, const std::string& what);

/// Has this shard run already? Then it says so.
bool part_is_there(const std::filesystem::path& folder, const Origin& origin, const Shard& shard);

/// One line about the part that was written.
void say_part(const std::filesystem::path& folder, const Origin& origin, const Shard& shard,
              const std::string& what);

}  // namespace recoil
