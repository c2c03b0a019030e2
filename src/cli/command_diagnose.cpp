#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "cli/analysis.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/recipe_words.hpp"
#include "cli/shard_flags.hpp"
#include "core/files.hpp"
#include "core/shared_work.hpp"
#include "diagnosis/calibration.hpp"
#include "diagnosis/diagnose.hpp"
#include "diagnosis/diagnosis_result.hpp"
#include "diagnosis/extended_toml.hpp"
#include "report/diagnosis_document.hpp"
#include "report/json_diagnosis.hpp"

namespace recoil {
namespace {

struct DiagnoseFlags {
  std::string fit;
  std::string out;
  int threads = 0;
  std::int64_t seed = -1;
  bool json = false;
  ShardFlags shards;

  DiagnosisOptions options(const FitSpec& spec) const {
    DiagnosisOptions chosen;
    chosen.threads = threads;
    chosen.seed = seed >= 0 ? static_cast<std::uint64_t>(seed) : spec.uncertainty.seed;
    return chosen;
  }
};

Origin origin_of_calibration(const DiagnoseFlags& flags, const FitInputs& inputs,
                             const Calibration& calibration) {
  return origin_of(flags.shards, inputs_of(inputs.spec, inputs.datasets),
                   flags.options(inputs.spec).seed, calibration.pieces(), calibration.digits());
}

/// JSON has no number for an infinite gain.
Json row_json(const std::vector<double>& row) {
  Json json = Json::array();
  for (const double value : row) {
    json.push_back(std::isfinite(value) ? Json(value) : Json(fmt::format("{}", value)));
  }
  return json;
}

std::vector<double> row_of(const Json& json) {
  std::vector<double> row;
  for (const Json& value : json) {
    row.push_back(value.is_number() ? value.get<double>() : std::stod(value.get<std::string>()));
  }
  return row;
}

void run_shard_of_calibration(const DiagnoseFlags& flags) {
  require_share(flags.out, 1, "data sets");
  const FitInputs inputs = load_inputs(flags.fit);
  const Calibration calibration(inputs.spec, inputs.datasets, flags.options(inputs.spec));
  const Origin origin = origin_of_calibration(flags, inputs, calibration);
  const Shard shard = flags.shards.chosen();
  if (part_is_there(flags.out, origin, shard)) return;
  const SharedWork work = {"diagnosis", calibration.pieces(), flags.threads,
                           [&](std::size_t piece) { return row_json(calibration.run(piece)); }};
  write_part(work, origin, shard, flags.out);
  say_part(flags.out, origin, shard, "data sets of the calibration");
}

std::shared_ptr<const std::vector<std::vector<double>>> merged_calibration(
    const DiagnoseFlags& flags, const FitInputs& inputs) {
  const Calibration calibration(inputs.spec, inputs.datasets, flags.options(inputs.spec));
  const Origin origin = origin_of_calibration(flags, inputs, calibration);
  auto rows = std::make_shared<std::vector<std::vector<double>>>(origin.pieces);
  read_parts(parts_of(origin, flags.shards.parts), rows->size(),
             [&](std::size_t piece, const Json& row) { (*rows)[piece] = row_of(row); });
  return rows;
}

void run_diagnosis(const DiagnoseFlags& flags) {
  if (!flags.out.empty()) require_writable_folder(flags.out);
  const FitInputs inputs = load_inputs(flags.fit);
  DiagnosisOptions options = flags.options(inputs.spec);
  if (flags.shards.merging()) options.calibration = merged_calibration(flags, inputs);
  Diagnosis diagnosis = diagnose(inputs.spec, inputs.datasets, options);
  diagnosis.remarks = recipe_remarks(diagnosis.datasets);
  const std::string result = diagnosis_json(diagnosis);
  if (!flags.out.empty()) {
    const std::filesystem::path folder = flags.out;
    write_whole_file(folder / "extended.toml", extended_toml(diagnosis, folder));
    write_whole_file(folder / "diagnosis.html", diagnosis_html(diagnosis));
    write_whole_file(folder / "diagnosis.json", result);
  }
  fmt::print("{}", flags.json ? result : diagnosis_text(diagnosis));
}

}  // namespace

void add_diagnose(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "diagnose", "what the model gets wrong, why, and what an extended model gains");
  command->footer(
      "Tests the residuals of the fit for structure, tries every mechanism of the catalogue "
      "(alone,\n"
      "then two at a time), and answers with one of\n"
      "  adequate        nothing systematic is left\n"
      "  cause_named     one cause explains it, and nothing else in the catalogue does\n"
      "  not_separable   several causes explain it: which ones, and what to measure to decide\n"
      "  unexplained     something is there that the catalogue does not know, or the errors are "
      "larger\n"
      "                  than stated\n"
      "With --out it writes diagnosis.json, diagnosis.html (a page to read) and extended.toml (a "
      "fit\n"
      "file of the extended model).\n\n"
      "  recoil diagnose fits/wall1990-molybdenum.toml --out diagnosis\n"
      "  recoil fit diagnosis/extended.toml");
  const auto flags = std::make_shared<DiagnoseFlags>();
  command->add_option("FIT", flags->fit, "a fit file")->required();
  command->add_option("--out", flags->out, "folder for the results (default: nothing is written)")
      ->type_name("DIR");
  command->add_option("--threads", flags->threads, "threads to use (default: all cores)")
      ->check(CLI::Range(1, 4096));
  command
      ->add_option("--seed", flags->seed,
                   "seed of the simulated data sets (default: the fit file's)")
      ->check(CLI::NonNegativeNumber);
  add_shard_flags(*command, "calibration's data sets", flags->shards);
  add_json_flag(*command, flags->json);
  command->callback([flags] {
    if (flags->shards.one_of_several()) {
      run_shard_of_calibration(*flags);
    } else {
      run_diagnosis(*flags);
    }
  });
}

}  // namespace recoil
