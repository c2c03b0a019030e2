#include <fmt/format.h>

#include <memory>

#include "core/error.hpp"
#include "core/files.hpp"
#include "data/folder_names.hpp"
#include "studies/commands.hpp"
#include "studies/corrections.hpp"

namespace recoil {
namespace {

void study_corrections_of(const std::string& fit_file, const StudyRun& run) {
  const FitSpec spec = load_fit(fit_file);
  if (spec.datasets.size() != 1) {
    throw InputError({fit_file}, "this fit has several datasets", "one recipe is studied at a time",
                     "name the fit of one reconstruction");
  }
  const Dataset dataset = load_dataset(spec.datasets.front());
  CorrectionStudies found;
  found.studies = study_recipe(spec, load_recipe(dataset.folder), dataset);
  if (found.studies.empty()) {
    throw InputError({(dataset.folder / recipe_name).string()}, "there are no corrections to study",
                     "its points do not come from passages, or its truth is another model",
                     "name a fit of li1999-sst65-silicon or li1999-sst125-silicon");
  }
  found.inputs =
      correction_inputs(spec.sha256, dataset.sha256, read_text_file(dataset.folder / recipe_name));
  nlohmann::ordered_json json = json_of(run.stamp());
  json.update(nlohmann::ordered_json::parse(correction_studies_json(found)));
  const std::filesystem::path file =
      run.out.empty() ? dataset.folder / correction_studies_name : std::filesystem::path(run.out);
  write_whole_file(file, json.dump(1) + "\n");
  fmt::print("{}: written\n", file.string());
}

}  // namespace

void add_corrections(CLI::App& program, const std::string& words) {
  CLI::App* command = program.add_subcommand(
      "corrections",
      "what each correction between events and points does, for the report of a reconstruction");
  const auto run = std::make_shared<StudyRun>();
  run->command = words;
  const auto fit_file = std::make_shared<std::string>();
  command->add_option("FIT", *fit_file, "of one reconstruction whose points come from events")
      ->required();
  add_run_options(*command, *run);
  command->callback([fit_file, run] { study_corrections_of(*fit_file, *run); });
}

}  // namespace recoil
