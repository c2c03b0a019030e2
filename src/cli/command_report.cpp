#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/analysis.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/recipe_words.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "data/folder_names.hpp"
#include "diagnosis/diagnose.hpp"
#include "diagnosis/extended_toml.hpp"
#include "report/diagnosis_document.hpp"
#include "report/index_document.hpp"
#include "report/json_diagnosis.hpp"
#include "report/json_report.hpp"
#include "report/law_comparison.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

struct ReportOptions {
  std::vector<std::string> fits;
  std::string out = "reports";
  bool force = false;
  AnalysisFlags analysis;
};

std::vector<fs::path> fits_to_report(const ReportOptions& options) {
  std::vector<fs::path> files(options.fits.begin(), options.fits.end());
  if (!files.empty()) return files;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator("fits", failed)) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  if (files.empty()) {
    throw InputError({"fits"}, "there are no fit files here",
                     "without FIT, recoil report takes every fits/*.toml",
                     "name the fits, or run this in the project's folder");
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Changes whenever the page could: program, fit file, data, options.
std::string fingerprint(const FitInputs& inputs, const AnalysisFlags& flags) {
  std::string text = inputs.spec.sha256;
  for (const Dataset& dataset : inputs.datasets) {
    text += dataset.sha256;
    for (const char* name : {recipe_name, correction_studies_name}) {
      if (fs::exists(dataset.folder / name)) {
        text += sha256_hex(read_text_file(dataset.folder / name));
      }
    }
    if (const auto sizes = sizes_of_dataset(dataset.folder)) text += sizes->sha256;
  }
  text += fmt::format("|{}|{}|{}|{}|{}", flags.replicates, flags.scheme, flags.seed, flags.solver,
                      program_stamp());
  return sha256_hex(text) + "\n";
}

bool is_current(const fs::path& stamp, const std::string& expected,
                const std::vector<fs::path>& files) {
  const bool all_there =
      std::all_of(files.begin(), files.end(), [](const fs::path& f) { return fs::exists(f); });
  return all_there && fs::exists(stamp) && read_text_file(stamp) == expected;
}

Diagnosis diagnose_for_report(const Analysis& analysis, const AnalysisFlags& flags) {
  DiagnosisOptions options;
  options.seed = analysis.uncertainty.options.seed;
  options.threads = flags.threads;
  Diagnosis diagnosis = diagnose(analysis.spec, analysis.datasets, analysis.fitted, options,
                                 analysis.uncertainty.intervals);
  diagnosis.remarks = recipe_remarks(diagnosis.datasets);
  return diagnosis;
}

void report(const ReportOptions& options) {
  const fs::path out = options.out;
  require_writable_folder(out);
  std::vector<IndexEntry> entries;
  for (const fs::path& fit_file : fits_to_report(options)) {
    const std::string id = fit_file.stem().string();
    const fs::path page = out / (id + ".html");
    const fs::path json = out / id / "fit.json";
    const fs::path text = out / id / "fit.txt";
    const fs::path picture = out / id / "picture.svg";
    const fs::path picture_data = out / id / "picture.csv";
    const fs::path diagnosed = out / id / "diagnosis.json";
    const fs::path laws = out / id / "laws.json";
    const fs::path stamp = out / id / "inputs.sha256";
    FitInputs inputs = load_inputs(fit_file);
    const std::string expected = fingerprint(inputs, options.analysis);
    IndexEntry entry;
    entry.page = id + ".html";
    entry.diagnosis_page = id + "/diagnosis.html";
    if (!options.force &&
        is_current(stamp, expected, {page, json, text, picture, picture_data, diagnosed, laws})) {
      entry.fit = read_summary(entry.page, read_text_file(json), read_text_file(diagnosed));
      entry.fit.laws = read_laws(entry.page, read_text_file(laws));
      entry.picture = read_text_file(picture);
      entry.picture_csv = read_text_file(picture_data);
      fmt::print("{}: current\n", page.string());
    } else {
      AnalysisOptions resolved = options.analysis.resolved();
      resolved.folder = out / id;
      Analysis analysis = analyse(std::move(inputs), resolved);
      add_predictions(analysis);
      add_corrections(analysis);
      analysis.laws = fit_under_every_law(analysis.spec, analysis.datasets, analysis.fitted);
      const Diagnosis diagnosis = diagnose_for_report(analysis, options.analysis);
      entry.fit = summary_of(analysis, diagnosis);
      entry.picture = thumbnail(analysis);
      entry.picture_csv = thumbnail_csv(analysis);
      write_whole_file(page,
                       html_report(analysis, diagnosis_blocks(diagnosis, entry.diagnosis_page)));
      write_whole_file(out / id / "diagnosis.html", diagnosis_html(diagnosis));
      write_whole_file(diagnosed, diagnosis_json(diagnosis));
      write_whole_file(out / id / "extended.toml", extended_toml(diagnosis, out / id));
      write_whole_file(text, text_report(analysis));
      write_whole_file(laws, laws_json(entry.fit.laws));
      write_whole_file(picture, entry.picture);
      write_whole_file(picture_data, entry.picture_csv);
      write_whole_file(json, json_report(analysis));
      write_whole_file(stamp, expected);
      forget_replicates(resolved.folder);
      fmt::print("{}: written\n", page.string());
    }
    std::fflush(stdout);
    entries.push_back(std::move(entry));
  }
  write_whole_file(out / "index.html", html_index(entries));
  fmt::print("{}: written\n", (out / "index.html").string());
}

}  // namespace

void add_report(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("report", "fit, and write a page for every fit and an index");
  command->footer(
      "Writes one page per fit, which needs no other file, and index.html. Pages whose inputs "
      "have\n"
      "not changed are kept.\n\n"
      "  recoil report                      every fits/*.toml into reports/\n"
      "  recoil report my.toml --out pages  one fit");
  const auto options = std::make_shared<ReportOptions>();
  command->add_option("FIT", options->fits, "fit files (default: fits/*.toml)");
  command->add_option("--out", options->out, "folder for the pages")
      ->capture_default_str()
      ->type_name("DIR");
  command->add_flag("--force", options->force,
                    "write every page again, even if nothing has changed");
  add_analysis_flags(*command, options->analysis);
  command->callback([options] { report(*options); });
}

}  // namespace recoil
