#include "report/words_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/row_file.hpp"

namespace recoil {
namespace {

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

std::string missing_words(const MissingShards& missing) {
  const std::string other =
      missing.otherwise == 0
          ? ""
          : fmt::format(" (parts from processors that give other digits than this one: {})",
                        missing.otherwise);
  return fmt::format("{} of {} shards are missing{}; run them again: --array={}",
                     missing.numbers.size(), missing.of, other, array_list(missing.numbers));
}

/// @throws InputError for a part that is not as it was written
void require_unaltered(const PartFile& part) {
  if (is_unaltered(part.file)) return;
  throw InputError(
      {part.file.string()}, "its rows are not those that were written",
      "they give another SHA-256 than its first line names",
      fmt::format("remove it, and run shard {}/{} again", part.shard.number, part.shard.of));
}

}  // namespace

std::vector<PartFile> parts_of_one_origin(const std::filesystem::path& folder) {
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

void require_all_shards(const std::filesystem::path& folder, const MissingShards& missing) {
  if (missing.numbers.empty()) return;
  throw ComputationError(fmt::format("{}: {}", folder.string(), missing_words(missing)));
}

std::vector<std::filesystem::path> parts_of(const Origin& origin,
                                            const std::filesystem::path& folder) {
  const std::vector<PartFile> parts = parts_of_one_origin(folder);
  require_all_shards(folder, missing_in(parts, origin.arithmetic));
  std::vector<std::filesystem::path> files;
  for (const PartFile& part : parts) {
    if (part.origin.arithmetic != origin.arithmetic) continue;
    if (const auto differs = difference(origin, part.origin)) {
      throw InputError({part.file.string()}, "this part is not of what would be computed here now",
                       difference_words(*differs), "run the shards again, into another folder");
    }
    require_unaltered(part);
    files.push_back(part.file);
  }
  return files;
}

}  // namespace recoil
