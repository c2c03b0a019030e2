#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace recoil {

/// One of several processes that share numbered work. Of pieces numbered from 0, shard k of n
/// takes those with i mod n = k - 1: neighbours, which often cost the same, go to different ones.
struct Shard {
  std::size_t number = 1;  ///< k, from 1
  std::size_t of = 1;      ///< n

  bool owns(std::size_t piece) const { return piece % of == number - 1; }
  /// How many of `pieces` it takes.
  std::size_t share(std::size_t pieces) const { return (pieces + of - number) / of; }
};

inline constexpr std::size_t most_shards = 1000000;

/// The shard that "3/40" means; none for anything else.
std::optional<Shard> shard_named(std::string_view text);

/// Numbers as Slurm's --array= takes them: "1-3,7". @pre ascending
std::string array_list(const std::vector<std::size_t>& numbers);

}  // namespace recoil
