#include <fmt/format.h>

#include <memory>

#include "cli/commands.hpp"
#include "core/quoting.hpp"
#include "core/resumable.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

struct MergeFlags {
  std::string folder;
  bool missing = false;
  int threads = 0;
};

/// The --out of the command without shards: a file for `coverage`, otherwise a folder.
fs::path place_of_results(const std::string& command, const fs::path& folder) {
  return command == "coverage" ? folder / "coverage.md" : folder;
}

/// Runs the command with the rows of the parts.
void finish(const Origin& origin, const fs::path& folder, int threads) {
  std::vector<std::string> words = origin.command;
  words.insert(words.end(), {"--out", place_of_results(words.front(), folder).string(), "--parts",
                             folder.string()});
  if (threads > 0) words.insert(words.end(), {"--threads", fmt::format("{}", threads)});
  Program again("", "", "");
  add_shared_commands(again);
  again.run(words);
}

void merge(const MergeFlags& flags) {
  const std::vector<Part> parts = parts_in(flags.folder);
  if (flags.missing) {
    const std::string missing = array_list(missing_shards(parts).numbers);
    if (!missing.empty()) print_text("--array={}\n", missing);
    return;
  }
  require_all_shards(flags.folder, parts);
  // Relative paths in the command refer to its working directory.
  const Origin& origin = parts.front().origin;
  fs::path folder = flags.folder;
  if (fs::current_path() != origin.folder) {
    folder = fs::absolute(folder).lexically_normal();
    std::error_code failed;
    fs::current_path(origin.folder, failed);
  }
  finish(origin, folder, flags.threads);
}

}  // namespace

void add_merge(Program& program) {
  const Command command =
      program.command("merge", "combine the shards of a command into one result", R"(
Prints and writes to DIR exactly what the command without --shard would have printed and
written. merge rejects shards that come from other inputs, seeds, commands or builds of
recoil. It lists missing shards in the form of Slurm's option --array.

  recoil fit my.toml --shard 1/2 --out parts      on one machine
  recoil fit my.toml --shard 2/2 --out parts      on another
  recoil merge parts)");
  const auto flags = std::make_shared<MergeFlags>();
  command.option("DIR", flags->folder, "the folder of the shards").required();
  command.flag("--missing", flags->missing,
               "only print the missing shards, as --array=3,7-9; print nothing if none is missing");
  add_threads(command, flags->threads);
  command.runs([flags] { merge(*flags); });
}

}  // namespace recoil
