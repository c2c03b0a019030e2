#include "core/resumable.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/numbers.hpp"
#include "core/parallel.hpp"
#include "core/program.hpp"
#include "core/progress.hpp"
#include "core/quoting.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

/// The messages if a field of two origins differs. The list begins with the most general field.
constexpr std::pair<const char*, const char*> differences[] = {
    {"version", "they come from different versions of recoil"},
    {"program", "they come from different builds of recoil"},
    {"seed", "their seeds differ"},
    {"command", "their commands differ"},
    {"pieces", "they are parts of different numbers of pieces"},
    {"inputs", "the fit file or the data have changed between them"},
    {"arithmetic", "their processors give different digits"},
    {"start", "their fits differ in digits"}};

/// The first line of a part.
struct PartHead {
  std::size_t part = 0;
  std::size_t of = 0;
  Origin origin;
  RECOIL_FIELDS(part, of, origin)
};

/// The part in a file; nullopt if the file is none.
std::optional<Part> part_in(const fs::path& file) {
  const std::string name = file.filename().string();
  if (!name.starts_with("part-") || !name.ends_with(".jsonl")) return std::nullopt;
  const std::optional<Json> head = read_row_head(file);
  if (!head) return std::nullopt;
  try {
    const PartHead part = value_from<PartHead>(*head);
    const auto shard = shard_named(fmt::format("{}/{}", part.part, part.of));
    const Origin& origin = part.origin;
    if (!shard || origin.command.empty() || origin.pieces < 1 || origin.pieces > most_pieces) {
      return std::nullopt;
    }
    return Part{file, origin, *shard};
  } catch (const JsonMismatch&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<Shard> shard_named(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto number = parse_whole_number(text.substr(0, slash));
  const auto of = parse_whole_number(text.substr(slash + 1));
  if (trimmed(text) != text || !number || !of || *number < 1 || *number > *of ||
      *of > std::int64_t{most_shards}) {
    return std::nullopt;
  }
  return Shard{static_cast<std::size_t>(*number), static_cast<std::size_t>(*of)};
}

void resumable(const Pieces& pieces, KeptRows& kept, const Shard& shard) {
  std::vector<std::size_t> left;
  for (std::size_t i = shard.number - 1; i < pieces.count; i += shard.of) {
    if (!kept.has(i)) left.push_back(i);
  }
  resumable(kept, [&] {
    Progress progress(pieces.label, left.size());
    parallel_over(left.size(), pieces.threads, [&](std::size_t k) {
      kept.put(left[k], pieces.run(left[k]));
      progress.advance();
    });
    return left.size();
  });
}

Origin origin_here(std::vector<std::string> command, const std::string& inputs, std::uint64_t seed,
                   std::size_t pieces, const std::string& start) {
  return {std::move(command),
          fs::current_path().string(),
          version(),
          program_stamp(),
          inputs,
          seed,
          pieces,
          arithmetic_fingerprint(),
          sha256_hex(start)};
}

std::string key_of(const Origin& origin) {
  Json fields = as_json(origin);
  fields.erase("folder");
  return sha256_hex(json_line(fields));
}

std::string difference(const Origin& a, const Origin& b) {
  const Json one = as_json(a);
  const Json other = as_json(b);
  for (const auto& [field, words] : differences) {
    if (one[field] != other[field]) return words;
  }
  return "";
}

fs::path unfinished_beside(const fs::path& result) {
  return result.parent_path() / ("unfinished-" + result.filename().string() + ".jsonl");
}

fs::path part_path(const fs::path& folder, const Origin& origin, const Shard& shard) {
  return folder / fmt::format("part-{}-of-{}-{}.jsonl", shard.number, shard.of,
                              key_of(origin).substr(0, 12));
}

bool has_part(const fs::path& folder, const Origin& origin, const Shard& shard) {
  return part_in(part_path(folder, origin, shard)).has_value();
}

std::shared_ptr<KeptRows> rows_of_shard(const fs::path& folder, const Origin& origin,
                                        const Shard& shard) {
  const std::string part = part_path("", origin, shard).string();
  return std::make_shared<KeptRows>(folder / ("unfinished-" + part), key_of(origin));
}

void write_part(const KeptRows& kept, const fs::path& folder, const Origin& origin,
                const Shard& shard) {
  write_rows(part_path(folder, origin, shard), as_json(PartHead{shard.number, shard.of, origin}),
             kept.rows());
  kept.forget();
}

std::vector<Part> parts_in(const fs::path& folder) {
  std::vector<Part> parts;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(folder, failed)) {
    if (auto part = part_in(entry.path())) parts.push_back(std::move(*part));
  }
  if (parts.empty()) {
    throw InputError({folder.string()}, "there are no parts here",
                     "a command with --shard K/N --out DIR writes them", "name its folder");
  }
  std::ranges::sort(parts, [](const Part& a, const Part& b) {
    return std::tie(a.shard.of, a.shard.number, a.file) <
           std::tie(b.shard.of, b.shard.number, b.file);
  });
  for (const Part& part : parts) {
    Origin first = parts.front().origin;
    first.arithmetic = part.origin.arithmetic;
    first.start = part.origin.start;
    const std::string why = difference(first, part.origin);
    if (why.empty()) continue;
    throw InputError(
        {part.file.string()},
        fmt::format("this part does not belong to {}", parts.front().file.filename().string()), why,
        "remove the parts that you do not want");
  }
  return parts;
}

MissingShards missing_shards(const std::vector<Part>& parts) {
  const std::string here = arithmetic_fingerprint();
  const std::size_t pieces = parts.front().origin.pieces;
  MissingShards missing;
  std::vector<bool> finished(pieces);
  std::map<std::size_t, int> count;
  for (const Part& part : parts) {
    ++count[part.shard.of];
    if (part.origin.arithmetic != here) {
      ++missing.otherwise;
      continue;
    }
    for (std::size_t i = part.shard.number - 1; i < pieces; i += part.shard.of) finished[i] = true;
  }
  missing.of = std::ranges::max_element(count, [](const auto& a, const auto& b) {
                 return a.second < b.second;
               })->first;
  for (std::size_t number = 1; number <= missing.of; ++number) {
    bool all = true;
    for (std::size_t i = number - 1; i < pieces; i += missing.of) all = all && finished[i];
    if (!all) missing.numbers.push_back(number);
  }
  return missing;
}

std::string array_list(const std::vector<std::size_t>& numbers) {
  std::string list;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    if (!list.empty()) list += ',';
    list +=
        last == i ? fmt::format("{}", numbers[i]) : fmt::format("{}-{}", numbers[i], numbers[last]);
    i = last + 1;
  }
  return list;
}

void require_all_shards(const fs::path& folder, const std::vector<Part>& parts) {
  const MissingShards missing = missing_shards(parts);
  if (missing.numbers.empty()) return;
  const std::string other =
      missing.otherwise == 0
          ? ""
          : fmt::format(" (parts from processors that give other digits than this one: {})",
                        missing.otherwise);
  throw ComputationError(
      fmt::format("{}: {} of {} shards are missing{}; run them again: --array={}", folder.string(),
                  missing.numbers.size(), missing.of, other, array_list(missing.numbers)));
}

std::shared_ptr<KeptRows> rows_of_parts(const fs::path& folder, const Origin& origin) {
  const std::vector<Part> parts = parts_in(folder);
  require_all_shards(folder, parts);
  auto kept = std::make_shared<KeptRows>();
  for (const Part& part : parts) {
    if (part.origin.arithmetic != origin.arithmetic) continue;
    if (const std::string why = difference(origin, part.origin); !why.empty()) {
      throw InputError({part.file.string()}, "this part belongs to another computation", why,
                       "run the shards again, into another folder");
    }
    std::optional<Rows> rows = read_rows(part.file);
    if (!rows) {
      throw InputError(
          {part.file.string()}, "its rows have been changed",
          "their SHA-256 differs from that in the first line",
          fmt::format("remove it, and run shard {}/{} again", part.shard.number, part.shard.of));
    }
    kept->add(std::move(*rows), part.file);
  }
  return kept;
}

}  // namespace recoil
