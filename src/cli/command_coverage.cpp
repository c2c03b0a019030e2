#include <fmt/format.h>

#include <memory>
#include <optional>

#include "cli/analysis.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "plot/draw.hpp"
#include "report/coverage_picture.hpp"
#include "report/coverage_summary.hpp"
#include "uncertainty/coverage_grid.hpp"
#include "uncertainty/coverage_truth.hpp"

namespace recoil {

namespace {

struct Options {
  std::vector<std::string> fit_files;
  std::string out;
  int datasets = 100;
  bool grid = false;
  std::vector<std::string> designs;
  std::string keep;
  std::string picture;
  std::string summary;
  AnalysisFlags analysis;
};

CoverageOptions coverage_options(const Options& options, const FitSpec& spec,
                                 const std::vector<Dataset>& datasets) {
  CoverageOptions coverage;
  coverage.datasets = options.datasets;
  coverage.uncertainty = uncertainty_options(spec, options.analysis.resolved());
  require_scheme(spec, coverage.uncertainty.scheme, gather(datasets));
  return coverage;
}

std::string provenance_lines(const std::vector<Dataset>& datasets) {
  std::string lines;
  for (const Dataset& dataset : datasets) {
    lines += fmt::format("\n`{}`: {}\n", dataset.id, provenance_sentence(dataset.provenance));
  }
  return lines;
}

std::string one_fit(const Options& options) {
  std::optional<std::vector<GridDesign>> designs;
  if (options.grid) designs = designs_named(options.designs);
  const FitSpec spec = load_fit(options.fit_files.front());
  const std::vector<Dataset> datasets = load_datasets(spec);
  const CoverageOptions coverage = coverage_options(options, spec, datasets);
  std::string table;
  if (designs) {
    const Dataset& base = datasets.front();
    const std::vector<GridResult> results =
        measure_grid(spec, base, *designs, coverage, options.keep);
    table = grid_markdown(results, spec, coverage);
    if (!options.picture.empty()) {
      write_whole_file(options.picture,
                       plot::draw_svg(coverage_picture(
                           results, spec, coverage,
                           fmt::format("{}: {}", base.id, provenance_sentence(base.provenance)))) +
                           "\n");
    }
  } else {
    const CoverageTruth truth = coverage_truth(spec, datasets, coverage.uncertainty.seed);
    table = to_markdown(measure_coverage(spec, truth, coverage), spec, coverage);
  }
  return table + provenance_lines(datasets);
}

/// The designs of several fits as one table; all files are read before the first is measured.
std::string several_fits(const Options& options) {
  std::vector<FitSpec> specs;
  std::vector<std::vector<Dataset>> datasets;
  std::vector<CoverageOptions> coverages;
  for (const std::string& file : options.fit_files) {
    specs.push_back(load_fit(file));
    datasets.push_back(load_datasets(specs.back()));
    coverages.push_back(coverage_options(options, specs.back(), datasets.back()));
  }
  std::vector<DesignResult> results;
  std::string provenance;
  for (std::size_t k = 0; k < specs.size(); ++k) {
    results.push_back(measure_design(specs[k], datasets[k], coverages[k], options.keep));
    provenance += provenance_lines(datasets[k]);
  }
  return designs_markdown(results, coverages.front()) + provenance;
}

std::string summary(const Options& options) {
  const std::vector<CoverageTable> tables = read_coverage_tables(options.summary);
  std::string link;
  if (!options.picture.empty()) {
    const double level = tables.front().level;
    const std::vector<GridResult> grid = grid_of_tables(tables);
    if (!grid.empty()) {
      write_whole_file(
          options.picture,
          plot::draw_svg(coverage_picture(
              grid, level,
              fmt::format("Coverage of the recommended {:g} % intervals by kind of data",
                          100.0 * level),
              "read from the tables in " + options.summary)) +
              "\n");
      link = std::filesystem::path(options.picture).filename().string();
    }
  }
  return coverage_summary(tables, link);
}

void run(const Options& options) {
  for (const std::string& file : {options.out, options.picture}) {
    if (!file.empty()) require_writable_folder(std::filesystem::absolute(file).parent_path());
  }
  if (options.fit_files.empty() == options.summary.empty()) {
    throw InputError(
        {},
        "coverage: " +
            std::string(options.summary.empty() ? "no fit file" : "fit files beside --summary"),
        "it simulates the designs of fits, or sums up tables that stand in a folder",
        "write: recoil coverage FIT, or: recoil coverage --summary reports");
  }
  if (options.grid && options.fit_files.size() > 1) {
    throw InputError({}, "coverage: --grid with several fits",
                     "a grid has the system and the estimate of one fit", "name one");
  }
  if (!options.picture.empty() && !options.grid && options.summary.empty()) {
    throw InputError({}, "coverage: --picture", "it shows a grid or a summary",
                     "add --grid, or leave it out");
  }
  const std::string text = !options.summary.empty()        ? summary(options)
                           : options.fit_files.size() == 1 ? one_fit(options)
                                                           : several_fits(options);
  if (!options.out.empty()) write_whole_file(options.out, text);
  fmt::print("{}", text);
}

}  // namespace

void add_coverage(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("coverage", "how often the intervals hold the truth, measured");
  command->footer(
      "Simulates the design of the fit again and again from a known truth (the recipe's, or the\n"
      "fit's own estimate), fits each data set as you would, and counts. Prints Markdown.\n\n"
      "  recoil coverage fits/dahneke1975-quartz.toml --datasets 100 --out coverage.md\n"
      "  recoil coverage fits/wall1990-*.toml --datasets 100 --replicates 39   # one table\n"
      "  recoil coverage --summary reports           # one page of the tables that stand there");
  const auto options = std::make_shared<Options>();
  command->add_option("FIT", options->fit_files, "fit files; several make one table");
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
                      "a folder for the finished designs of a grid or of several fits, from which "
                      "a stopped study goes on");
  command->add_option("--summary", options->summary,
                      "sum up the tables coverage-*.md of this folder instead of simulating");
  command->add_option("--picture", options->picture,
                      "write the coverage of the grid as a picture here (SVG)");
  command->add_option("--out", options->out, "write the table here, too");
  add_analysis_flags(*command, options->analysis);
  command->callback([options] { run(*options); });
}

}  // namespace recoil
