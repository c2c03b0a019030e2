#include <fmt/format.h>

#include <memory>
#include <optional>

#include "analysis/analysis.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/coverage_words.hpp"
#include "cli/json_coverage.hpp"
#include "cli/shard_flags.hpp"
#include "core/claim.hpp"
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
      options.shards.origin(ready->spec, ready->datasets, coverage.uncertainty.seed,
                            static_cast<std::size_t>(coverage.datasets), digits_of(ready->truth));
  return ready;
}

Pieces pieces_of(const Prepared& ready) {
  return {"coverage", ready.origin.pieces, ready.coverage.uncertainty.threads,
          [&ready](std::size_t i) {
            return json_of(run_coverage_trial(ready.spec, ready.truth, ready.coverage, i));
          }};
}

void run(const Options& options) {
  const bool shard = options.shards.one_of_several();
  if (shard) {
    options.shards.require_share(options.out, static_cast<std::size_t>(options.datasets));
  } else if (!options.out.empty()) {
    require_writable_folder(std::filesystem::absolute(options.out).parent_path());
    require_other_file(options.out, {options.fit_file});
  }
  const std::unique_ptr<Prepared> ready = prepare(options);
  std::optional<Claim> claim;
  if (!shard && !options.out.empty()) claim.emplace(options.out);
  const std::shared_ptr<KeptRows> kept = options.shards.rows(ready->origin, options.out);
  if (!kept) return;
  const Pieces pieces = pieces_of(*ready);
  if (shard) {
    options.shards.run_share(pieces, *kept, ready->origin, options.out);
    return;
  }
  resumable(pieces, *kept);
  std::vector<CoverageTrial> trials;
  for (std::size_t i = 0; i < pieces.count; ++i)
    trials.push_back(coverage_trial_of(kept->find(i).value()));
  const CoverageResult result = count_coverage(ready->spec, ready->truth, ready->coverage, trials);
  std::string text = coverage_markdown(result, ready->spec, ready->coverage);
  for (const Dataset& dataset : ready->datasets) {
    text += fmt::format("\n`{}`: {}\n", dataset.id, provenance_sentence(dataset.provenance));
  }
  const std::string printed =
      options.json ? coverage_json(result, ready->spec, ready->coverage, ready->datasets) : text;
  if (!options.out.empty()) {
    write_or_print({{options.out, text}}, printed);
    kept->forget();
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
  command->callback([options] { run(*options); });
}

}  // namespace recoil
