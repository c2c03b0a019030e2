#include "cli/common_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "core/error.hpp"

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

void add_fit_file(CLI::App& command, std::string& fit_file) {
  command.add_option("FIT", fit_file, "a fit file")->required()->check(require_there);
}

CLI::Option* add_fit_files(CLI::App& command, std::vector<std::string>& fits,
                           const std::string& meaning) {
  return command.add_option("FIT", fits, meaning)->check(require_there);
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

void add_analysis_flags(CLI::App& command, AnalysisFlags& flags) {
  command
      .add_option(
          "--replicates", flags.replicates,
          "bootstrap replicates; 0: none, auto: as many as it takes (default: the fit file's)")
      ->check(CLI::IsMember({"auto"}) | CLI::Range(0, 1000000));
  command
      .add_option("--scheme", flags.scheme,
                  "how the bootstrap draws new data sets (default: the fit file's)")
      ->check(CLI::IsMember(all_names<Scheme>()));
  command
      .add_option("--seed", flags.seed,
                  "seed of the random numbers; fixes every digit (default: the fit file's)")
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()));
  command.add_option("--threads", flags.threads, "threads to use (default: all cores)")
      ->check(CLI::Range(1, 4096));
  command
      .add_option("--solver", flags.solver,
                  "how impacts are integrated; reference: CVODES (default: fast)")
      ->check(CLI::IsMember(all_names<Solver>()));
}

void add_json_flag(CLI::App& command, bool& json) {
  command.add_flag("--json", json,
                   "print the result as JSON instead; what else there is to say goes to stderr");
}

void add_verbose_flag(CLI::App& command, bool& verbose) {
  command.add_flag("--verbose", verbose, "print all details, not the answer alone");
}

void write_or_print(const std::vector<WholeFile>& files, const std::string& result) {
  try {
    write_whole_files(files);
  } catch (const InputError&) {
    fmt::print("{}", result);
    throw;
  }
}

CLI::Validator positive_number(const std::string& what, double low, double high) {
  return {[=](const std::string& text) -> std::string {
            double value = 0.0;
            const bool number = CLI::detail::lexical_cast(text, value);
            if (number && value >= low && value <= high) return {};
            return fmt::format("{} is not a {} between {:g} and {:g}", text, what, low, high);
          },
          what};
}

}  // namespace recoil
