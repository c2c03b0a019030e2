
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
#include "uncertainty/fit_alternatives.hpp"

namespace recoil {
namespace {

void run_fit(const GivenOptions& given) {
  const ShardOfCommand shard(given);
  const std::filesystem::path folder = given.text("--out");
  const AnalysisOptions options = analysis_options(given);
  FitInputs inputs = load_inputs(given.text("FIT"));
  UncertaintyOptions assess = uncertainty_options(inputs.spec, options);
  std::optional<Claim> claim;
  if (shard.one_of_several()) {
    shard.require_share(replicates_at_most(assess));
  } else if (!folder.empty()) {
    require_writable_folder(folder);
    claim.emplace(folder / "fit.json");
  }
  Analysis analysis = analyse_fit(std::move(inputs), options);
  const Origin origin = shard.origin(analysis.spec, analysis.datasets, assess.seed,
                                     replicates_at_most(assess), digits_of(analysis.fitted));
  const bool writes = !folder.empty() && !shard.one_of_several();
  const std::shared_ptr<KeptRows> kept = shard.rows(origin, writes ? folder / "fit.json" : folder);
  if (!kept) return;
  if (shard.one_of_several()) {
    const Pieces replicates = bootstrap_pieces(
        analysis.fitted,
        capture_estimates(fit_alternatives(analysis.fitted), assess.level, analysis.datasets),
        assess);
    shard.run_share(replicates, *kept, origin);
    return;
  }
  assess.kept = kept;
  resumable(*kept, [&] {
    recoil::assess(analysis, assess);
    return true;
  });
  const std::string result = fit_json(analysis);
  const std::string printed =
      given.has("--json") ? result : fit_text(analysis, importance_of(given), output_columns());
  if (!folder.empty()) {
    std::vector<WholeFile> files = {{folder / "fit.json", result}};
    std::string draws = posterior_csv(analysis);
    if (!draws.empty()) files.push_back({folder / "posterior.csv", std::move(draws)});
    std::string points = log_likelihood_csv(analysis);
    if (!points.empty()) files.push_back({folder / "log_likelihood.csv", std::move(points)});
    write_or_print(files, printed);
    kept->forget();
  }
  print_text("{}", printed);
}

}  // namespace

void add_fit(Program& program) {
  program.command("fit", "fit all points, with intervals and the two-point comparison", R"(
Prints the report and writes DIR/fit.json. Every digit depends only on the fit file, the
data and the seed, not on the number of threads. Ctrl-C keeps the finished replicates in DIR;
the same command then continues.

  recoil fit fits/dahneke1975-quartz.toml --out results)",
                  run_fit);
}

}  // namespace recoil
