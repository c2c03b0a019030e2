#include <fmt/format.h>

#include <memory>

#include "core/error.hpp"
#include "core/files.hpp"
#include "validation/studies/commands.hpp"
#include "validation/studies/coverage_noise.hpp"
#include "validation/studies/coverage_page.hpp"
#include "validation/studies/coverage_study.hpp"
#include "validation/studies/study_pages.hpp"

namespace recoil {
namespace {

struct CoverageRun {
  std::vector<std::string> fit_files;
  int datasets = 100;
  int replicates = 39;
  std::vector<std::string> designs;
  bool exact_materials = false;
  bool posterior = false;
  StudyRun run;
};

std::vector<Dataset> load_datasets(const FitSpec& spec) {
  std::vector<Dataset> datasets;
  for (const auto& folder : spec.datasets) datasets.push_back(load_dataset(folder));
  return datasets;
}

CoverageOptions coverage_options(const CoverageRun& options, const FitSpec& spec) {
  CoverageOptions coverage;
  coverage.datasets = options.datasets;
  coverage.uncertainty.replicates = options.replicates;
  coverage.uncertainty.scheme = spec.uncertainty.scheme;
  coverage.uncertainty.level = spec.uncertainty.level;
  coverage.uncertainty.seed = spec.uncertainty.seed;
  coverage.uncertainty.threads = options.run.threads;
  // Of one interval among many: its ends need no more digits than a count of intervals sees.
  coverage.uncertainty.posterior = options.posterior;
  coverage.uncertainty.sampling.length = 250;
  coverage.uncertainty.sampling.largest_r_hat = 1.03;
  coverage.uncertainty.sampling.least_effective = 200;
  return coverage;
}

void study_grid(const CoverageRun& options) {
  std::size_t next = 0;
  std::vector<GridDesign> designs;
  for (const GridDesign& design : designs_named(options.designs)) {
    if (options.run.owns(next++)) designs.push_back(design);
  }
  const FitSpec spec = load_fit(options.fit_files.front());
  CoverageStudy study = measure_grid(spec, load_datasets(spec).front(), designs,
                                     coverage_options(options, spec), options.run.keep);
  if (wrote_part(options.run)) return;
  study.stamp = options.run.stamp();
  publish(options.run, study_json(study), coverage_page(study, study.stamp.study));
}

/// All files are read before the first design is measured.
void study_designs(const CoverageRun& options) {
  std::vector<FitSpec> specs;
  std::vector<std::vector<Dataset>> datasets;
  for (const std::string& file : options.fit_files) {
    specs.push_back(load_fit(file));
    if (options.exact_materials) specs.back().uncertainty.materials = Materials::exact;
    datasets.push_back(load_datasets(specs.back()));
  }
  CoverageStudy study;
  for (std::size_t k = 0; k < specs.size(); ++k) {
    if (!options.run.owns(k)) continue;
    add_design(study, specs[k], datasets[k], coverage_options(options, specs[k]), options.run.keep);
  }
  if (wrote_part(options.run)) return;
  study.stamp = options.run.stamp();
  publish(options.run, study_json(study), coverage_page(study, ""));
}

void study_noise_designs(const CoverageRun& options) {
  CoverageStudy study =
      study_noise(options.designs, coverage_options(options, FitSpec{}), options.run.keep);
  study.stamp = options.run.stamp();
  publish(options.run, study_json(study), coverage_page(study, ""));
}

CLI::App* add_command(CLI::App& program, const char* name, const char* what,
                      const std::shared_ptr<CoverageRun>& options) {
  CLI::App* command = program.add_subcommand(name, what);
  command->add_option("--datasets", options->datasets, "simulated data sets per design")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000));
  command->add_option("--replicates", options->replicates, "bootstrap replicates of each")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000000));
  command->add_flag("--posterior", options->posterior, "sample the posterior of each, too");
  add_run_options(*command, options->run);
  add_shard_option(*command, options->run);
  return command;
}

}  // namespace

void add_coverage_grid(CLI::App& program, const std::string& words) {
  const auto options = std::make_shared<CoverageRun>();
  options->run.command = words;
  CLI::App* command = add_command(
      program, "coverage-grid",
      "how often the intervals contain the truth: 10, 20, 60 points, three kinds of scatter, "
      "stated or not, f0 fixed or free, with and without captures",
      options);
  command->add_option("FIT", options->fit_files, "whose system and estimate are the truth")
      ->required()
      ->expected(1);
  command
      ->add_option("--designs", options->designs,
                   "only the designs whose name has all these words, e.g. n20,stated")
      ->delimiter(',');
  command->callback([options] { study_grid(*options); });
}

void add_coverage_designs(CLI::App& program, const std::string& words) {
  const auto options = std::make_shared<CoverageRun>();
  options->run.command = words;
  CLI::App* command =
      add_command(program, "coverage-designs",
                  "the same for the designs of several fits, as one table", options);
  command->add_option("FIT", options->fit_files, "fit files")->required();
  command->add_flag("--exact-materials", options->exact_materials,
                    "take the constants of the materials as exact, as materials = false does");
  command->callback([options] { study_designs(*options); });
}

void add_coverage_noise(CLI::App& program, const std::string& words) {
  const auto options = std::make_shared<CoverageRun>();
  options->run.command = words;
  CLI::App* command = add_command(program, "coverage-noise",
                                  "the same for noise that is hard to know: shared, of single "
                                  "impacts, stated from few events, of two targets",
                                  options);
  command
      ->add_option("--designs", options->designs, "only the designs whose name has all these words")
      ->delimiter(',');
  command->callback([options] { study_noise_designs(*options); });
}

void add_coverage_summary(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "coverage-summary", "one page and one picture of all studies of coverage in a folder");
  const auto folder = std::make_shared<std::string>("reports");
  command->add_option("DIR", *folder, "with coverage-*.json")->capture_default_str();
  command->callback([folder] { write_coverage_summary(*folder); });
}

}  // namespace recoil
