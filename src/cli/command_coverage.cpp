#include <fmt/format.h>

#include <memory>
#include <optional>

#include "cli/analysis.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "core/files.hpp"
#include "report/coverage_picture.hpp"
#include "uncertainty/coverage_grid.hpp"
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
    bool grid = false;
    std::vector<std::string> designs;
    std::string keep;
    std::string picture;
    AnalysisFlags analysis;
  };
  const auto options = std::make_shared<Options>();
  command->add_option("FIT", options->fit_file, "a fit file")->required();
  command->add_option("--datasets", options->datasets, "simulated data sets")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000));
  CLI::Option* grid =
      command->add_flag("--grid", options->grid,
                        "instead of the fit's own design, many: 10, 20, 60 points, three kinds of "
                        "scatter, stated or not, f0 fixed or free, with and without captures");
  command
      ->add_option("--designs", options->designs,
                   "of the grid, only the designs whose name has all these words, e.g. n20,stated")
      ->delimiter(',')
      ->needs(grid);
  command->add_option("--keep", options->keep,
                      "a folder for the finished designs of the grid, from which a stopped study "
                      "goes on");
  command
      ->add_option("--picture", options->picture,
                   "write the coverage of the grid as a picture here (SVG)")
      ->needs(grid);
  command->add_option("--out", options->out, "write the table here, too");
  add_analysis_flags(*command, options->analysis);
  command->callback([options] {
    if (!options->out.empty()) {
      require_writable_folder(std::filesystem::absolute(options->out).parent_path());
    }
    if (!options->picture.empty()) {
      require_writable_folder(std::filesystem::absolute(options->picture).parent_path());
    }
    std::optional<std::vector<GridDesign>> designs;
    if (options->grid) designs = designs_named(options->designs);
    const FitSpec spec = load_fit(options->fit_file);
    const std::vector<Dataset> datasets = load_datasets(spec);
    const AnalysisOptions flags = options->analysis.resolved();
    CoverageOptions coverage;
    coverage.datasets = options->datasets;
    coverage.uncertainty = uncertainty_options(spec, flags);
    require_scheme(spec, coverage.uncertainty.scheme, gather(datasets));
    std::string table;
    if (designs) {
      const std::vector<GridResult> results =
          measure_grid(spec, datasets.front(), *designs, coverage, options->keep);
      table = grid_markdown(results, spec, coverage);
      if (!options->picture.empty()) {
        const Dataset& base = datasets.front();
        write_whole_file(
            options->picture,
            coverage_picture(results, spec, coverage,
                             fmt::format("{}: {}", base.id, provenance_sentence(base.provenance))));
      }
    } else {
      const CoverageTruth truth = coverage_truth(spec, datasets, coverage.uncertainty.seed);
      table = to_markdown(measure_coverage(spec, truth, coverage), spec, coverage);
    }
    for (const Dataset& dataset : datasets) {
      table += fmt::format("\n`{}`: {}\n", dataset.id, provenance_sentence(dataset.provenance));
    }
    if (!options->out.empty()) write_whole_file(options->out, table);
    fmt::print("{}", table);
  });
}

}  // namespace recoil
