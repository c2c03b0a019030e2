#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/interrupt.hpp"
#include "core/json.hpp"
#include "core/kept_rows.hpp"

/// Long work in numbered pieces, each a pure function of its number. One process runs all pieces
/// and continues where it was stopped. Or several processes (shards) run some pieces each, every
/// shard writes its rows to one file (a part), and a merge reads the rows of all parts.
namespace recoil {

struct Pieces {
  std::string label;  ///< of the progress bar
  std::size_t count = 0;
  int threads = 0;  ///< 0: all cores
  /// The result of one piece as JSON that round-trips doubles; called from any thread.
  std::function<Json(std::size_t piece)> run;
};

/// One of several processes that share numbered pieces. Shard k of n runs the pieces i (from 0)
/// with i mod n = k - 1, so that neighbours, which often cost the same, go to different shards.
struct Shard {
  std::size_t number = 1;  ///< k, from 1
  std::size_t of = 1;      ///< n

  bool owns(std::size_t piece) const { return piece % of == number - 1; }
  /// The number of pieces, of `pieces`, that this shard runs.
  std::size_t share(std::size_t pieces) const { return (pieces + of - number) / of; }
};

inline constexpr std::size_t most_shards = 1000000;
inline constexpr std::size_t most_pieces = 10000000;

/// The shard that "3/40" means; nullopt for any other text.
std::optional<Shard> shard_named(std::string_view text);

/// Runs the pieces of `shard` that have no row in `kept` yet.
/// @throws Interrupted as below
void resumable(const Pieces& pieces, KeptRows& kept, const Shard& shard = {});

/// The result of `work`, which puts its finished pieces into `kept`. If `kept` has a file, Ctrl-C,
/// SIGTERM and SIGUSR1 call the work off; without a file they end the process.
/// @throws Interrupted after a signal; the file then has all finished rows
template <class Work>
auto resumable(KeptRows& kept, const Work& work) {
  if (kept.file().empty()) return work();
  const InterruptGuard guard;
  const auto end_if_stopped = [&kept] {
    if (!stop_requested()) return;
    kept.keep();
    throw Interrupted(fmt::format("stopped: {} pieces are kept in {}; the same command continues",
                                  kept.size(), kept.file().string()));
  };
  try {
    auto result = work();
    end_if_stopped();  // work that was called off may return an incomplete result
    return result;
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception&) {
    end_if_stopped();
    throw;
  }
}

/// Everything that the digits of a computation depend on. Parts are merged only if theirs agree.
struct Origin {
  std::vector<std::string> command;  ///< its words without shard, threads and folders
  std::string folder;                ///< the working directory of the command; changes no digit
  std::string version;               ///< of recoil
  std::string program;               ///< SHA-256 of its file
  std::string inputs;                ///< SHA-256 of the fit files and their data
  std::uint64_t seed = 0;
  std::size_t pieces = 0;
  std::string arithmetic;  ///< of the processor, `arithmetic_fingerprint`
  std::string start;       ///< SHA-256 of the fit from which the pieces start, to the last digit

  RECOIL_FIELDS(command, folder, version, program, inputs, seed, pieces, arithmetic, start)
};

/// The origin of a computation by this program, on this processor, in the working directory.
/// @param start text with every digit of the fit from which the pieces start
Origin origin_here(std::vector<std::string> command, const std::string& inputs, std::uint64_t seed,
                   std::size_t pieces, const std::string& start);

/// SHA-256 of an origin without its folder.
std::string key_of(const Origin& origin);

/// How two origins differ, as a clause ("their seeds differ"); empty if they agree.
std::string difference(const Origin& a, const Origin& b);

/// "unfinished-NAME.jsonl" beside `result`, for the rows of a run that is not finished.
std::filesystem::path unfinished_beside(const std::filesystem::path& result);

/// "part-3-of-40-0f3a5c....jsonl" in `folder`: different origins never share a file, and a shard
/// that runs twice writes the same bytes.
std::filesystem::path part_path(const std::filesystem::path& folder, const Origin& origin,
                                const Shard& shard);

/// Does `folder` have the part of this shard?
bool has_part(const std::filesystem::path& folder, const Origin& origin, const Shard& shard);

/// The rows of a shard that has not written its part into `folder` yet.
std::shared_ptr<KeptRows> rows_of_shard(const std::filesystem::path& folder, const Origin& origin,
                                        const Shard& shard);

/// Writes the rows of a shard as its part, and removes the file of its unfinished rows.
void write_part(const KeptRows& kept, const std::filesystem::path& folder, const Origin& origin,
                const Shard& shard);

/// The file of a finished shard.
struct Part {
  std::filesystem::path file;
  Origin origin;
  Shard shard;
};

/// All parts in `folder`, sorted by the numbers of their shards. Only their first lines are read.
/// They may differ in `arithmetic` and `start`.
/// @throws InputError if there are none, or if they do not belong together
std::vector<Part> parts_in(const std::filesystem::path& folder);

/// The shards whose pieces are in no part that has this processor's arithmetic.
struct MissingShards {
  std::size_t of = 1;                ///< the number of shards of most parts
  std::vector<std::size_t> numbers;  ///< ascending
  std::size_t otherwise = 0;         ///< parts with another arithmetic
};
MissingShards missing_shards(const std::vector<Part>& parts);

/// `numbers` in the form of Slurm's --array=: "1-3,7". @pre ascending
std::string array_list(const std::vector<std::size_t>& numbers);

/// @throws ComputationError if shards are missing; it says which to run again
void require_all_shards(const std::filesystem::path& folder, const std::vector<Part>& parts);

/// The rows of all parts in `folder`.
/// @throws InputError for a part of another origin, or one whose rows were altered
/// @throws ComputationError if shards are missing
std::shared_ptr<KeptRows> rows_of_parts(const std::filesystem::path& folder, const Origin& origin);

}  // namespace recoil
