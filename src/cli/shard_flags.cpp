#include "cli/shard_flags.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program.hpp"
#include "core/quoting.hpp"

namespace recoil {
namespace fs = std::filesystem;

void add_shard_flags(const Command& command, const std::string& pieces, ShardFlags& flags) {
  flags.command = command;
  flags.pieces = pieces;
  command
      .option("--shard", flags.shard,
              fmt::format("run only the K-th of N shares of the {}, from 1/N to N/N, and write it "
                          "as a part into DIR, for recoil merge DIR",
                          pieces))
      .takes("K/N")
      .check([](const std::string& text) -> std::string {
        if (shard_named(text)) return {};
        return fmt::format("{} is not K/N with K from 1 to N and N up to {}", text, most_shards);
      });
  command.option("--parts", flags.parts, "").hidden();
}

void ShardFlags::require_share(const std::string& out, std::size_t count) const {
  if (out.empty()) {
    throw InputError({}, "--shard needs --out DIR", "the part is written there",
                     "give all shards the same folder");
  }
  if (count == 0) {
    throw InputError({}, fmt::format("there are no {} to share", pieces), "",
                     "leave --shard out, or ask for some");
  }
  require_writable_folder(out);
}

Origin ShardFlags::origin(const FitSpec& spec, const std::vector<Dataset>& datasets,
                          std::uint64_t seed, std::size_t count, const std::string& start) const {
  std::string inputs = spec.sha256;
  for (const Dataset& dataset : datasets) inputs += "|" + dataset.sha256;
  return origin_here(command->words({"--shard", "--out", "--threads"}), sha256_hex(inputs), seed,
                     count, start);
}

std::shared_ptr<KeptRows> ShardFlags::rows(const Origin& origin, const fs::path& result) const {
  if (merging()) return rows_of_parts(parts, origin);
  if (result.empty()) return std::make_shared<KeptRows>();
  if (!one_of_several()) {
    return std::make_shared<KeptRows>(unfinished_beside(result), key_of(origin));
  }
  const Shard own = shard_named(shard).value();
  if (!has_part(result, origin, own)) return rows_of_shard(result, origin, own);
  print_text("{}: there already\n", part_path(result, origin, own).string());
  return nullptr;
}

void ShardFlags::run_share(const Pieces& work, KeptRows& kept, const Origin& origin,
                           const fs::path& folder) const {
  const Shard own = shard_named(shard).value();
  resumable(work, kept, own);
  write_part(kept, folder, origin, own);
  print_text("{}: {} of {} {}\n", part_path(folder, origin, own).string(), own.share(work.count),
             work.count, pieces);
}

}  // namespace recoil
