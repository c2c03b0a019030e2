#include <fmt/format.h>

#include <algorithm>

#include "analysis/analysis.hpp"
#include "cli/commands.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "core/random.hpp"
#include "data/dataset.hpp"
#include "data/text.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/predictor.hpp"
#include "experiment/import.hpp"
#include "json/fit_file.hpp"
#include "report/words_dataset.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

std::string example_points(const Dataset& dataset, double diameter) {
  FitSpec spec = parse_fit(new_fit_file, "fit.toml");
  const ImpactModel model = make_model(spec, {dataset});
  const std::vector<double> theta = model.initial();
  const CaptureVelocity capture = capture_velocity(model, theta, 0, diameter);
  const double unit = capture.found && capture.value > 0.0 ? capture.value : 1.0;
  constexpr double sd = 0.01;
  RandomStream random(1, RandomPurpose::example, 0);
  std::string csv = "incident_velocity,restitution,restitution_sd,events,captured\n";
  for (const double multiple : {0.8, 1.1, 1.3, 1.6, 2.2, 3.0, 5.0, 9.0, 16.0, 30.0}) {
    const double v = multiple * unit;
    const Prediction at = predict(model, theta, 0, diameter, v, false);
    const bool rebounds = at.usable() && at.restitution() > 0.0;
    const double e = rebounds ? at.restitution() + sd * random.normal() : 0.0;
    csv += rebounds ? fmt::format("{:.4g},{:.3f},{},20,0\n", v, std::clamp(e, 0.0, 1.0), sd)
                    : fmt::format("{:.4g},0,,20,20\n", v);
  }
  return csv;
}

/// Removes its files in the destructor unless `keep` was called. Incomplete results would prevent a
/// second run.
class NewFiles {
 public:
  explicit NewFiles(std::vector<fs::path> files) : files_(std::move(files)) {}
  ~NewFiles() {
    std::error_code ignored;
    for (const fs::path& file : files_) fs::remove(file, ignored);
  }
  NewFiles(const NewFiles&) = delete;
  NewFiles& operator=(const NewFiles&) = delete;
  void keep() { files_.clear(); }

 private:
  std::vector<fs::path> files_;
};

Dataset make_example(ImportRequest request, double diameter) {
  request.file = "example.csv";
  request.provenance = Provenance::synthetic;
  request.title = "An example";
  request.sources = {
      "Computed by recoil init from the model, with noise: replace these points by yours"};
  request.sd_of = "mean";
  request.text = "incident_velocity,restitution\n1,0.5\n2,0.6\n";
  const Dataset first = import_points(request).dataset;  // provides the materials
  request.text = example_points(first, diameter);
  request.replace = true;
  return import_points(request).dataset;
}

void run_init(const GivenOptions& given) {
  const fs::path folder = given.text("DIR");
  const std::string points = given.text("--points");
  const fs::path fit_file = folder / "fit.toml";
  for (const fs::path& file : {folder / package_file_name, folder / "points.csv", fit_file}) {
    if (fs::exists(file)) {
      throw InputError({file.string()}, "this file exists already", "init overwrites nothing",
                       "name another folder");
    }
  }
  require_writable_folder(folder);
  const Claim claim(folder / "points.csv");
  ImportRequest request;
  request.format = ImportFormat::csv;
  request.usual_units = true;
  request.into = folder;
  request.particle = given.text("--particle");
  request.surface = given.text("--surface");
  request.like = given.text("--like");
  request.diameters = given.texts("--diameter");
  NewFiles made({folder / package_file_name, folder / "points.csv", fit_file});
  ImportResult result;
  if (points.empty()) {
    if (!given.has("--diameter")) {
      throw InputError({}, "the diameter of the spheres is not known", "",
                       "give --diameter 5, or points with a column diameter");
    }
    result.dataset = make_example(request, given.number("--diameter"));
  } else {
    request.file = points;
    request.sheet = given.text("--sheet");
    request.map = given.texts("--map");
    request.provenance = value_named<Provenance>(given.text("--provenance"));
    result = import_points(request);
  }
  write_whole_file(fit_file, new_fit_file);
  load_inputs(fit_file);  // throws if the files are not valid
  made.keep();
  print_line(fmt::format(
      "{}: {}{}", folder.string(), counted(result.dataset.points.size(), "point"),
      points.empty() ? ", SYNTHETIC: computed from the model, with noise. Write your points to "
                       "points.csv and their provenance to datapackage.json"
                     : ""));
  for (const DatasetWarning& warning : result.dataset.warnings) {
    print_note(warning_sentence(warning));
  }
  for (const ImportNote& note : result.notes) print_note(note_sentence(note));
  print_text("next:\n  recoil check {0}\n  recoil fit {0}/fit.toml --out {0}/result\n",
             folder.string());
}

}  // namespace

void add_init(Program& program) {
  program.command("init", "make a new dataset folder and a fit file", R"(
Without --points the folder gets example points, which the model computes and which are
labelled synthetic. Nothing is overwritten. For figures, drop heights and bounce times: recoil
import.

  recoil init my-spheres --like datasets/wall1990-mica --diameter 4.9
  recoil init my-spheres --points measured.csv --diameter 5 \
    --particle material=latex,density=1050,youngs_modulus=2.56e9,poisson_ratio=0.35 \
    --surface material=silicon,youngs_modulus=131e9,poisson_ratio=0.28)",
                  run_init);
}

}  // namespace recoil
