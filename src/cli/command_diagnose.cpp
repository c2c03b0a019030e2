
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

DiagnosisOptions diagnosis_options(const GivenOptions& given, const FitSpec& spec) {
  DiagnosisOptions options;
  options.threads = static_cast<int>(given.whole("--threads"));
  options.seed = seed_of(given, spec);
  return options;
}

/// Identifies the rows of the calibration.
/// Are all spheres balls, for which e is the answer and pairs of causes are not sought unasked?
bool only_balls(const std::vector<Dataset>& datasets) {
  constexpr double smallest = 1e-3;  // [m]
  return std::ranges::all_of(datasets, [](const Dataset& dataset) {
    return dataset.system.adhesion_energy.value_or(1.0) == 0.0 &&
           std::ranges::all_of(dataset.points,
                               [](const ImpactPoint& point) { return point.diameter >= smallest; });
  });
}

Origin origin_of_calibration(const GivenOptions& given, const FitInputs& inputs,
                             const Calibration& calibration) {
  const ShardOfCommand shard(given);
  return shard.origin(inputs.spec, inputs.datasets, diagnosis_options(given, inputs.spec).seed,
                      calibration.pieces(), calibration.digits());
}

/// Measures the error rates of the diagnosis for the design and sets `diagnosis.own_design`. A
/// shard only runs its pieces.
/// @returns the rows to keep until the result is written; null for a shard
std::shared_ptr<KeptRows> measure_rates(const GivenOptions& given, const FitInputs& inputs,
                                        Diagnosis& diagnosis) {
  const ShardOfCommand shard(given);
  const DesignRates rates(diagnosis, static_cast<int>(given.whole("--rates")));
  const Origin origin = shard.origin(inputs.spec, inputs.datasets, diagnosis.options.seed,
                                     rates.pieces(), rates.digits());
  const Pieces pieces = {"what these points could show", rates.pieces(), diagnosis.options.threads,
                         [&](std::size_t piece) { return row_json(rates.run(piece)); }};
  const std::filesystem::path folder = given.text("--out");
  if (shard.one_of_several()) {
    const std::shared_ptr<KeptRows> kept = shard.rows(origin, folder);
    if (kept) shard.run_share(pieces, *kept, origin);
    return nullptr;
  }
  const std::shared_ptr<KeptRows> kept =
      shard.rows(origin, folder.empty() ? "" : folder / "rates.json");
  resumable(pieces, *kept);
  diagnosis.own_design = counted_rows(*kept, [&] {
    std::vector<std::vector<double>> rows;
    for (std::size_t i = 0; i < pieces.count; ++i) {
      rows.push_back(row_numbers(kept->find(i).value_or(Json())));
    }
    return rates.count(rows);
  });
  return kept;
}

void run_shard_of_calibration(const GivenOptions& given) {
  const ShardOfCommand shard(given);
  shard.require_share(1);
  const FitInputs inputs = load_inputs(given.text("FIT"));
  if (given.has("--rates")) {
    Diagnosis diagnosis =
        diagnose(inputs.spec, inputs.datasets, diagnosis_options(given, inputs.spec));
    measure_rates(given, inputs, diagnosis);
    return;
  }
  const Calibration calibration(inputs.spec, inputs.datasets,
                                diagnosis_options(given, inputs.spec));
  const Origin origin = origin_of_calibration(given, inputs, calibration);
  const std::shared_ptr<KeptRows> kept = shard.rows(origin, given.text("--out"));
  if (!kept) return;
  const Pieces pieces = {"diagnosis", calibration.pieces(),
                         static_cast<int>(given.whole("--threads")),
                         [&](std::size_t piece) { return row_json(calibration.run(piece)); }};
  shard.run_share(pieces, *kept, origin);
}

std::filesystem::path result_in(const std::filesystem::path& folder) {
  return folder / "diagnosis.json";
}

/// The finished rows of an earlier run of the diagnosis. For a merge these are the rows of the
/// calibration; there are none if the parts belong to the rates.
std::shared_ptr<KeptRows> rows_for(const GivenOptions& given, const FitInputs& inputs) {
  const ShardOfCommand shard(given);
  const std::filesystem::path folder = given.text("--out");
  if (folder.empty() || (shard.merging() && given.has("--rates"))) {
    return std::make_shared<KeptRows>();
  }
  if (shard.merging()) {
    const Calibration calibration(inputs.spec, inputs.datasets,
                                  diagnosis_options(given, inputs.spec));
    return shard.rows(origin_of_calibration(given, inputs, calibration), "");
  }
  const Origin origin =
      shard.origin(inputs.spec, inputs.datasets, diagnosis_options(given, inputs.spec).seed, 0, "");
  return shard.rows(origin, result_in(folder));
}

void run_diagnosis(const GivenOptions& given) {
  const std::filesystem::path folder = given.text("--out");
  if (!folder.empty()) require_writable_folder(folder);
  const FitInputs inputs = load_inputs(given.text("FIT"));
  std::optional<Claim> claim;
  if (!folder.empty()) {
    require_free({folder / "extended.toml"});
    claim.emplace(result_in(folder));
  }
  DiagnosisOptions options = diagnosis_options(given, inputs.spec);
  options.single_causes = only_balls(inputs.datasets) && !given.has("--causes");
  options.kept = rows_for(given, inputs);
  Diagnosis diagnosis =
      resumable(*options.kept, [&] { return diagnose(inputs.spec, inputs.datasets, options); });
  std::shared_ptr<KeptRows> kept_rates;
  if (given.has("--rates")) kept_rates = measure_rates(given, inputs, diagnosis);
  diagnosis.remarks = reconstruction_remarks(diagnosis.datasets);
  const std::string result = diagnosis_json(diagnosis);
  const std::string printed =
      given.has("--json") ? result
                          : diagnosis_text(diagnosis, importance_of(given), output_columns());
  if (!folder.empty()) {
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
  program.command("diagnose",
                  "find what the model gets wrong and why, and what an extended model gains", R"(
Tests the residuals of the fit for structure and tries every mechanism of the catalogue, alone
and in pairs. The verdict is one of
  adequate        the residuals show no structure
  cause_named     exactly one cause of the catalogue explains the misfit
  not_separable   several causes explain it; recoil lists them and proposes an experiment
  unexplained     no cause of the catalogue explains it, or errors are larger or not stated
With --out it writes diagnosis.json, diagnosis.html (a page to read) and extended.toml (a fit
file of the extended model). Ctrl-C keeps finished work in DIR; the same command then
continues.

  recoil diagnose fits/wall1990-molybdenum.toml --out diagnosis
  recoil fit diagnosis/extended.toml)",
                  [](const GivenOptions& given) {
                    if (given.has("--shard")) {
                      run_shard_of_calibration(given);
                    } else {
                      run_diagnosis(given);
                    }
                  });
}

}  // namespace recoil
