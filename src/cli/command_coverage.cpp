#include <fmt/format.h>

#include <memory>
#include <optional>

#include "analysis/analysis.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/coverage_words.hpp"
#include "cli/json_coverage.hpp"
#include "cli/shard_flags.hpp"
#include "cli/write_or_print.hpp"
#include "core/claim.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/shared_work.hpp"
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
  ShardFlags shards;
};

/// Everything that is ready before the first data set is simulated.
struct Prepared {
  FitSpec spec;
  std::vector<Dataset> datasets;
  CoverageOptions coverage;
  CoverageTruth truth;
  Origin origin;  ///< of what is kept, and of the parts
};

/// Not copied: the truth may refer to its specification.
std::unique_ptr<Prepared> prepare(const Options& options) {
  auto ready = std::make_unique<Prepared>();
  ready->spec = load_fit(options.fit_file);
  ready->datasets = load_datasets(ready->spec);
  CoverageOptions& coverage = ready->coverage;
  coverage.datasets = options.datasets;
  coverage.uncertainty = uncertainty_options(ready->spec, options.analysis.resolved());
  require_scheme(ready->spec, coverage.uncertainty.scheme, gather(ready->datasets));
  ready->truth = coverage_truth(ready->spec, ready->datasets, coverage.uncertainty.seed);
  ready->origin =
      origin_of(options.shards, inputs_of(ready->spec, ready->datasets), coverage.uncertainty.seed,
                static_cast<std::size_t>(coverage.datasets), digits_of(ready->truth));
  return ready;
}

SharedWork work_of(const Prepared& ready) {
  SharedWork work;
  work.label = "coverage";
  work.pieces = ready.origin.pieces;
  work.threads = ready.coverage.uncertainty.threads;
  work.run = [&ready](std::size_t piece) {
    return json_of(run_coverage_trial(ready.spec, ready.truth, ready.coverage, piece));
  };
  return work;
}

void run_shard_of_coverage(const Options& options) {
  require_share(options.out, static_cast<std::size_t>(options.datasets), "data sets");
  const std::unique_ptr<Prepared> ready = prepare(options);
  const Shard shard = options.shards.chosen();
  if (part_is_there(options.out, ready->origin, shard)) return;
  write_part(work_of(*ready), ready->origin, shard, options.out);
  say_part(options.out, ready->origin, shard, "data sets");
}

CoverageResult merged(const Prepared& ready, const std::string& folder) {
  std::vector<CoverageTrial> trials(ready.origin.pieces);
  const std::vector<bool> there =
      read_parts(parts_of(ready.origin, folder), trials.size(),
                 [&](std::size_t i, const Json& row) { trials[i] = coverage_trial_of(row); });
  for (std::size_t i = 0; i < trials.size(); ++i) {  // what a damaged file should have held
    if (!there[i]) trials[i] = run_coverage_trial(ready.spec, ready.truth, ready.coverage, i);
  }
  return count_coverage(ready.spec, ready.truth, ready.coverage, trials);
}

/// Runs what earlier runs of the same study have not left beside its result.
CoverageResult measured(const Prepared& ready, KeptRows& kept) {
  run_pieces(work_of(ready), Shard{}, kept);
  std::vector<CoverageTrial> trials;
  for (const auto& [piece, row] : kept.rows()) trials.push_back(coverage_trial_of(row));
  return count_coverage(ready.spec, ready.truth, ready.coverage, trials);
}

void run(const Options& options) {
  std::optional<Claim> claim;
  if (!options.out.empty()) {
    require_writable_folder(std::filesystem::absolute(options.out).parent_path());
    require_other_file(options.out, {options.fit_file});
  }
  const std::unique_ptr<Prepared> ready = prepare(options);
  if (!options.out.empty()) claim.emplace(options.out);
  KeptRows kept(options.out.empty() ? "" : unfinished_beside(options.out), key_of(ready->origin));
  const CoverageResult result = options.shards.merging() ? merged(*ready, options.shards.parts)
                                : options.out.empty()
                                    ? measure_coverage(ready->spec, ready->truth, ready->coverage)
                                    : measured(*ready, kept);
  std::string text = coverage_markdown(result, ready->spec, ready->coverage);
  for (const Dataset& dataset : ready->datasets) {
    text += fmt::format("\n`{}`: {}\n", dataset.id, provenance_sentence(dataset.provenance));
  }
  const std::string printed =
      options.json ? coverage_json(result, ready->spec, ready->coverage, ready->datasets) : text;
  if (!options.out.empty()) {
    write_or_print({{options.out, text}}, printed);
    kept.forget();
  }
  fmt::print("{}", printed);
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
      "Simulates the design of the fit again and again with the fitted values as the truth, fits\n"
      "each data set as you would, and counts how often the intervals contain the truth. Prints "
      "Markdown. With --out Ctrl-C keeps what is finished, and the same\n"
      "command goes on from there.\n\n"
      "  recoil coverage fits/dahneke1975-quartz.toml --datasets 100 --out coverage.md\n\n"
      "Grids of designs, tables of several fits and their summary are studies of recoil's\n"
      "authors: ./run study, or recoil_study --help.");
  const auto options = std::make_shared<Options>();
  add_fit_file(*command, options->fit_file);
  command->add_option("--datasets", options->datasets, "simulated data sets")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000));
  command
      ->add_option("--out", options->out,
                   "also write the table to this file; with --shard, the folder of the parts")
      ->type_name("FILE");
  add_shard_flags(*command, "data sets", options->shards);
  point_to_studies(*command);
  add_analysis_flags(*command, options->analysis);
  add_json_flag(*command, options->json);
  command->callback([options] {
    if (options->shards.one_of_several()) {
      run_shard_of_coverage(*options);
    } else {
      run(*options);
    }
  });
}

}  // namespace recoil
