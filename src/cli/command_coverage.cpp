#include <fmt/format.h>

#include <memory>

#include "cli/analysis.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/coverage_words.hpp"
#include "cli/json_coverage.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "coverage/coverage_truth.hpp"
#include "report/words_dataset.hpp"

namespace recoil {

namespace {

struct Options {
  std::string fit_file;
  std::string out;
  int datasets = 100;
  bool json = false;
  AnalysisFlags analysis;
};

void run(const Options& options) {
  if (!options.out.empty()) {
    require_writable_folder(std::filesystem::absolute(options.out).parent_path());
  }
  const FitSpec spec = load_fit(options.fit_file);
  const std::vector<Dataset> datasets = load_datasets(spec);
  CoverageOptions coverage;
  coverage.datasets = options.datasets;
  coverage.uncertainty = uncertainty_options(spec, options.analysis.resolved());
  require_scheme(spec, coverage.uncertainty.scheme, gather(datasets));
  const CoverageTruth truth = coverage_truth(spec, datasets, coverage.uncertainty.seed);
  const CoverageResult result = measure_coverage(spec, truth, coverage);
  std::string text = coverage_markdown(result, spec, coverage);
  for (const Dataset& dataset : datasets) {
    text += fmt::format("\n`{}`: {}\n", dataset.id, provenance_sentence(dataset.provenance));
  }
  if (!options.out.empty()) write_whole_file(options.out, text);
  fmt::print("{}", options.json ? coverage_json(result, spec, coverage, datasets) : text);
}

/// Grids and summaries belong to the program of the studies; who asks for them here is told so.
void point_to_studies(CLI::App& command) {
  for (const char* name : {"--grid", "--designs", "--summary", "--picture", "--keep"}) {
    command
        .add_flag_callback(name,
                           [name] {
                             throw InputError(
                                 {}, fmt::format("{} is not an option of recoil coverage", name),
                                 "it simulates the design of one fit",
                                 "see recoil_study --help for grids of designs and their summary");
                           })
        ->group("");
  }
}

}  // namespace

void add_coverage(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("coverage", "measure how often the intervals contain the truth");
  command->footer(
      "Simulates the design of the fit again and again from a known truth (the recipe's, or the\n"
      "fit's own estimate), fits each data set as you would, and counts how often the intervals\n"
      "contain the truth. Prints Markdown.\n\n"
      "  recoil coverage fits/dahneke1975-quartz.toml --datasets 100 --out coverage.md\n\n"
      "Grids of designs, tables of several fits and their summary are studies of recoil's\n"
      "authors: ./run study, or recoil_study --help.");
  const auto options = std::make_shared<Options>();
  command->add_option("FIT", options->fit_file, "a fit file")->required();
  command->add_option("--datasets", options->datasets, "simulated data sets")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000));
  command->add_option("--out", options->out, "also write the table to this file")
      ->type_name("FILE");
  point_to_studies(*command);
  add_analysis_flags(*command, options->analysis);
  add_json_flag(*command, options->json);
  command->callback([options] { run(*options); });
}

}  // namespace recoil
