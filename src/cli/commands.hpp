#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/analysis.hpp"
#include "cli/program.hpp"
#include "core/files.hpp"
#include "core/resumable.hpp"
#include "document/document.hpp"
#include "options/option_requests.hpp"

namespace recoil {

// Each function adds one command to the program: its help and its action. Its options stand in the
// table of options. Commands throw InputError (exit status 2) or ComputationError (exit status 3).
void add_check(Program& program);
void add_simulate(Program& program);
void add_fit(Program& program);
void add_diagnose(Program& program);
void add_coverage(Program& program);
void add_init(Program& program);
void add_import(Program& program);
void add_bounce(Program& program);
void add_materials(Program& program);
void add_predict(Program& program);
void add_export(Program& program);
void add_figure(Program& program);
void add_compare(Program& program);
void add_report(Program& program);
void add_pair(Program& program);
void add_plan(Program& program);
void add_merge(Program& program);
void add_cluster(Program& program);
/// Adds the command help, which also describes the commands added before it.
void add_help(Program& program);

void add_commands(Program& program);

/// The commands whose pieces several processes can share.
void add_shared_commands(Program& program);

/// What to print: with --verbose everything.
inline Importance importance_of(const GivenOptions& given) {
  return given.has("--verbose") ? Importance::detail : Importance::answer;
}

/// The fit file of a new dataset.
inline constexpr const char* new_fit_file =
    "# docs/fit-file.md lists every key with its default.\ndataset = \".\"\n";

/// Writes the files of a result. If they cannot be written, it prints the result, so that it is not
/// lost. @throws InputError if they cannot be written
void write_or_print(const std::vector<WholeFile>& files, const std::string& result);

/// Requires that a figure can be written to `file`. @throws InputError if its name states none of
/// the formats .pdf, .svg and .png, or if it exists and is not of recoil
void require_figure(const std::filesystem::path& file);

/// Writes a figure of recoil in the format that the name of the file states. @param svg the figure
void write_figure(const std::filesystem::path& file, const std::string& svg);

/// The pixels of a figure for print. @param width of the figure [mm]
int pixels_of_figure(double width);

/// @throws InputError unless the two values of --velocity ascend
void require_range(const std::vector<double>& velocity);

/// Prints text, wrapped to the width of the terminal.
void print_line(const std::string& words);

/// Prints "note: " and `words`, in one line into a pipe.
void print_note(const std::string& words);

/// The shard of a command whose pieces several processes can share.
class ShardOfCommand {
 public:
  /// @param given outlives it
  explicit ShardOfCommand(const GivenOptions& given)
      : given_(given), pieces_(given.command() == "fit" ? "bootstrap's replicates" : "data sets") {}

  bool one_of_several() const { return given_.has("--shard"); }
  bool merging() const { return given_.has("--parts"); }

  /// @throws InputError if a shard has no folder or no pieces
  void require_share(std::size_t count) const;

  /// Identifies the command and its inputs.
  Origin origin(const FitSpec& spec, const std::vector<Dataset>& datasets, std::uint64_t seed,
                std::size_t count, const std::string& start) const;

  /// The rows of finished pieces: for a merge those of all parts, and otherwise those that a
  /// stopped run left beside `result` (with --shard, in the folder `result`). Null if the part of
  /// this shard exists, which one line on standard output reports.
  /// @param result empty: nothing is written
  std::shared_ptr<KeptRows> rows(const Origin& origin, const std::filesystem::path& result) const;

  /// Runs the pieces of this shard, and writes them as a part into the folder --out.
  void run_share(const Pieces& work, KeptRows& kept, const Origin& origin) const;

 private:
  const GivenOptions& given_;
  const char* pieces_;  ///< in messages
};

}  // namespace recoil
