
#include <memory>
#include <optional>

#include "analysis/analysis.hpp"
#include "cli/commands.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "diagnosis/diagnose.hpp"
#include "diagnosis/diagnosis_result.hpp"
#include "diagnosis/rates.hpp"
#include "report/diagnosis_report.hpp"
#include "report/result_json.hpp"

namespace recoil {
namespace {

struct DiagnoseFlags : CommonFlags {
  int rates = 0;
  ShardFlags shards;

  DiagnosisOptions options(const FitSpec& spec) const {
    DiagnosisOptions chosen;
    chosen.threads = analysis.threads;
    chosen.seed = stated_seed(analysis.seed).value_or(spec.uncertainty.seed);
    return chosen;
  }
};

/// Identifies the rows of the calibration.
Origin origin_of_calibration(const DiagnoseFlags& flags, const FitInputs& inputs,
                             const Calibration& calibration) {
  return flags.shards.origin(inputs.spec, inputs.datasets, flags.options(inputs.spec).seed,
                             calibration.pieces(), calibration.digits());
}

/// Measures the error rates of the diagnosis for the design and sets `diagnosis.own_design`. A
/// shard only runs its pieces.
/// @returns the rows to keep until the result is written; null for a shard
std::shared_ptr<KeptRows> measure_rates(const DiagnoseFlags& flags, const FitInputs& inputs,
                                        Diagnosis& diagnosis) {
  const DesignRates rates(diagnosis, flags.rates);
  const Origin origin = flags.shards.origin(inputs.spec, inputs.datasets, diagnosis.options.seed,
                                            rates.pieces(), rates.digits());
  const Pieces pieces = {"what these points could show", rates.pieces(), flags.analysis.threads,
                         [&](std::size_t piece) { return row_json(rates.run(piece)); }};
  const std::filesystem::path folder = flags.out;
  if (flags.shards.one_of_several()) {
    const std::shared_ptr<KeptRows> kept = flags.shards.rows(origin, folder);
    if (kept) flags.shards.run_share(pieces, *kept, origin, folder);
    return nullptr;
  }
  const std::shared_ptr<KeptRows> kept =
      flags.shards.rows(origin, flags.out.empty() ? "" : folder / "rates.json");
  resumable(pieces, *kept);
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < pieces.count; ++i) rows.push_back(row_numbers(*kept->find(i)));
  diagnosis.own_design = rates.count(rows);
  return kept;
}

void run_shard_of_calibration(const DiagnoseFlags& flags) {
  flags.shards.require_share(flags.out, 1);
  const FitInputs inputs = load_inputs(flags.fit_file);
  if (flags.rates > 0) {
    Diagnosis diagnosis = diagnose(inputs.spec, inputs.datasets, flags.options(inputs.spec));
    measure_rates(flags, inputs, diagnosis);
    return;
  }
  const Calibration calibration(inputs.spec, inputs.datasets, flags.options(inputs.spec));
  const Origin origin = origin_of_calibration(flags, inputs, calibration);
  const std::shared_ptr<KeptRows> kept = flags.shards.rows(origin, flags.out);
  if (!kept) return;
  const Pieces pieces = {"diagnosis", calibration.pieces(), flags.analysis.threads,
                         [&](std::size_t piece) { return row_json(calibration.run(piece)); }};
  flags.shards.run_share(pieces, *kept, origin, flags.out);
}

std::filesystem::path result_in(const std::filesystem::path& folder) {
  return folder / "diagnosis.json";
}

/// The finished rows of an earlier run of the diagnosis. For a merge these are the rows of the
/// calibration; there are none if the parts belong to the rates.
std::shared_ptr<KeptRows> rows_for(const DiagnoseFlags& flags, const FitInputs& inputs) {
  if (flags.out.empty() || (flags.shards.merging() && flags.rates > 0)) {
    return std::make_shared<KeptRows>();
  }
  if (flags.shards.merging()) {
    const Calibration calibration(inputs.spec, inputs.datasets, flags.options(inputs.spec));
    return flags.shards.rows(origin_of_calibration(flags, inputs, calibration), "");
  }
  const Origin origin =
      flags.shards.origin(inputs.spec, inputs.datasets, flags.options(inputs.spec).seed, 0, "");
  return flags.shards.rows(origin, result_in(flags.out));
}

void run_diagnosis(const DiagnoseFlags& flags) {
  const std::filesystem::path folder = flags.out;
  if (!flags.out.empty()) require_writable_folder(folder);
  const FitInputs inputs = load_inputs(flags.fit_file);
  std::optional<Claim> claim;
  if (!flags.out.empty()) {
    require_free({folder / "extended.toml"});
    claim.emplace(result_in(folder));
  }
  DiagnosisOptions options = flags.options(inputs.spec);
  options.kept = rows_for(flags, inputs);
  Diagnosis diagnosis =
      resumable(*options.kept, [&] { return diagnose(inputs.spec, inputs.datasets, options); });
  std::shared_ptr<KeptRows> kept_rates;
  if (flags.rates > 0) kept_rates = measure_rates(flags, inputs, diagnosis);
  diagnosis.remarks = reconstruction_remarks(diagnosis.datasets);
  const std::string result = diagnosis_json(diagnosis);
  const std::string printed =
      flags.json ? result
                 : diagnosis_text(diagnosis, importance_of(flags.verbose), output_columns());
  if (!flags.out.empty()) {
    write_or_print({{folder / "extended.toml", extended_toml(diagnosis, folder)},
                    {folder / "diagnosis.html", diagnosis_html(diagnosis)},
                    {result_in(folder), result}},
                   printed);
    options.kept->forget();
    if (kept_rates) kept_rates->forget();
  }
  print_text("{}", printed);
}

}  // namespace

void add_diagnose(Program& program) {
  const Command command = program.command(
      "diagnose", "find what the model gets wrong and why, and what an extended model gains", R"(
Tests the residuals of the fit for structure and tries every mechanism of the catalogue, alone
and in pairs. The verdict is one of
  adequate        the residuals show no structure
  cause_named     exactly one cause of the catalogue explains the misfit
  not_separable   several causes explain it; recoil lists them and proposes an experiment
  unexplained     no cause of the catalogue explains it, or the errors are larger than stated
With --out it writes diagnosis.json, diagnosis.html (a page to read) and extended.toml (a fit
file of the extended model). Ctrl-C keeps finished work in DIR; the same command then
continues.

  recoil diagnose fits/wall1990-molybdenum.toml --out diagnosis
  recoil fit diagnosis/extended.toml)");
  const auto flags = std::make_shared<DiagnoseFlags>();
  add_fit_file(command, flags->fit_file);
  command.option("--out", flags->out, "folder for the results (default: nothing is written)")
      .takes("DIR");
  add_threads(command, flags->analysis.threads);
  add_seed(command, flags->analysis.seed, "the simulated data sets");
  command
      .option("--rates", flags->rates,
              "also measure the error rates of the diagnosis for this design: simulate and "
              "diagnose this many data sets for each cause that is named or listed, at full and at "
              "half strength, and for no cause")
      .within(1, 1000000);
  add_shard_flags(command, "data sets", flags->shards);
  add_json_flag(command, flags->json);
  add_verbose_flag(command, flags->verbose);
  command.runs([flags] {
    if (flags->shards.one_of_several()) {
      run_shard_of_calibration(*flags);
    } else {
      run_diagnosis(*flags);
    }
  });
}

}  // namespace recoil
