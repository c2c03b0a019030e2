#include "cli/commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "document/terminal.hpp"

namespace recoil {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> fits_beside(const fs::path& file) {
  std::vector<std::string> names;
  for (const fs::path& fit : files_in(file.has_parent_path() ? file.parent_path() : ".", ".toml")) {
    names.push_back(fit.filename().string());
  }
  return names;
}

std::string require_there(const std::string& file) {
  std::error_code failed;
  if (descriptor_named(file) || fs::exists(fs::status(file, failed))) return "";
  const std::string near = nearest_word(fs::path(file).filename().string(), fits_beside(file));
  throw InputError({file}, "no such file", "",
                   near.empty() ? "check the path"
                                : fmt::format("did you mean '{}'?",
                                              (fs::path(file).parent_path() / near).string()));
}

}  // namespace

void add_fit_file(const Command& command, std::string& fit_file) {
  command.option("FIT", fit_file, "a fit file").required().check(require_there);
}

Option add_fit_files(const Command& command, std::vector<std::string>& fits,
                     const std::string& meaning) {
  return command.option("FIT", fits, meaning).check(require_there);
}

AnalysisOptions AnalysisFlags::resolved() const {
  return analysis_options(replicates, scheme, stated_seed(seed), threads, solver);
}

void add_threads(const Command& command, int& threads) {
  command.option("--threads", threads, "threads to use (default: all cores)").within(1, 4096);
}

void add_seed(const Command& command, std::int64_t& seed, const std::string& of) {
  command.option("--seed", seed, fmt::format("seed of {} (default: from the fit file)", of))
      .within(0, 0x1p63);
}

void add_analysis_flags(const Command& command, AnalysisFlags& flags) {
  command
      .option("--replicates", flags.replicates,
              "number of bootstrap replicates; 0: none; auto: until the intervals are precise "
              "enough (default: from the fit file)")
      .auto_or(0, 1000000);
  command
      .option("--scheme", flags.scheme,
              "resampling scheme of the bootstrap (default: from the fit file)")
      .one_of(all_names<Scheme>());
  add_seed(command, flags.seed, "the random numbers, which fixes every digit of the output");
  add_threads(command, flags.threads);
  command
      .option("--solver", flags.solver,
              "how impacts are integrated: fast, or with CVODES as a reference (default: fast)")
      .one_of(all_names<Solver>());
}

void add_json_flag(const Command& command, bool& json) {
  command.flag("--json", json, "print the result as JSON; notes and warnings go to stderr");
}

void add_verbose_flag(const Command& command, bool& verbose) {
  command.flag("--verbose", verbose, "print all details");
}

void print_line(const std::string& words) { print_text("{}\n", wrap(words, terminal_columns, 2)); }

void require_range(const std::vector<double>& velocity) {
  if (velocity[0] < velocity[1]) return;
  throw InputError({}, fmt::format("--velocity {:g},{:g} is not a range", velocity[0], velocity[1]),
                   "the first number must be the smaller one", "for example --velocity 1,50");
}

std::vector<fs::path> files_in(const fs::path& folder, const std::string& extension) {
  std::vector<fs::path> files;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(folder, failed)) {
    if (entry.path().extension() == extension) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

void write_or_print(const std::vector<WholeFile>& files, const std::string& result) {
  try {
    write_whole_files(files);
  } catch (const InputError&) {
    print_text("{}", result);
    throw;
  }
}

void add_shared_commands(Program& program) {
  add_fit(program);
  add_coverage(program);
  add_diagnose(program);
}

void add_shard_flags(const Command& command, const std::string& pieces, ShardFlags& flags) {
  flags.command = command;
  flags.pieces = pieces;
  command
      .option("--shard", flags.shard,
              fmt::format("compute only shard K of N (1/N to N/N) of the {} and write it to DIR; "
                          "recoil merge DIR combines the shards",
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
    throw InputError({}, fmt::format("there are no {} to divide", pieces), "",
                     "leave --shard out, or request some");
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
  print_text("{}: exists already\n", part_path(result, origin, own).string());
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
