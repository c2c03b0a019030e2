#include "core/resumable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "core/program.hpp"
#include "core/progress.hpp"
#include "core/quoting.hpp"

namespace recoil {

namespace {

/// Opens a file of rows, but no pipe or device.
std::ifstream open_rows(const std::filesystem::path& file) {
  std::error_code failed;
  return std::filesystem::is_regular_file(file, failed) ? std::ifstream(file, std::ios::binary)
                                                        : std::ifstream();
}

/// The checksum of head and rows. @param head without its own "sha256"
std::string checksum(const Json& head, std::string_view rows) {
  return sha256_hex(json_line(head) + "\n" + std::string(rows));
}

/// The head in the first line of `in`.
std::optional<Json> head_in(std::istream& in) {
  std::string line;
  if (!in.good() || !std::getline(in, line)) return std::nullopt;
  Json head = Json::parse(line, nullptr, false);
  if (!head.is_object() || !head.value("rows", Json()).is_number_unsigned() ||
      !head.value("bytes", Json()).is_number_unsigned() ||
      !head.value("sha256", Json()).is_string()) {
    return std::nullopt;
  }
  return head;
}

/// Adds the row of one line, "[7,ROW]". @return whether the line is one
bool add_row(std::string_view line, Rows& rows) {
  if (line.size() < 4 || line.front() != '[' || line.back() != ']') return false;
  std::size_t piece = 0;
  const char* const end = line.data() + line.size();
  const auto number = std::from_chars(line.data() + 1, end, piece);
  if (number.ec != std::errc{} || *number.ptr != ',') return false;
  rows[piece] = std::string(number.ptr + 1, end - 1);
  return true;
}

}  // namespace

void write_rows(const std::filesystem::path& file, Json head, const Rows& rows) {
  std::string text;
  for (const auto& [piece, row] : rows) text += fmt::format("[{},{}]\n", piece, row);
  head["rows"] = rows.size();
  head["bytes"] = text.size();
  head["sha256"] = checksum(head, text);
  write_whole_file(file, json_line(head) + "\n" + text);
}

std::optional<Json> read_row_head(const std::filesystem::path& file) {
  std::ifstream in = open_rows(file);
  std::optional<Json> head = head_in(in);
  if (!head) return std::nullopt;
  const std::uintmax_t line = static_cast<std::uintmax_t>(in.tellg());
  std::error_code failed;
  const std::uintmax_t size = std::filesystem::file_size(file, failed);
  if (failed || size != line + head->at("bytes").get<std::uintmax_t>()) return std::nullopt;
  return head;
}

std::optional<Rows> read_rows(const std::filesystem::path& file) {
  std::ifstream in = open_rows(file);
  std::optional<Json> head = head_in(in);
  if (!head) return std::nullopt;
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string stated = head->at("sha256").get<std::string>();
  head->erase("sha256");
  if (checksum(*head, text) != stated) return std::nullopt;
  Rows rows;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (!add_row(std::string_view(text).substr(begin, end - begin), rows)) return std::nullopt;
    begin = end + 1;
  }
  if (rows.size() != head->at("rows").get<std::size_t>()) return std::nullopt;
  return rows;
}

void KeepingPace::keep(const std::function<void()>& write) {
  const Clock::time_point begin = Clock::now();
  try {
    write();
    reported_ = false;
  } catch (const InputError& error) {
    if (!std::exchange(reported_, true)) print_text(stderr, "{}\n", error.what());
  }
  const Clock::time_point end = Clock::now();
  next_ = end + std::max<Clock::duration>(most_lost_, longer_than_writing * (end - begin));
}

KeptRows::KeptRows(std::filesystem::path file, std::string key, KeepingPace pace)
    : file_(std::move(file)), key_(std::move(key)), pace_(pace) {
  if (file_.empty()) return;
  const std::optional<Json> head = read_row_head(file_);
  if (!head || head->value("key", Json()) != key_) return;
  if (std::optional<Rows> rows = read_rows(file_)) rows_ = std::move(*rows);
}

std::optional<Json> KeptRows::find(std::size_t piece) const {
  std::string text;
  {
    const std::lock_guard lock(mutex_);
    const auto found = rows_.find(piece);
    if (found == rows_.end()) return std::nullopt;
    text = found->second;
  }
  Json row = Json::parse(text, nullptr, false);
  return row.is_discarded() ? std::nullopt : std::optional<Json>(std::move(row));
}

bool KeptRows::has(std::size_t piece) const {
  const std::lock_guard lock(mutex_);
  return rows_.contains(piece);
}

void KeptRows::put(std::size_t piece, const Json& row) {
  end_if_called_off();
  std::string text = json_line(row);
  const std::lock_guard lock(mutex_);
  rows_[piece] = std::move(text);
  if (!file_.empty() && pace_.is_due()) pace_.keep([this] { write(); });
}

void KeptRows::add(Rows rows) {
  const std::lock_guard lock(mutex_);
  rows_.merge(rows);
}

void KeptRows::keep() {
  const std::lock_guard lock(mutex_);
  if (!file_.empty()) write();
}

void KeptRows::forget() const {
  std::error_code ignored;
  if (!file_.empty()) std::filesystem::remove(file_, ignored);
}

std::size_t KeptRows::size() const {
  const std::lock_guard lock(mutex_);
  return rows_.size();
}

std::vector<std::size_t> KeptRows::pieces() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::size_t> numbers;
  for (const auto& [piece, row] : rows_) numbers.push_back(piece);
  return numbers;
}

void KeptRows::write() const { write_rows(file_, {{"key", key_}}, rows_); }
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

std::optional<std::size_t> count_named(std::string_view text) {
  std::size_t value = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (read.ec != std::errc{} || read.ptr != end) return std::nullopt;
  return value;
}

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
  const auto number = count_named(text.substr(0, slash));
  const auto of = count_named(text.substr(slash + 1));
  if (!number || !of || *number < 1 || *number > *of || *of > most_shards) return std::nullopt;
  return Shard{*number, *of};
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
    kept->add(std::move(*rows));
  }
  return kept;
}

}  // namespace recoil
