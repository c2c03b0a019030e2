#include <fmt/format.h>

#include <memory>
#include <optional>

#include "analysis/analysis.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/shard_flags.hpp"
#include "cli/write_or_print.hpp"
#include "core/claim.hpp"
#include "core/files.hpp"
#include "core/shared_work.hpp"
#include "report/fit_sections.hpp"
#include "report/posterior_report.hpp"
#include "report/result_json.hpp"
#include "uncertainty/bootstrap.hpp"
#include "uncertainty/capture_interval.hpp"
#include "uncertainty/noise_alternatives.hpp"

namespace recoil {
namespace {

struct FitFlags {
  std::string fit_file;
  std::string out;
  bool json = false;
  bool verbose = false;
  AnalysisFlags analysis;
  ShardFlags shards;
};

Origin origin_of_replicates(const ShardFlags& shards, const Analysis& analysis,
                            const UncertaintyOptions& assess) {
  return origin_of(shards, inputs_of(analysis.spec, analysis.datasets), assess.seed,
                   replicates_at_most(assess), key_of_bootstrap(analysis.fitted, assess));
}

void run_shard_of_fit(const FitFlags& flags) {
  AnalysisOptions resolved = flags.analysis.resolved();
  resolved.folder = flags.out;
  FitInputs inputs = load_inputs(flags.fit_file);
  UncertaintyOptions assess = uncertainty_options(inputs.spec, resolved);
  require_share(flags.out, replicates_at_most(assess), "replicates");
  const Analysis analysis = analyse_fit(std::move(inputs), resolved);
  const Origin origin = origin_of_replicates(flags.shards, analysis, assess);
  const Shard shard = flags.shards.chosen();
  if (part_is_there(flags.out, origin, shard)) return;
  assess.shard = shard;
  assess.keep = unfinished_path(flags.out, origin, shard);
  const ReplicateTable table = shard_of_bootstrap(
      analysis.fitted,
      capture_estimates(noise_alternatives(analysis.fitted), assess.level, analysis.datasets),
      assess);
  save_replicates(part_path(flags.out, origin, shard), key_of_bootstrap(analysis.fitted, assess),
                  table, part_head(origin, shard));
  std::error_code ignored;
  std::filesystem::remove(assess.keep, ignored);
  say_part(flags.out, origin, shard, "replicates");
}

void run_fit(const FitFlags& flags) {
  if (!flags.out.empty()) require_writable_folder(flags.out);
  AnalysisOptions resolved = flags.analysis.resolved();
  resolved.folder = flags.out;
  FitInputs inputs = load_inputs(flags.fit_file);
  const std::filesystem::path folder = flags.out;
  std::optional<Claim> claim;
  if (!flags.out.empty()) claim.emplace(folder / "fit.json");
  Analysis analysis = analyse_fit(std::move(inputs), resolved);
  UncertaintyOptions assess = uncertainty_options(analysis.spec, resolved);
  if (flags.shards.merging()) {
    assess.parts =
        parts_of(origin_of_replicates(flags.shards, analysis, assess), flags.shards.parts);
  }
  analysis.uncertainty = assess_uncertainty(analysis.fitted, analysis.datasets, assess);
  const std::string result = fit_json(analysis);
  const std::string printed =
      flags.json ? result : fit_text(analysis, importance_of(flags.verbose));
  if (!flags.out.empty()) {
    std::vector<WholeFile> files = {{folder / "fit.json", result}};
    std::string draws = posterior_csv(analysis);
    if (!draws.empty()) files.push_back({folder / "posterior.csv", std::move(draws)});
    write_or_print(files, printed);
    forget_replicates(folder);
  }
  fmt::print("{}", printed);
}

}  // namespace

void add_fit(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("fit", "fit all points, with intervals and the two-point comparison");
  command->footer(
      "Prints the report and writes DIR/fit.json. Every digit depends only on the fit file, the\n"
      "data and the seed, not on the number of threads. Ctrl-C keeps finished replicates in DIR,\n"
      "and the same command goes on from there.\n\n"
      "  recoil fit fits/dahneke1975-quartz.toml --out results");
  const auto flags = std::make_shared<FitFlags>();
  add_fit_file(*command, flags->fit_file);
  command->add_option("--out", flags->out, "folder for fit.json (default: nothing is written)")
      ->type_name("DIR");
  add_shard_flags(*command, "bootstrap's replicates", flags->shards);
  add_analysis_flags(*command, flags->analysis);
  add_json_flag(*command, flags->json);
  add_verbose_flag(*command, flags->verbose);
  command->callback([flags] {
    if (flags->shards.one_of_several()) {
      run_shard_of_fit(*flags);
    } else {
      run_fit(*flags);
    }
  });
}

}  // namespace recoil
