#include <fmt/format.h>

#include <algorithm>

#include "cli/commands.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "core/units.hpp"
#include "data/ball_table.hpp"
#include "data/contact.hpp"
#include "data/limits.hpp"
#include "data/material_table.hpp"
#include "data/text.hpp"
#include "experiment/import.hpp"
#include "experiment/look.hpp"
#include "options/useless_options.hpp"
#include "plot/draw.hpp"
#include "report/dataset_report.hpp"
#include "report/words_dataset.hpp"
#include "report/words_restitution.hpp"

namespace recoil {
namespace {

/// What `import` and `bounce` have in common.
ImportRequest reading_of(const GivenOptions& given) {
  ImportRequest r;
  const std::vector<std::string> files = given.texts("FILE");
  r.file = files.front();
  r.more_files.assign(files.begin() + 1, files.end());
  r.sheet = given.text("--sheet");
  r.map = given.texts("--map");
  r.decimal_comma = given.has("--decimal-comma");
  r.transpose = given.has("--transpose");
  r.series = given.text("--series");
  r.captured_below = given.number_if_any("--captured-below").value_or(0.0);
  r.drop_error = given.text("--drop-error");
  r.rebound_error = given.text("--rebound-error");
  r.time_error = given.text("--time-error");
  r.average = given.has("--average");
  r.gravity = given.number("--gravity");
  r.fps = given.number_if_any("--fps");
  r.scale = given.text("--scale");
  r.conditions = given.texts("--condition");
  if (given.has("--ambient-pressure")) {
    r.conditions.push_back("ambient_pressure=" + given.text("--ambient-pressure"));
  }
  if (given.has("--format")) {
    r.format = *value_named<ImportFormat>(given.text("--format"));
    return r;
  }
  if (r.file == "-") {
    throw InputError({}, "the format of standard input is not known", "it can be read only once",
                     "state it with --format");
  }
  r.format = format_of(r);
  GivenOptions with_format = given;
  with_format.set("--format", {std::string(to_string(r.format))});
  refuse_useless_options(with_format);
  return r;
}

std::string words_of(ImportFormat format) {
  switch (format) {
    case ImportFormat::webplotdigitizer:
      return "points read off a figure";
    case ImportFormat::heights:
      return "drop and rebound heights";
    case ImportFormat::intervals:
      return "times of bounces";
    case ImportFormat::csv:
      return "impacts, one in a row";
    case ImportFormat::track:
      return "heights over time";
    case ImportFormat::recording:
      return "the sound of bounces";
    case ImportFormat::rest:
      return "drop heights and times to rest";
    case ImportFormat::tops:
      return "heights of successive tops";
    case ImportFormat::blocks:
      return "times of several bounces together";
  }
  return "";
}

ImportRequest request_of(const GivenOptions& given) {
  ImportRequest r = reading_of(given);
  r.into = given.text("--into");
  r.replace = given.has("--replace");
  r.sd_of = given.text("--sd-of");
  r.diameters = given.texts("--diameter");
  r.diameter_error = given.text("--diameter-error");
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
  r.method = given.text("--method");
  return r;
}

/// The e of the points, which is the answer for balls.
void print_summary(const Dataset& dataset, bool adhesion) {
  for (const Sentence& sentence : restitution_sentences({dataset}, adhesion)) {
    print_line(plain_text(sentence));
  }
}

/// Sets the diameter of the ball. @return its density for the drag of air [kg/m3]
double set_ball(const GivenOptions& given, ImportRequest& request) {
  const std::string name = given.text("--ball");
  std::optional<double> diameter = given.number_if_any("--diameter");
  std::optional<double> mass = given.number_if_any("--mass");
  const auto materials = tabled_materials();
  const auto material = std::ranges::find(materials, name, &TabledMaterial::name);
  double density = material == materials.end() ? 0.0 : material->density;
  if (!name.empty() && material == materials.end()) {
    const TabledBall& ball = tabled_ball(name);
    if (!diameter) diameter = ball.diameter;
    if (!mass) mass = ball.mass;
  }
  constexpr double any_size = 0.01;  // [m], where nothing depends on it
  const bool vacuum = given.number_if_any("--ambient-pressure").value_or(1.0) == 0.0;
  if (!vacuum && (!diameter || (!mass && density == 0.0))) {
    throw InputError(
        {}, !diameter ? "the size of the ball is not known" : "the mass of the ball is not known",
        "the drag of air depends on size and mass",
        "give --ball NAME (table-tennis, tennis, golf, squash), or --diameter and "
        "--mass, or --ambient-pressure 0 to neglect the air");
  }
  const double size = diameter.value_or(any_size);
  request.diameters = {fmt::format("{:.17g}m", size)};
  if (mass) density = *mass / sphere_mass(size, 1.0);
  constexpr double lightest = 2.0;  // [kg/m3], of a hollow ball: more than air
  if (mass && diameter && !(density > lightest && density < limits::density.upper)) {
    throw InputError({},
                     fmt::format("a ball of {:.4g} mm and {:.4g} kg has a density of {:.2g} kg/m3",
                                 size / units::mm, *mass, density),
                     fmt::format("balls have {:g} to {:g} kg/m3", lightest, limits::density.upper),
                     "check --diameter, and give --mass in kg: 2.7 g is 0.0027");
  }
  return density > 0.0 ? density : limits::density.upper;
}

void run_bounce(const GivenOptions& given) {
  ImportRequest request = reading_of(given);
  if (request.format == ImportFormat::csv || request.format == ImportFormat::webplotdigitizer) {
    throw InputError({}, fmt::format("--format {} holds no bounces", to_string(request.format)),
                     "bounce reads heights, times, tracks and recordings",
                     "use recoil import, which prints e, too");
  }
  const double density = set_ball(given, request);
  const std::string out = given.text("--out");
  if (!out.empty()) require_figure(out);
  const ImportResult result = read_bounces(request, density);
  print_summary(result.dataset, false);
  for (const ImportNote& note : result.notes) print_line("note: " + note_sentence(note));
  if (out.empty()) return;
  constexpr double width = 120.0;  // [mm]
  write_figure(out,
               plot::draw_svg(restitution_picture(result.dataset, pixels_of_figure(width)), width));
  print_text("{}: written\n", out);
}

/// Says what the file holds, and what is missing to import it.
void look(const ImportRequest& request) {
  const FileLook found = look_at(request);
  print_line(fmt::format("{}: {} ({}, --format {})", request.file.string(),
                         words_of(request.format), counted(found.points, "point"),
                         to_string(request.format)));
  for (const ImportNote& note : found.notes) print_line("note: " + note_sentence(note));
  if (!found.missing.empty()) {
    print_line("missing in the file: " + fmt::format("{}", fmt::join(found.missing, ", ")));
  }
  print_line("next: the same command with --into DIR" +
             std::string(found.missing.empty() ? "" : " and what is missing"));
}

void run_import(const GivenOptions& given) {
  const ImportRequest request = request_of(given);
  if (!given.has("--into")) {
    look(request);
    return;
  }
  require_writable_folder(request.into);
  const Claim claim(request.into / "points.csv");
  const ImportResult result = import_points(request);
  const bool adhesion = result.dataset.system.adhesion_energy.value_or(1.0) > 0.0;
  print_summary(result.dataset, adhesion);
  print_text("{}", dataset_text(result.dataset, Importance::answer));
  for (const ImportNote& note : result.notes) print_note(note_sentence(note));
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
bounces), track (heights over time), rest (drop heights and times to rest), tops (heights of
successive tops), blocks (times of several bounces together), recording (a sound file) and csv.
--map assigns columns to quantities, with units: um, mm, cm, m, in; m/s, km/h; s, ms; %. Elsewhere,
a number without a unit counts in um if it is a diameter, otherwise in the SI unit. import
overwrites points only with --replace.

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
    --map incident_velocity=Vi:cm/s,rebound_velocity=Vr:cm/s,diameter=D:um)",
      run_import);
}

void add_bounce(Program& program) {
  program.command("bounce", "the restitution of a ball from heights, times or a track", R"(
Prints the mean e with its interval, its dependence on the velocity and the differences between
series, and writes nothing but the picture that --out names. The ball needs its size and mass for
the drag of air, no other constant.
Several bounces of one drop are a launch (--map launch=COLUMN); series=COLUMN names what is to be
compared: balls, floors, temperatures.

  recoil bounce drops.csv --format heights --ball tennis \
    --map drop_height=h1:cm,rebound_height=h2:cm --rebound-error 5mm --out drops.svg
  recoil bounce times.csv --format intervals --diameter 8mm --mass 0.0021 \
    --map launch=run,interval=t:s --time-error 1ms)",
                  run_bounce);
}

}  // namespace recoil
