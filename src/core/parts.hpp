#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "core/names.hpp"
#include "core/shard.hpp"

namespace recoil {

/// What the parts of one computation have in common: everything that decides its digits.
struct Origin {
  std::vector<std::string> command;  ///< its words without shard, threads and places
  std::string folder;                ///< in which they were given
  std::string version;               ///< of recoil
  std::string program;               ///< SHA-256 of its file
  std::string inputs;                ///< SHA-256 of the fit files and their data
  std::uint64_t seed = 0;
  std::size_t pieces = 0;  ///< of the work, numbered from 0
  std::string arithmetic;  ///< of the processor, `arithmetic_fingerprint`
  std::string start;       ///< SHA-256 of what the pieces begin with: the fit, to the last digit
};

/// In what two origins differ, the plainest first.
enum class OriginDifference { version, program, seed, command, pieces, inputs, arithmetic, start };
template <>
struct NamesOf<OriginDifference> {
  static constexpr std::array<std::string_view, 8> names = {
      "version", "program", "seed", "command", "pieces", "inputs", "arithmetic", "start"};
};

/// None where they are the same; the folders may differ.
std::optional<OriginDifference> difference(const Origin& a, const Origin& b);

/// One finished part, a file of rows (row_file.hpp).
struct PartFile {
  std::filesystem::path file;
  Origin origin;
  Shard shard;
};

/// SHA-256 of an origin but for its folder.
std::string key_of(const Origin& origin);

/// "part-3-of-40-0f3a5c...jsonl": origins that differ never share a file, and a shard that runs
/// twice writes the same file with the same bytes.
std::filesystem::path part_path(const std::filesystem::path& folder, const Origin& origin,
                                const Shard& shard);

/// The head of the file of a part, to be written with its rows (`write_rows`).
Json part_head(const Origin& origin, const Shard& shard);

/// Every part in `folder`, by shards and numbers; their heads alone are read. Other files, and
/// those that are still being written, are none.
std::vector<PartFile> parts_in(const std::filesystem::path& folder);

/// The part that a file holds.
std::optional<PartFile> part_in(const std::filesystem::path& file);

/// What of `pieces` is in no part, as the numbers of shards of `of`.
std::vector<std::size_t> missing_shards(const std::vector<PartFile>& parts, std::size_t pieces,
                                        std::size_t of);

}  // namespace recoil
