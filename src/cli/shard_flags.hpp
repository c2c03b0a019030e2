#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/analysis.hpp"
#include "core/parts.hpp"

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

/// The parts of `origin` in `folder`, all of them.
/// @throws InputError for a part of another origin, ComputationError when some are missing
std::vector<std::filesystem::path> parts_of(const Origin& origin,
                                            const std::filesystem::path& folder);

/// The parts in `folder`, which all are of one origin but for their arithmetic.
/// @throws InputError for others, or when there are none
std::vector<PartFile> parts_of_one_origin(const std::filesystem::path& folder);

/// The shards, of as many as most parts are of, whose pieces are in no part that was computed with
/// `arithmetic`.
struct MissingShards {
  std::size_t of = 1;
  std::vector<std::size_t> numbers;
  std::size_t otherwise = 0;  ///< parts that were computed with another arithmetic
};
MissingShards missing_in(const std::vector<PartFile>& parts, const std::string& arithmetic);

/// What to run again, as one line.
std::string missing_words(const MissingShards& missing);

}  // namespace recoil
