#include <fmt/format.h>

#include "cli/commands.hpp"
#include "core/quoting.hpp"
#include "core/resumable.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

/// The --out of the command without shards: a file for `coverage`, otherwise a folder.
fs::path place_of_results(const std::string& command, const fs::path& folder) {
  return command == "coverage" ? folder / "coverage.md" : folder;
}

/// Runs the command with the rows of the parts.
void finish(const Origin& origin, const fs::path& folder, const std::string& threads) {
  std::vector<std::string> words = origin.command;
  words.insert(words.end(), {"--out", place_of_results(words.front(), folder).string(), "--parts",
                             folder.string(), "--threads", threads});
  Program again("", "", "");
  add_shared_commands(again);
  again.run(words);
}

void merge(const GivenOptions& given) {
  fs::path folder = given.text("DIR");
  const std::vector<Part> parts = parts_in(folder);
  if (given.has("--missing")) {
    const std::string missing = array_list(missing_shards(parts).numbers);
    if (!missing.empty()) print_text("--array={}\n", missing);
    return;
  }
  require_all_shards(folder, parts);
  // Relative paths in the command refer to its working directory.
  const Origin& origin = parts.front().origin;
  if (fs::current_path() != origin.folder) {
    folder = fs::absolute(folder).lexically_normal();
    std::error_code failed;
    fs::current_path(origin.folder, failed);
  }
  finish(origin, folder, given.text("--threads"));
}

}  // namespace

void add_merge(Program& program) {
  program.command("merge", "combine the shards of a command into one result", R"(
Prints and writes to DIR exactly what the command without --shard would have printed and
written. merge rejects shards that come from other inputs, seeds, commands or builds of
recoil. It lists missing shards in the form of Slurm's option --array.

  recoil fit my.toml --shard 1/2 --out parts      on one machine
  recoil fit my.toml --shard 2/2 --out parts      on another
  recoil merge parts)",
                  merge);
}

}  // namespace recoil
