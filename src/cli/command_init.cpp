#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <memory>

#include "analysis/analysis.hpp"
#include "cli/commands.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
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

struct InitOptions {
  std::string folder;
  std::string particle, surface, like;
  std::string points;
  std::string provenance;
  double diameter = 0.0;  // [um]
};

constexpr const char* init_fit =
    R"toml(# Made by recoil init. Every key with its default: recoil help fit-file
dataset = "."

[parameters]
C_H = { initial = 3e-3 }                      # damping of the elastic contact [s/m]
C_A = { initial = 3e-2, bounds = [0, 10] }    # damping of the adhesion [s/m]
f0 = { free = false }                         # adhesion per length [N/m]: from the materials

[uncertainty]
replicates = 1999    # of the bootstrap
)toml";

/// Asks a question on the terminal. @returns the answer, or `otherwise` if it is empty
std::string ask(const std::string& question, const std::string& otherwise = "") {
  print_text("{}{}: ", question, otherwise.empty() ? "" : fmt::format(" [{}]", otherwise));
  std::fflush(stdout);
  std::string answer;
  if (!std::getline(std::cin, answer))
    throw InputError({}, "the input ended before all questions were answered", "", "");
  return answer.empty() ? otherwise : answer;
}

std::string ask_for_material(const std::string& which, bool density) {
  std::string words = fmt::format("material={}", ask(which + ": material, as a word"));
  if (density) words += fmt::format(",density={}", ask("  density [kg/m3]"));
  words += fmt::format(",youngs_modulus={}", ask("  Young's modulus [Pa]"));
  words += fmt::format(",poisson_ratio={}", ask("  Poisson's ratio"));
  return words;
}

/// Asks for missing options on a terminal. Otherwise `import_points` reports them.
void ask_for_missing(InitOptions& options) {
  if (isatty(STDIN_FILENO) == 0) return;
  if (options.like.empty()) {
    if (options.particle.empty()) options.particle = ask_for_material("the spheres", true);
    if (options.surface.empty()) options.surface = ask_for_material("the surface", false);
  }
  if (options.points.empty()) {
    options.points = ask(
        "a CSV file with the columns incident_velocity [m/s] and restitution (none: an example)");
  }
  if (!options.points.empty() && options.provenance.empty()) {
    options.provenance = ask("were these points measured or digitised?", "measured");
  }
  if (options.diameter <= 0.0) {
    const std::string answer = ask("diameter of the spheres [um]", "5");
    options.diameter = parse_number(answer).value_or(0.0);
    if (!(options.diameter > 0.0) || !(options.diameter < 1e6)) {
      throw InputError({}, fmt::format("'{}' is not a diameter", answer), "",
                       "give a number in um");
    }
  }
}

/// Example points, computed from the model.
std::string example_points(const Dataset& dataset, double diameter) {
  FitSpec spec = parse_fit(init_fit, "fit.toml");
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

void run_init(InitOptions options) {
  const fs::path folder = options.folder;
  const fs::path fit_file = folder / "fit.toml";
  for (const fs::path& file : {folder / package_file_name, folder / "points.csv", fit_file}) {
    if (fs::exists(file)) {
      throw InputError({file.string()}, "this file exists already", "init overwrites nothing",
                       "name another folder");
    }
  }
  require_writable_folder(folder);
  ask_for_missing(options);
  const Claim claim(folder / "points.csv");
  ImportRequest request;
  request.format = ImportFormat::csv;
  request.usual_units = true;
  request.into = folder;
  request.particle = options.particle;
  request.surface = options.surface;
  request.like = options.like;
  if (options.diameter > 0.0) request.diameters = {fmt::format("{:g}um", options.diameter)};
  NewFiles made({folder / package_file_name, folder / "points.csv", fit_file});
  ImportResult result;
  if (options.points.empty()) {
    if (options.diameter <= 0.0) {
      throw InputError({}, "the diameter of the spheres is not known", "",
                       "give --diameter 5, or points with a column diameter");
    }
    result.dataset = make_example(request, options.diameter * units::um);
  } else {
    request.file = options.points;
    request.provenance = value_named<Provenance>(options.provenance);
    result = import_points(request);
  }
  write_whole_file(fit_file, init_fit);
  load_inputs(fit_file);  // throws if the files are not valid
  made.keep();
  print_text("{}: {}{}\n", folder.string(), counted(result.dataset.points.size(), "point"),
             options.points.empty()
                 ? ", SYNTHETIC: computed from the model, with noise. Write your points to "
                   "points.csv and their provenance to datapackage.json"
                 : "");
  for (const DatasetWarning& warning : result.dataset.warnings) {
    print_text("note: {}\n", warning_sentence(warning));
  }
  for (const ImportNote& note : result.notes) print_text("note: {}\n", note_sentence(note));
  print_text("next:\n  recoil check {0}\n  recoil fit {0}/fit.toml --out {0}/result\n",
             folder.string());
}

}  // namespace

void add_init(Program& program) {
  const Command command = program.command("init", "make a new dataset folder and a fit file", R"(
On a terminal, init asks for what the options leave out. Without --points the folder gets
example points, which the model computes and which are labelled synthetic. Nothing is
overwritten. For figures, drop heights and bounce times: recoil help import.

  recoil init my-spheres --like datasets/wall1990-mica --diameter 4.9
  recoil init my-spheres --points measured.csv --provenance measured --diameter 5 \
    --particle material=polystyrene,density=1050,youngs_modulus=2.56e9,poisson_ratio=0.35 \
    --surface material=silicon,youngs_modulus=131e9,poisson_ratio=0.28)");
  const auto options = std::make_shared<InitOptions>();
  command.option("DIR", options->folder, "the new folder").required();
  command
      .option("--points", options->points,
              "the points (CSV) with incident_velocity, restitution and any other column of recoil "
              "help data (default: example points)")
      .takes("FILE");
  command
      .option("--provenance", options->provenance,
              "where these points come from: measured or digitised")
      .one_of({"measured", "digitised"});
  command.option("--particle", options->particle,
                 "the sphere: a name (recoil materials), a JSON file, or "
                 "material=...,density=...,youngs_modulus=...,poisson_ratio=...");
  command.option("--surface", options->surface,
                 "the surface, in the same form; its density may be left out");
  command.option("--like", options->like, "take the materials of this dataset").takes("DIR");
  command.option("--diameter", options->diameter, "diameter of all spheres [um]")
      .within(1e-3, 1e6, "diameter");
  command.runs([options] { run_init(*options); });
}

}  // namespace recoil
