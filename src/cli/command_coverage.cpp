#include <fmt/format.h>

#include <memory>

#include "cli/analysis.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "core/files.hpp"
#include "uncertainty/coverage_truth.hpp"

namespace recoil {

void add_coverage(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("coverage", "how often the intervals hold the truth, measured");
  command->footer(
      "Simulates the design of the fit again and again from a known truth (the recipe's, or the\n"
      "fit's own estimate), fits each data set as you would, and counts. Prints Markdown.\n\n"
      "  recoil coverage fits/dahneke1975-quartz.toml --datasets 100 --out reports/coverage.md");
  struct Options {
    std::string fit_file;
    std::string out;
    int datasets = 100;
    AnalysisFlags analysis;
  };
  const auto options = std::make_shared<Options>();
  command->add_option("FIT", options->fit_file, "a fit file")->required();
  command->add_option("--datasets", options->datasets, "simulated data sets")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000));
  command->add_option("--out", options->out, "write the table here, too");
  add_analysis_flags(*command, options->analysis);
  command->callback([options] {
    if (!options->out.empty()) {
      require_writable_folder(std::filesystem::absolute(options->out).parent_path());
    }
    const FitSpec spec = load_fit(options->fit_file);
    const std::vector<Dataset> datasets = load_datasets(spec);
    const AnalysisOptions flags = options->analysis.resolved();
    CoverageOptions coverage;
    coverage.datasets = options->datasets;
    coverage.uncertainty.level = spec.uncertainty.level;
    coverage.uncertainty.replicates = flags.replicates.value_or(spec.uncertainty.replicates);
    coverage.uncertainty.seed = flags.seed.value_or(spec.uncertainty.seed);
    coverage.uncertainty.threads = flags.threads;
    const CoverageTruth truth = coverage_truth(spec, datasets, coverage.uncertainty.seed);
    std::string table = to_markdown(measure_coverage(spec, truth, coverage), spec, coverage);
    for (const Dataset& dataset : datasets) {
      table += fmt::format("\n`{}`: {}\n", dataset.id, provenance_sentence(dataset.provenance));
    }
    if (!options->out.empty()) write_whole_file(options->out, table);
    fmt::print("{}", table);
  });
}

}  // namespace recoil
