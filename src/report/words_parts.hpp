#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/parts.hpp"

namespace recoil {

/// The parts in `folder`, which all are of one origin but for their arithmetic.
/// @throws InputError for others, or when there are none
std::vector<PartFile> parts_of_one_origin(const std::filesystem::path& folder);

/// The shards, of as many as most parts are of, whose pieces are in no part that was computed with
/// the same arithmetic as this processor's.
struct MissingShards {
  std::size_t of = 1;
  std::vector<std::size_t> numbers;
  std::size_t otherwise = 0;  ///< parts that were computed with another arithmetic
};
MissingShards missing_in(const std::vector<PartFile>& parts, const std::string& arithmetic);

/// @throws ComputationError when some are missing: what to run again, as one line
void require_all_shards(const std::filesystem::path& folder, const MissingShards& missing);

/// The files of the parts of `origin` in `folder`, all of them.
/// @throws InputError for a part of another origin or with other rows than were written,
/// ComputationError when some are missing
std::vector<std::filesystem::path> parts_of(const Origin& origin,
                                            const std::filesystem::path& folder);

}  // namespace recoil
