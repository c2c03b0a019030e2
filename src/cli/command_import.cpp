#include <fmt/format.h>

#include "cli/commands.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "experiment/import.hpp"
#include "report/dataset_report.hpp"
#include "report/words_dataset.hpp"

namespace recoil {
namespace {

ImportRequest request_of(const GivenOptions& given) {
  ImportRequest r;
  const std::vector<std::string> files = given.texts("FILE");
  r.file = files.front();
  r.more_files.assign(files.begin() + 1, files.end());
  r.format = *value_named<ImportFormat>(given.text("--format"));
  r.into = given.text("--into");
  r.sheet = given.text("--sheet");
  r.replace = given.has("--replace");
  r.map = given.texts("--map");
  r.decimal_comma = given.has("--decimal-comma");
  r.sd_of = given.text("--sd-of");
  r.diameters = given.texts("--diameter");
  r.diameter_error = given.text("--diameter-error");
  r.series = given.text("--series");
  r.particle = given.text("--particle");
  r.surface = given.text("--surface");
  r.like = given.text("--like");
  r.adhesion_energy = given.number_if_any("--adhesion-energy");
  r.provenance = value_named<Provenance>(given.text("--provenance"));
  r.sources = given.texts("--source");
  r.axes = given.texts("--axis");
  r.error_series = given.texts("--error-series");
  r.reading_error = given.text("--reading-error");
  r.scatter = given.text("--scatter");
  r.captured_below = given.number_if_any("--captured-below").value_or(0.0);
  r.drop_error = given.text("--drop-error");
  r.rebound_error = given.text("--rebound-error");
  r.time_error = given.text("--time-error");
  r.average = given.has("--average");
  r.gravity = given.number("--gravity");
  r.fps = given.number_if_any("--fps");
  r.scale = given.text("--scale");
  r.method = given.text("--method");
  r.conditions = given.texts("--condition");
  if (given.has("--ambient-pressure")) {
    r.conditions.push_back("ambient_pressure=" + given.text("--ambient-pressure"));
  }
  return r;
}

void run_import(const GivenOptions& given) {
  const ImportRequest request = request_of(given);
  require_writable_folder(request.into);
  const Claim claim(request.into / "points.csv");
  const ImportResult result = import_points(request);
  print_text("{}", dataset_text(result.dataset));
  for (const ImportNote& note : result.notes) print_text("note: {}\n", note_sentence(note));
  print_text("{}: written\n", request.into.string());
  const std::filesystem::path fit_file = request.into / "fit.toml";
  std::error_code failed;
  if (!std::filesystem::exists(fit_file, failed)) write_whole_file(fit_file, new_fit_file);
  print_text("next:\n  recoil fit {0}\n  recoil diagnose {0}\n", fit_file.string());
}

}  // namespace

void add_import(Program& program) {
  program.command(
      "import",
      "make a dataset folder from digitised points, drop heights, bounce times or any table", R"(
Formats: webplotdigitizer (all series as CSV), heights (drop and rebound), intervals (between
bounces), track (heights over time), recording (a sound file) and csv. --map assigns columns to quantities, with units: um,
mm, cm, m, in; m/s, km/h; s, ms; %. Elsewhere, a number without a unit counts in um if it is a
diameter, otherwise in the SI unit. import overwrites points only with --replace.

  recoil import fig7.csv --format webplotdigitizer --into datasets/mine \
    --axis x=log,1,100 --axis y=linear,0,1 --reading-error 0.5% --like datasets/wall1990-mica
  recoil import drops.csv --format heights --into datasets/ball --diameter 40mm \
    --map drop_height=h1:cm,rebound_height=h2:cm --particle ball.json --surface floor.json
  recoil import bounces.csv --format intervals --into datasets/ball2 --diameter 40mm \
    --map launch=run,interval=t:s --time-error 1ms --like datasets/ball
  recoil import ball.txt --format track --into datasets/ball3 --diameter 40mm \
    --map frame=f,pixel=y --fps 240 --particle nylon --surface concrete
  recoil import bounces.wav --format recording --into datasets/ball4 --like datasets/ball
  recoil import table.csv --format csv --into datasets/wall1990-molybdenum --replace \
    --map incident_velocity=Vi:cm/s,rebound_velocity=Vr:cm/s,diameter=D:um,series=run)",
      run_import);
}

}  // namespace recoil
