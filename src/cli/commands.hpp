#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/analysis.hpp"
#include "cli/options.hpp"
#include "core/files.hpp"
#include "core/resumable.hpp"
#include "document/document.hpp"

namespace recoil {

// Each function adds one command to the program: its options, its help and its action. Commands
// throw InputError (exit status 2) or ComputationError (exit status 3).
void add_check(Program& program);
void add_simulate(Program& program);
void add_fit(Program& program);
void add_diagnose(Program& program);
void add_coverage(Program& program);
void add_init(Program& program);
void add_import(Program& program);
void add_materials(Program& program);
void add_predict(Program& program);
void add_export(Program& program);
void add_compare(Program& program);
void add_report(Program& program);
void add_pair(Program& program);
void add_plan(Program& program);
void add_merge(Program& program);
void add_cluster(Program& program);
/// Adds the command help, which also describes the commands added before it.
void add_help(Program& program);

/// The commands whose pieces several processes can share.
void add_shared_commands(Program& program);

/// Adds FIT, a required fit file. If it is missing, the error names a similar file.
void add_fit_file(const Command& command, std::string& fit_file);

/// Adds FIT for any number of fit files, none required.
Option add_fit_files(const Command& command, std::vector<std::string>& fits,
                     const std::string& meaning);

/// The options of every command that analyses, as given.
struct AnalysisFlags {
  std::string replicates;  ///< a number or "auto"; empty: the fit file's
  std::string scheme;      ///< empty: the fit file's
  std::int64_t seed = -1;
  int threads = 0;
  std::string solver = "fast";

  AnalysisOptions resolved() const;
};

void add_analysis_flags(const Command& command, AnalysisFlags& flags);

/// Options that most commands share.
struct CommonFlags {
  std::string fit_file;
  std::string dataset;     ///< id; empty: the first
  std::string parameters;  ///< a fit.json; empty: none
  std::string out;         ///< the folder of the results; empty: none is written
  bool json = false;
  bool verbose = false;
  AnalysisFlags analysis;
};

/// The seed of the option --seed; nullopt if it is negative: not given.
inline std::optional<std::uint64_t> stated_seed(std::int64_t seed) {
  return seed < 0 ? std::nullopt : std::optional(static_cast<std::uint64_t>(seed));
}

/// Add --threads and --seed. @param of for the help: "seed of OF"
void add_threads(const Command& command, int& threads);
void add_seed(const Command& command, std::int64_t& seed, const std::string& of);

/// Adds --json: prints the result as JSON instead of text.
void add_json_flag(const Command& command, bool& json);

/// Adds --verbose: prints all details.
void add_verbose_flag(const Command& command, bool& verbose);

inline Importance importance_of(bool verbose) {
  return verbose ? Importance::detail : Importance::answer;
}

/// The files with this extension in a folder, sorted; empty if the folder cannot be read.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder,
                                            const std::string& extension);

/// Writes the files of a result. If they cannot be written, it prints the result, so that it is not
/// lost. @throws InputError if they cannot be written
void write_or_print(const std::vector<WholeFile>& files, const std::string& result);

/// @throws InputError unless the two values of --velocity ascend
void require_range(const std::vector<double>& velocity);

/// Prints text, wrapped to the width of the terminal.
void print_line(const std::string& words);

/// The options of a command whose pieces several processes can share.
struct ShardFlags {
  std::string shard;               ///< "3/40"; empty: this process computes everything
  std::string parts;               ///< folder of the parts, set by `recoil merge`
  std::optional<Command> command;  ///< the origin contains its words
  std::string pieces;              ///< "data sets"

  bool one_of_several() const { return !shard.empty(); }
  bool merging() const { return !parts.empty(); }

  /// @throws InputError if a shard has no folder or no pieces
  void require_share(const std::string& out, std::size_t count) const;

  /// Identifies the command and its inputs.
  Origin origin(const FitSpec& spec, const std::vector<Dataset>& datasets, std::uint64_t seed,
                std::size_t count, const std::string& start) const;

  /// The rows of finished pieces: for a merge those of all parts, and otherwise those that a
  /// stopped run left beside `result` (with --shard, in the folder `result`). Null if the part of
  /// this shard exists, which one line on standard output reports.
  /// @param result empty: nothing is written
  std::shared_ptr<KeptRows> rows(const Origin& origin, const std::filesystem::path& result) const;

  /// Runs the pieces of this shard, and writes them as a part into `folder`.
  void run_share(const Pieces& work, KeptRows& kept, const Origin& origin,
                 const std::filesystem::path& folder) const;
};

/// Adds --shard, and an option that only `recoil merge` uses. @param pieces see ShardFlags
void add_shard_flags(const Command& command, const std::string& pieces, ShardFlags& flags);

}  // namespace recoil
