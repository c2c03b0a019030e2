
#include <memory>
#include <optional>

#include "analysis/analysis.hpp"
#include "cli/commands.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "report/fit_report.hpp"
#include "report/result_json.hpp"
#include "uncertainty/bootstrap.hpp"
#include "uncertainty/capture_interval.hpp"
#include "uncertainty/noise_alternatives.hpp"

namespace recoil {
namespace {

struct FitFlags : CommonFlags {
  ShardFlags shards;
};

void run_fit(const FitFlags& flags) {
  const std::filesystem::path folder = flags.out;
  const AnalysisOptions options = flags.analysis.resolved();
  FitInputs inputs = load_inputs(flags.fit_file);
  UncertaintyOptions assess = uncertainty_options(inputs.spec, options);
  std::optional<Claim> claim;
  if (flags.shards.one_of_several()) {
    flags.shards.require_share(flags.out, replicates_at_most(assess));
  } else if (!flags.out.empty()) {
    require_writable_folder(folder);
    claim.emplace(folder / "fit.json");
  }
  Analysis analysis = analyse_fit(std::move(inputs), options);
  const Origin origin = flags.shards.origin(analysis.spec, analysis.datasets, assess.seed,
                                            replicates_at_most(assess), digits_of(analysis.fitted));
  const bool writes = !flags.out.empty() && !flags.shards.one_of_several();
  const std::shared_ptr<KeptRows> kept =
      flags.shards.rows(origin, writes ? folder / "fit.json" : folder);
  if (!kept) return;
  if (flags.shards.one_of_several()) {
    const Pieces replicates = bootstrap_pieces(
        analysis.fitted,
        capture_estimates(noise_alternatives(analysis.fitted), assess.level, analysis.datasets),
        assess);
    flags.shards.run_share(replicates, *kept, origin, folder);
    return;
  }
  assess.kept = kept;
  resumable(*kept, [&] {
    recoil::assess(analysis, assess);
    return true;
  });
  const std::string result = fit_json(analysis);
  const std::string printed =
      flags.json ? result : fit_text(analysis, importance_of(flags.verbose), output_columns());
  if (!flags.out.empty()) {
    std::vector<WholeFile> files = {{folder / "fit.json", result}};
    std::string draws = posterior_csv(analysis);
    if (!draws.empty()) files.push_back({folder / "posterior.csv", std::move(draws)});
    write_or_print(files, printed);
    kept->forget();
  }
  print_text("{}", printed);
}

}  // namespace

void add_fit(Program& program) {
  const Command command =
      program.command("fit", "fit all points, with intervals and the two-point comparison", R"(
Prints the report and writes DIR/fit.json. Every digit depends only on the fit file, the
data and the seed, not on the number of threads. Ctrl-C keeps the finished replicates in DIR;
the same command then continues.

  recoil fit fits/dahneke1975-quartz.toml --out results)");
  const auto flags = std::make_shared<FitFlags>();
  add_fit_file(command, flags->fit_file);
  command.option("--out", flags->out, "folder for fit.json (default: nothing is written)")
      .takes("DIR");
  add_shard_flags(command, "bootstrap's replicates", flags->shards);
  add_analysis_flags(command, flags->analysis);
  add_json_flag(command, flags->json);
  add_verbose_flag(command, flags->verbose);
  command.runs([flags] { run_fit(*flags); });
}

}  // namespace recoil
