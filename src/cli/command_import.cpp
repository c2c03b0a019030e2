#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "cli/commands.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "data/limits.hpp"
#include "data/text.hpp"
#include "experiment/import.hpp"
#include "report/dataset_report.hpp"
#include "report/words_dataset.hpp"

namespace recoil {
namespace {

struct ImportFlags {
  ImportRequest request;
  std::string format;
  std::string provenance;
};

/// An option that only some formats use.
struct OptionOfFormats {
  std::string_view option;
  std::vector<ImportFormat> formats;
};

/// @throws InputError for an option that the format does not use
void require_used(const Command& command, ImportFormat format) {
  using enum ImportFormat;
  static const std::vector<OptionOfFormats> some = {
      {"--axis", {webplotdigitizer}},
      {"--reading-error", {webplotdigitizer}},
      {"--error-series", {webplotdigitizer}},
      {"--sd-of", {csv}},
      {"--scatter", {webplotdigitizer}},
      {"--captured-below", {webplotdigitizer, heights}},
      {"--drop-error", {heights, intervals}},
      {"--rebound-error", {heights}},
      {"--time-error", {intervals}},
      {"--average", {heights}},
      {"--gravity", {heights, intervals, track}},
      {"--fps", {track}},
      {"--scale", {track}},
  };
  for (const OptionOfFormats& one : some) {
    const std::string option(one.option);
    if (!command.given(option) || std::count(one.formats.begin(), one.formats.end(), format) > 0)
      continue;
    std::vector<std::string_view> names;
    for (const ImportFormat its : one.formats) names.push_back(name_of(its));
    throw InputError(
        {}, fmt::format("{} does nothing with --format {}", option, name_of(format)),
        fmt::format("it is an option of {}", fmt::join(names, " and ")),
        "leave it out; a column of the file is named by --map, as restitution_sd=COLUMN");
  }
}

void run_import(ImportFlags flags, const Command& command) {
  const auto format = value_named<ImportFormat>(flags.format);
  if (!format) {
    throw InputError({}, fmt::format("--format {}: there is no such format", quote(flags.format)),
                     "", did_you_mean(flags.format, all_names<ImportFormat>()));
  }
  flags.request.format = *format;
  require_used(command, *format);
  require_writable_folder(flags.request.into);
  const Claim claim(flags.request.into / "points.csv");
  flags.request.provenance = value_named<Provenance>(flags.provenance);
  const ImportResult result = import_points(flags.request);
  print_text("{}", dataset_text(result.dataset));
  for (const ImportNote& note : result.notes) print_text("note: {}\n", note_sentence(note));
  print_text("{}: written\n", flags.request.into.string());
  const std::filesystem::path fit_file = flags.request.into / "fit.toml";
  std::error_code failed;
  if (!std::filesystem::exists(fit_file, failed)) {
    write_whole_file(fit_file,
                     "# Made by recoil import. Every key with its default: recoil help fit-file\n"
                     "dataset = \".\"\n");
  }
  print_text("next:\n  recoil fit {0}\n  recoil diagnose {0}\n", fit_file.string());
}

}  // namespace

void add_import(Program& program) {
  const Command command = program.command(
      "import",
      "make a dataset folder from digitised points, drop heights, bounce times or any table", R"(
Formats: webplotdigitizer (all series as CSV), heights (drop and rebound), intervals (between
bounces), track (heights over time) and csv. --map assigns columns to quantities, with units: um,
mm, cm, m, in; m/s, km/h; s, ms; % (recoil help data). On a terminal, import asks for what is
missing. It overwrites points only with --replace.

  recoil import fig7.csv --format webplotdigitizer --into datasets/mine \
    --axis x=log,1,100 --axis y=linear,0,1 --reading-error 0.5% --like datasets/wall1990-mica
  recoil import drops.csv --format heights --into datasets/ball --diameter 40mm \
    --map drop_height=h1:cm,rebound_height=h2:cm --particle ball.json --surface floor.json
  recoil import bounces.csv --format intervals --into datasets/ball2 --diameter 40mm \
    --map launch=run,interval=t:s --time-error 1ms --like datasets/ball
  recoil import ball.txt --format track --into datasets/ball3 --diameter 40mm \
    --map frame=f,pixel=y --fps 240 --particle nylon --surface concrete
  recoil import table.csv --format csv --into datasets/wall1990-molybdenum --replace \
    --map incident_velocity=Vi:cm/s,rebound_velocity=Vr:cm/s,diameter=D:um,series=run)");
  const auto flags = std::make_shared<ImportFlags>();
  ImportRequest& r = flags->request;
  command.option("FILE", r.file, "what to import; - for standard input").required();
  command
      .option("--format", flags->format,
              fmt::format("one of {}", fmt::join(all_names<ImportFormat>(), ", ")))
      .required();
  command.option("--into", r.into, "the dataset's folder").required();
  command.option("--sheet", r.sheet, "sheet of a workbook (default: the first)");
  command.flag("--replace", r.replace,
               "replace the points of an existing dataset and keep its materials; a reconstruction "
               "becomes digitised");
  command
      .option("--map", r.map,
              "quantity=column:unit, separated by commas; quantity=a+b+c for repeats in several "
              "columns; quantity=100cm for a constant; a unit may have a factor (0.35mm)")
      .repeats();
  command.flag("--decimal-comma", r.decimal_comma, "the decimal mark is a comma (2,5)");
  command
      .option("--sd-of", r.sd_of,
              "whether the stated standard deviations are those of one impact or of the mean of "
              "all events of a point")
      .one_of({"one", "mean"});
  command
      .option("--diameter", r.diameters,
              "diameter of the spheres: 4.9um, or SERIES=4.9um once for each series")
      .repeats();
  command.option("--diameter-error", r.diameter_error,
                 "one standard deviation of the diameters: 1% or 0.1um");
  command.option("--series", r.series, "name of the series if the file has none");
  command.option("--particle", r.particle,
                 "the sphere: a name (recoil materials), a JSON file, or "
                 "material=...,density=...,youngs_modulus=...,poisson_ratio=...");
  command.option("--surface", r.surface,
                 "the surface, in the same form; its density may be left out");
  command.option("--like", r.like, "take the materials of this dataset");
  command.option("--adhesion-energy", r.adhesion_energy,
                 "work of adhesion of the two materials [J/m2]; 0: no adhesion");
  command
      .option("--provenance", flags->provenance,
              "where the points come from: measured, digitised or synthetic (default: that of the "
              "format)")
      .one_of({"measured", "digitised", "synthetic"});
  command.option("--title", r.title, "title of the dataset");
  command
      .option("--source", r.sources, "who measured or published the points; once for each source")
      .repeats();
  command
      .option("--axis", r.axes,
              "axis of a figure: x=log,MIN,MAX or y=linear,MIN,MAX,LENGTHpx; once for each axis")
      .repeats();
  command.option("--reading-error", r.reading_error,
                 "one standard deviation of a reading: 0.5% of an axis, or 2px");
  command
      .option("--error-series", r.error_series,
              "SERIES=UPPER or SERIES=UPPER,LOWER: these series are the ends of the error bars of "
              "SERIES")
      .repeats();
  command.option("--scatter", r.scatter,
                 "scatter of e in addition to the errors of reading: 10%, or 0.02");
  command
      .option("--captured-below", r.captured_below,
              "count a restitution below this as a capture (digitised points, heights)")
      .within(0.0, 1.0);
  command.option("--drop-error", r.drop_error,
                 "one standard deviation of the drop or release height: 1mm or 1%");
  command.option("--rebound-error", r.rebound_error,
                 "one standard deviation of the rebound height");
  command.option("--time-error", r.time_error,
                 "one standard deviation of the time of one bounce: 1ms");
  command.flag("--average", r.average, "make one point of all drops from the same height");
  command.option("--gravity", r.gravity, "gravity [m/s2]").shows_default();
  command
      .option("--ambient-pressure", r.ambient_pressure,
              "air pressure [Pa], to remove the effect of drag from heights and intervals (default "
              "101325); 0: vacuum")
      .within(0.0, limits::pressure.upper);
  command.option("--temperature", r.temperature, "air temperature [K] (default 293)")
      .within(limits::temperature.lower, limits::temperature.upper);
  command.option("--fps", r.fps, "frames per second of a track").within(1e-3, 1e9, "fps");
  command.option("--scale", r.scale,
                 "length of a pixel of a track: 0.4mm (default: the fall under gravity gives it)");
  command
      .option("--method", r.method, "how velocities were measured (default: depends on the format)")
      .one_of({"velocimeter", "drop_heights", "bounce_intervals", "video", "unknown"});
  command
      .option("--condition", r.conditions,
              "condition NAME=VALUE of all points: target_thickness=5mm, relative_humidity=40% "
              "(recoil help data)")
      .repeats();
  command.runs([flags, command] { run_import(*flags, command); });
}

}  // namespace recoil
