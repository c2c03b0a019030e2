#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "analysis/analysis.hpp"
#include "cli/commands.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/parallel.hpp"
#include "core/program.hpp"
#include "core/quoting.hpp"
#include "core/resumable.hpp"
#include "data/dataset.hpp"
#include "diagnosis/diagnose.hpp"
#include "document/html.hpp"
#include "plot/draw.hpp"
#include "report/comparison_report.hpp"
#include "report/diagnosis_report.hpp"
#include "report/fit_report.hpp"
#include "report/index_page.hpp"
#include "report/result_json.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> fits_to_report(const GivenOptions& given) {
  const std::vector<std::string> named = given.texts("FIT");
  if (!named.empty()) return {named.begin(), named.end()};
  std::vector<fs::path> files = files_in("fits", ".toml");
  if (files.empty()) {
    throw InputError({"fits"}, "there are no fit files here",
                     "without FIT, recoil report uses every fits/*.toml",
                     "name the fit files, or run this in the project's folder");
  }
  return files;
}

/// A fit NAME has the page NAME.html and the folder NAME.
/// @throws InputError if two fits would have the same page, or a fit the page of the index
void require_distinct_pages(const std::vector<fs::path>& fits) {
  std::map<std::string, fs::path> owners = {{"index.html", "the index"}};
  for (const fs::path& fit : fits) {
    const std::string id = fit.stem().string();
    if (id == "." || id == "..") {
      throw InputError({fit.string()}, "this name gives a page no folder of its own", "",
                       "rename the fit file");
    }
    for (const std::string& name : {id + ".html", id}) {
      const auto [owner, is_free] = owners.emplace(name, fit);
      if (is_free) continue;
      throw InputError(
          {fit.string()},
          fmt::format("its page {} would also be that of {}", name, owner->second.string()),
          "pages are named after the fit files", "rename one of them");
    }
  }
}

/// A hash of everything that a page depends on: program, fit file, data, options.
std::string fingerprint(const FitInputs& inputs, const GivenOptions& given) {
  std::string text = inputs.spec.sha256;
  for (const Dataset& dataset : inputs.datasets) {
    text += dataset.sha256;
    if (fs::exists(dataset.folder / recipe_name)) {
      text += sha256_hex(read_text_file(dataset.folder / recipe_name));
    }
    if (const auto sizes = sizes_of_dataset(dataset.folder)) text += sizes->sha256;
  }
  text +=
      fmt::format("|{}|{}|{}", given.text("--replicates"), given.text("--seed"), program_stamp());
  return sha256_hex(text) + "\n";
}

/// Diagnoses a fit and adds the fits under every law to `analysis`. Both run at the same time,
/// because a diagnosis does not use all threads.
Diagnosis diagnose_for_report(Analysis& analysis, int threads,
                              const std::shared_ptr<KeptRows>& kept) {
  DiagnosisOptions options;
  options.kept = kept;
  options.seed = analysis.uncertainty.options.seed;
  options.threads = threads;
  Diagnosis diagnosis = resumable(*kept, [&] {
    Diagnosis result;
    at_once(
        threads,
        [&] {
          result = diagnose(analysis.spec, analysis.datasets, analysis.fitted, options,
                            analysis.uncertainty.intervals);
        },
        [&] {
          analysis.laws = fit_under_every_law(analysis.spec, analysis.datasets, analysis.fitted);
        });
    return result;
  });
  diagnosis.remarks = reconstruction_remarks(diagnosis.datasets);
  return diagnosis;
}

/// The files of one fit's page.
struct PageFiles {
  PageFiles(const fs::path& out, const std::string& id)
      : page(out / (id + ".html")), folder(out / id) {}

  fs::path page, folder;
  fs::path json = folder / "fit.json";
  fs::path text = folder / "fit.txt";
  fs::path picture = folder / "picture.svg";
  fs::path picture_data = folder / "picture.csv";
  fs::path diagnosed = folder / "diagnosis.json";
  fs::path laws = folder / "laws.json";
  fs::path stamp = folder / "inputs.sha256";

  bool are_current(const std::string& expected) const {
    const auto files = {page, json, text, picture, picture_data, diagnosed, laws};
    return std::ranges::all_of(files, [](const fs::path& f) { return fs::exists(f); }) &&
           sha256_of_file(stamp) == sha256_hex(expected);
  }
};

IndexEntry read_page(const PageFiles& files, IndexEntry entry) {
  entry.fit_json = read_text_file(files.json);
  entry.diagnosis_json = read_text_file(files.diagnosed);
  entry.picture = read_text_file(files.picture);
  entry.picture_csv = read_text_file(files.picture_data);
  return entry;
}

IndexEntry make_page(FitInputs inputs, const GivenOptions& given, const std::string& expected,
                     const PageFiles& files, IndexEntry entry) {
  // A page continues an earlier, stopped run with the same inputs.
  const auto kept_for = [&](const fs::path& result) {
    return std::make_shared<KeptRows>(unfinished_beside(result),
                                      expected + arithmetic_fingerprint());
  };
  AnalysisOptions resolved = analysis_options(given);
  resolved.kept = kept_for(files.json);
  Analysis analysis =
      resumable(*resolved.kept, [&] { return analyse(std::move(inputs), resolved); });
  add_predictions(analysis);
  const std::shared_ptr<KeptRows> kept = kept_for(files.diagnosed);
  const Diagnosis diagnosis = diagnose_for_report(analysis, resolved.threads, kept);
  std::string page, diagnosis_page;
  at_once(
      resolved.threads, [&] { page = fit_html(analysis, &diagnosis, entry.diagnosis_page); },
      [&] { diagnosis_page = diagnosis_html(diagnosis); },
      [&] {
        const plot::Picture picture = thumbnail(analysis);
        entry.picture = plot::draw_svg(picture);
        entry.picture_csv = plot::csv_of(picture);
      });
  entry.fit_json = fit_json(analysis);
  entry.diagnosis_json = diagnosis_json(diagnosis);
  write_whole_files({{files.page, page},
                     {files.folder / "diagnosis.html", diagnosis_page},
                     {files.diagnosed, entry.diagnosis_json},
                     {files.folder / "extended.toml", extended_toml(diagnosis, files.folder)},
                     {files.text, fit_text(analysis, Importance::detail)},
                     {files.laws, laws_json(compared_laws(analysis.laws, analysis.datasets))},
                     {files.picture, entry.picture},
                     {files.picture_data, entry.picture_csv},
                     {files.json, entry.fit_json},
                     {files.stamp, expected}});
  kept->forget();
  resolved.kept->forget();
  return entry;
}

/// Links to the pages of recoil in `out` that are not of `entries`, such as those of other fits.
std::vector<Sentence> other_pages(const fs::path& out, const std::vector<IndexEntry>& entries) {
  std::vector<Sentence> links;
  for (const fs::path& file : files_in(out, ".html")) {
    const std::string address = url_path(file.filename().string());
    const bool own = address == "index.html" ||
                     std::ranges::any_of(
                         entries, [&](const IndexEntry& entry) { return entry.page == address; });
    if (own) continue;
    try {
      const std::string title = title_of_page(read_text_file(file));
      if (!title.empty()) links.push_back(link(title, address));
    } catch (const InputError&) {  // of somebody else
    }
  }
  return links;
}

void report(const GivenOptions& given) {
  const fs::path out = given.text("--out");
  require_writable_folder(out);
  const std::vector<fs::path> fits = fits_to_report(given);
  require_distinct_pages(fits);
  std::vector<FitInputs> all;  // a mistake in one of them ends the command before the work
  for (const fs::path& fit : fits) {
    all.push_back(load_inputs(fit));
    const PageFiles files(out, fit.stem().string());
    require_free({files.page, files.folder / "extended.toml"});
  }
  std::vector<IndexEntry> entries;
  for (FitInputs& inputs : all) {
    const std::string id = fits[entries.size()].stem().string();
    const PageFiles files(out, id);
    const std::string expected = fingerprint(inputs, given);
    IndexEntry entry;
    entry.page = url_path(id + ".html");
    entry.diagnosis_page = url_path(id + "/diagnosis.html");
    const bool current = files.are_current(expected) && !given.has("--force");
    if (current) {
      entries.push_back(read_page(files, std::move(entry)));
    } else {
      const Claim claim(files.json);
      entries.push_back(make_page(std::move(inputs), given, expected, files, std::move(entry)));
    }
    print_text("{}: {}\n", files.page.string(), current ? "current" : "written");
    std::fflush(stdout);
  }
  write_whole_file(out / "index.html",
                   html_page(index_document(entries, other_pages(out, entries))));
  print_text("{}: written\n", (out / "index.html").string());
}

}  // namespace

void add_report(Program& program) {
  program.command("report", "write a page for every fit, and an index", R"(
Writes one page per fit and index.html. A page needs no other file. Pages whose inputs have
not changed are kept.

  recoil report                      every fits/*.toml into reports/
  recoil report my.toml --out pages  one fit)",
                  report);
}

}  // namespace recoil
