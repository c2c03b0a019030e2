#include "cli/common_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "cli/commands.hpp"
#include "core/error.hpp"
#include "core/quoting.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> fits_beside(const fs::path& file) {
  std::vector<std::string> names;
  std::error_code failed;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  for (const auto& entry : fs::directory_iterator(folder, failed)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string require_there(const std::string& file) {
  std::error_code failed;
  if (fs::exists(fs::status(file, failed))) return "";
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
  AnalysisOptions options;
  options.replicates_auto = replicates == "auto";
  if (!replicates.empty() && !options.replicates_auto) options.replicates = std::stoi(replicates);
  if (!scheme.empty()) options.scheme = value_named<Scheme>(scheme);
  if (seed >= 0) options.seed = static_cast<std::uint64_t>(seed);
  options.threads = threads;
  options.solver = value_named<Solver>(solver).value_or(Solver::fast);
  return options;
}

void add_analysis_flags(const Command& command, AnalysisFlags& flags) {
  command
      .option("--replicates", flags.replicates,
              "bootstrap replicates; 0: none, auto: as many as it takes (default: the fit file's)")
      .auto_or(0, 1000000);
  command
      .option("--scheme", flags.scheme,
              "how the bootstrap draws new data sets (default: the fit file's)")
      .one_of(all_names<Scheme>());
  command
      .option("--seed", flags.seed,
              "seed of the random numbers; fixes every digit (default: the fit file's)")
      .within(std::int64_t{0}, std::numeric_limits<std::int64_t>::max());
  command.option("--threads", flags.threads, "threads to use (default: all cores)").within(1, 4096);
  command
      .option("--solver", flags.solver,
              "how impacts are integrated; reference: CVODES (default: fast)")
      .one_of(all_names<Solver>());
}

void add_json_flag(const Command& command, bool& json) {
  command.flag("--json", json,
               "print the result as JSON instead; what else there is to say goes to stderr");
}

void add_verbose_flag(const Command& command, bool& verbose) {
  command.flag("--verbose", verbose, "print all details, not the answer alone");
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

}  // namespace recoil
