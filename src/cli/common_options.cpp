#include "cli/common_options.hpp"

#include <fmt/format.h>

#include <limits>

namespace recoil {

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
