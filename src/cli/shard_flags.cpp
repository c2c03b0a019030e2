#include "cli/shard_flags.hpp"

#include <fmt/format.h>

#include "core/arithmetic.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program.hpp"
#include "report/words_uncertainty.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

/// The words that decide the digits, in the order of the help, however they were given.
std::vector<std::string> words_of(const CLI::App& command) {
  std::vector<std::string> words = {command.get_name()};
  std::vector<std::string> positionals;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0 || option->get_group().empty()) continue;  // not given, or --parts
    if (option->get_positional()) {
      for (const std::string& word : option->results()) positionals.push_back(word);
      continue;
    }
    const std::string name = option->get_name();
    if (name == "--shard" || name == "--out" || name == "--threads") continue;
    words.push_back(name);
    if (option->get_expected_max() == 0) continue;  // a flag
    for (const std::string& word : option->results()) words.push_back(word);
  }
  words.insert(words.begin() + 1, positionals.begin(), positionals.end());
  return words;
}

}  // namespace

void add_shard_flags(CLI::App& command, const std::string& pieces, ShardFlags& flags) {
  flags.command = &command;
  command
      .add_option("--shard", flags.shard,
                  fmt::format("run only the K-th of N shares of the {}, from 1/N to N/N, and write "
                              "it as a part into DIR, for recoil merge DIR",
                              pieces))
      ->type_name("K/N")
      ->check([](const std::string& text) -> std::string {
        if (shard_named(text)) return {};
        return fmt::format("{} is not K/N with K from 1 to N and N up to {}", text, most_shards);
      });
  command.add_option("--parts", flags.parts)->group("");
}

Origin origin_of(const ShardFlags& flags, const std::string& inputs, std::uint64_t seed,
                 std::size_t pieces, const std::string& start) {
  return {words_of(*flags.command),
          fs::current_path().string(),
          version(),
          program_stamp(),
          inputs,
          seed,
          pieces,
          arithmetic_fingerprint(),
          sha256_hex(start)};
}

std::string inputs_of(const FitSpec& spec, const std::vector<Dataset>& datasets) {
  std::string text = spec.sha256;
  for (const Dataset& dataset : datasets) text += "|" + dataset.sha256;
  return sha256_hex(text);
}

void require_share(const std::string& out, std::size_t pieces, const std::string& what) {
  if (out.empty()) {
    throw InputError({}, "--shard needs --out DIR", "the part is written there",
                     "give all shards the same folder");
  }
  if (pieces == 0) {
    throw InputError({}, fmt::format("there are no {} to share", what), "",
                     "leave --shard out, or ask for some");
  }
  require_writable_folder(out);
}

bool part_is_there(const fs::path& folder, const Origin& origin, const Shard& shard) {
  const fs::path file = part_path(folder, origin, shard);
  if (!part_in(file)) return false;
  fmt::print("{}: there already\n", file.string());
  return true;
}

void say_part(const fs::path& folder, const Origin& origin, const Shard& shard,
              const std::string& what) {
  fmt::print("{}: {} of {} {}\n", part_path(folder, origin, shard).string(),
             shard.share(origin.pieces), origin.pieces, what);
}

}  // namespace recoil
