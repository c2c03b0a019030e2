#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/commands.hpp"
#include "cli/shard_flags.hpp"
#include "core/arithmetic.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

struct MergeFlags {
  std::string folder;
  bool missing = false;
  int threads = 0;
};

/// What the one command writes into the folder of its parts: all commands write into a folder, but
/// `coverage` one file.
fs::path place_of_results(const std::string& command, const fs::path& folder) {
  return command == "coverage" ? folder / "coverage.md" : folder;
}

/// Runs the command again with all pieces at hand.
void finish(const Origin& origin, const fs::path& folder, int threads) {
  std::vector<std::string> words = origin.command;
  words.insert(words.end(), {"--out", place_of_results(words.front(), folder).string(), "--parts",
                             folder.string()});
  if (threads > 0) words.insert(words.end(), {"--threads", fmt::format("{}", threads)});
  CLI::App again("", "recoil");
  add_fit(again);
  add_coverage(again);
  add_diagnose(again);
  add_report(again);
  std::reverse(words.begin(), words.end());  // as CLI11 takes them
  again.parse(words);
}

void merge(const MergeFlags& flags) {
  const std::vector<PartFile> parts = parts_of_one_origin(flags.folder);
  const MissingShards missing = missing_in(parts, arithmetic_fingerprint());
  if (flags.missing) {
    if (!missing.numbers.empty()) fmt::print("--array={}\n", array_list(missing.numbers));
    return;
  }
  require_all_shards(flags.folder, missing);
  // Paths in the words count from where the command was given.
  const Origin& origin = parts.front().origin;
  fs::path folder = flags.folder;
  if (fs::current_path() != origin.folder) {
    folder = fs::absolute(folder).lexically_normal();
    std::error_code elsewhere;
    fs::current_path(origin.folder, elsewhere);
  }
  finish(origin, folder, flags.threads);
}

}  // namespace

void add_merge(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "merge", "put the parts of a sharded command together, as if one process had run it");
  command->footer(
      "Prints and writes into DIR what the command without --shard would have printed and\n"
      "written, byte for byte. Parts of other inputs, seeds, commands or builds of recoil are\n"
      "refused. What is missing is told as Slurm's --array= takes it.\n\n"
      "  recoil fit my.toml --shard 1/2 --out parts      on one machine\n"
      "  recoil fit my.toml --shard 2/2 --out parts      on another\n"
      "  recoil merge parts");
  const auto flags = std::make_shared<MergeFlags>();
  command->add_option("DIR", flags->folder, "the folder of the parts")->required();
  command->add_flag("--missing", flags->missing,
                    "only print which shards are missing, as --array=3,7-9; nothing when none is");
  command->add_option("--threads", flags->threads, "threads to use (default: all cores)")
      ->check(CLI::Range(1, 4096));
  command->callback([flags] { merge(*flags); });
}

}  // namespace recoil
