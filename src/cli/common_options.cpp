#include "cli/common_options.hpp"

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

}  // namespace recoil
