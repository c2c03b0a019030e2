#include <fmt/format.h>

#include <memory>

#include "cli/analysis.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/recipe_words.hpp"
#include "core/files.hpp"
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
};

void run_diagnosis(const DiagnoseFlags& flags) {
  if (!flags.out.empty()) require_writable_folder(flags.out);
  const FitSpec spec = load_fit(flags.fit);
  DiagnosisOptions options;
  options.threads = flags.threads;
  options.seed = flags.seed >= 0 ? static_cast<std::uint64_t>(flags.seed) : spec.uncertainty.seed;
  Diagnosis diagnosis = diagnose(spec, load_datasets(spec), options);
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
  add_json_flag(*command, flags->json);
  command->callback([flags] { run_diagnosis(*flags); });
}

}  // namespace recoil
