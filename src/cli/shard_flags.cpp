#include "cli/shard_flags.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "core/arithmetic.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "report/words_intervals.hpp"

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

/// "they come from different versions of recoil".
std::string difference_words(OriginDifference what) {
  switch (what) {
    case OriginDifference::version:
      return "they come from different versions of recoil";
    case OriginDifference::program:
      return "they come from different builds of recoil";
    case OriginDifference::command:
      return "their commands differ";
    case OriginDifference::seed:
      return "their seeds differ";
    case OriginDifference::pieces:
      return "they are parts of different numbers of pieces";
    case OriginDifference::inputs:
      return "the fit file or the data have changed between them";
    case OriginDifference::arithmetic:
      return "their processors give different digits";
    case OriginDifference::start:
      return "they begin with different digits of the fit";
  }
  return "";
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

std::vector<PartFile> parts_of_one_origin(const fs::path& folder) {
  std::vector<PartFile> parts = parts_in(folder);
  if (parts.empty()) {
    throw InputError({folder.string()}, "there are no parts here",
                     "a command with --shard K/N --out DIR writes them", "name its folder");
  }
  for (const PartFile& part : parts) {
    const auto differs = difference(parts.front().origin, part.origin);
    if (!differs || *differs == OriginDifference::arithmetic ||
        *differs == OriginDifference::start) {
      continue;
    }
    throw InputError(
        {part.file.string()},
        fmt::format("this part does not belong to {}", parts.front().file.filename().string()),
        difference_words(*differs), "remove the parts that you do not want");
  }
  return parts;
}

MissingShards missing_in(const std::vector<PartFile>& parts, const std::string& arithmetic) {
  MissingShards missing;
  std::vector<PartFile> usable;
  std::map<std::size_t, int> count;
  for (const PartFile& part : parts) {
    ++count[part.shard.of];
    if (part.origin.arithmetic == arithmetic) usable.push_back(part);
  }
  missing.of = std::max_element(count.begin(), count.end(), [](const auto& a, const auto& b) {
                 return a.second < b.second;
               })->first;
  missing.otherwise = parts.size() - usable.size();
  missing.numbers = missing_shards(usable, parts.front().origin.pieces, missing.of);
  return missing;
}

std::string missing_words(const MissingShards& missing) {
  const std::string other =
      missing.otherwise == 0
          ? ""
          : fmt::format(" (parts from processors that give other digits than this one: {})",
                        missing.otherwise);
  return fmt::format("{} of {} shards are missing{}; run them again: --array={}",
                     missing.numbers.size(), missing.of, other, array_list(missing.numbers));
}

std::vector<fs::path> parts_of(const Origin& origin, const fs::path& folder) {
  const std::vector<PartFile> parts = parts_of_one_origin(folder);
  const MissingShards missing = missing_in(parts, origin.arithmetic);
  if (!missing.numbers.empty()) {
    throw ComputationError(fmt::format("{}: {}", folder.string(), missing_words(missing)));
  }
  std::vector<fs::path> files;
  for (const PartFile& part : parts) {
    if (part.origin.arithmetic != origin.arithmetic) continue;
    if (const auto differs = difference(origin, part.origin)) {
      throw InputError({part.file.string()}, "this part is not of what would be computed here now",
                       difference_words(*differs), "run the shards again, into another folder");
    }
    files.push_back(part.file);
  }
  return files;
}

}  // namespace recoil
