#include "cli/commands.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "document/terminal.hpp"

namespace recoil {

namespace fs = std::filesystem;

void print_line(const std::string& words) { print_text("{}\n", wrap(words, terminal_columns, 2)); }

void print_note(const std::string& words) {
  const bool wraps = isatty(STDOUT_FILENO) == 1 || std::getenv("COLUMNS") != nullptr;
  print_text("note: {}\n", wraps ? wrap(words, terminal_columns - 6, 2) : words);
}

void require_range(const std::vector<double>& velocity) {
  if (velocity[0] < velocity[1]) return;
  throw InputError({}, fmt::format("--velocity {:g},{:g} is not a range", velocity[0], velocity[1]),
                   "the first number must be the smaller one", "for example --velocity 1,50");
}

void write_or_print(const std::vector<WholeFile>& files, const std::string& result) {
  try {
    write_whole_files(files);
  } catch (const InputError&) {
    print_text("{}", result);
    throw;
  }
}

void add_commands(Program& program) {
  add_check(program);
  add_simulate(program);
  add_fit(program);
  add_diagnose(program);
  add_coverage(program);
  add_init(program);
  add_import(program);
  add_bounce(program);
  add_materials(program);
  add_predict(program);
  add_figure(program);
  add_export(program);
  add_compare(program);
  add_report(program);
  add_merge(program);
  add_cluster(program);
  add_pair(program);
  add_plan(program);
  add_help(program);
}

void add_shared_commands(Program& program) {
  add_fit(program);
  add_coverage(program);
  add_diagnose(program);
}

void ShardOfCommand::require_share(std::size_t count) const {
  if (!given_.has("--out")) {
    throw InputError({}, "--shard needs --out DIR", "the part is written there",
                     "give all shards the same folder");
  }
  if (count == 0) {
    throw InputError({}, fmt::format("there are no {} to divide", pieces_), "",
                     "leave --shard out, or request some");
  }
  require_writable_folder(given_.text("--out"));
}

Origin ShardOfCommand::origin(const FitSpec& spec, const std::vector<Dataset>& datasets,
                              std::uint64_t seed, std::size_t count,
                              const std::string& start) const {
  std::string inputs = spec.sha256;
  for (const Dataset& dataset : datasets) inputs += "|" + dataset.sha256;
  return origin_here(given_.words({"--shard", "--out", "--threads"}), sha256_hex(inputs), seed,
                     count, start);
}

std::shared_ptr<KeptRows> ShardOfCommand::rows(const Origin& origin, const fs::path& result) const {
  if (merging()) return rows_of_parts(given_.text("--parts"), origin);
  if (result.empty()) return std::make_shared<KeptRows>();
  if (!one_of_several()) {
    return std::make_shared<KeptRows>(unfinished_beside(result), key_of(origin));
  }
  const Shard own = shard_named(given_.text("--shard")).value();
  if (!has_part(result, origin, own)) return rows_of_shard(result, origin, own);
  print_text("{}: exists already\n", part_path(result, origin, own).string());
  return nullptr;
}

void ShardOfCommand::run_share(const Pieces& work, KeptRows& kept, const Origin& origin) const {
  const fs::path folder = given_.text("--out");
  const Shard own = shard_named(given_.text("--shard")).value();
  resumable(work, kept, own);
  write_part(kept, folder, origin, own);
  print_text("{}: {} of {} {}\n", part_path(folder, origin, own).string(), own.share(work.count),
             work.count, pieces_);
}

}  // namespace recoil
