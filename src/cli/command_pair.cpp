#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "cli/commands.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "core/units.hpp"
#include "data/datapackage.hpp"
#include "data/dataset.hpp"
#include "experiment/averages.hpp"
#include "experiment/pairing.hpp"
#include "experiment/pairing_files.hpp"
#include "experiment/passages.hpp"
#include "report/pairing_report.hpp"
#include "report/result_json.hpp"
#include "report/words_dataset.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

struct PairCommand {
  std::string events;
  std::string out;
  std::string into;
  std::string like;
  std::string provenance;
  std::string histograms;
  std::string impacts;
  std::vector<std::string> units;
  std::vector<std::string> columns;
  std::string positive = "towards";
  bool replace = false;
  bool json = false;
  PairArguments arguments;
};

/// Parses FIELD=VALUE pairs of the command line.
std::map<std::string, std::string> assignments(const std::vector<std::string>& words,
                                               const std::string& option) {
  std::map<std::string, std::string> result;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == word.size()) {
      throw InputError({}, fmt::format("{} {} is not of the form FIELD=VALUE", option, word), "",
                       fmt::format("write for example {} velocity={}", option,
                                   option == "--unit" ? "m/s" : "LDA1"));
    }
    if (!result.emplace(word.substr(0, equals), word.substr(equals + 1)).second) {
      throw InputError({}, fmt::format("{} {} is given twice", option, word.substr(0, equals)), "",
                       "remove one");
    }
  }
  return result;
}

void require_ascending(const std::vector<double>& edges) {
  const char* const advice = "write for example --size-edges 20,40,60,110";
  if (std::adjacent_find(edges.begin(), edges.end(), std::greater_equal<>()) != edges.end()) {
    throw InputError({}, "--size-edges are not in ascending order", "", advice);
  }
  if (edges.size() == 1) {
    throw InputError({}, "--size-edges has one value only", "a size class needs two limits",
                     advice);
  }
}

/// The provenance from the option or the package of the passages; empty if neither states it.
std::optional<Provenance> stated_provenance(const PairCommand& command, const PassageTable& table) {
  const auto stated = value_named<Provenance>(command.provenance);
  if (stated && table.provenance && *stated != *table.provenance) {
    throw InputError(
        {},
        fmt::format("--provenance {}, but datapackage.json beside the passages states {}",
                    command.provenance, to_string(*table.provenance)),
        "", "correct one of them");
  }
  return stated ? stated : table.provenance;
}

/// The provenance of a dataset to be written. @throws InputError if it is not known
Provenance provenance_of(const PairCommand& command, const PassageTable& table) {
  const auto provenance = stated_provenance(command, table);
  if (!provenance) {
    throw InputError({}, "the provenance of the passages is not known", "every dataset states it",
                     "give --provenance measured, or synthetic for simulated passages");
  }
  return *provenance;
}

/// True if the dataset gets a size distribution, which size classes do not need.
bool has_mixed_sizes(const PairCommand& command) {
  return command.arguments.size_edges.size() <= 2 && command.arguments.size_classes == 1;
}

void add_dataset(const PairCommand& command, const PassageTable& table, const PairingResult& pairs,
                 const std::string& points, std::vector<WholeFile>& files) {
  const bool mixed = has_mixed_sizes(command);
  Json system = stated_system(command.like);
  const std::vector<LeftOverride> left_out = leave_out_contradictions(system);
  const std::string package = package_json(
      system, fs::absolute(command.into).lexically_normal().filename(),
      provenance_of(command, table), fs::path(table.file).filename().string(),
      fmt::format("{} impacts that recoil pair found in {} passages; the measuring plane {:.5g} mm "
                  "above the surface; velocities at the surface.",
                  pairs.impacts.size(), table.passages.size(), pairs.height / units::mm),
      mixed ? pairs.height : 0.0);
  parse_dataset(package, points, command.into);  // throws if the dataset is not valid
  const fs::path folder = command.into;
  files.push_back({folder / "points.csv", points});
  if (mixed) files.push_back({folder / "sizes.csv", sizes_csv(distributions(table, pairs))});
  files.push_back({folder / package_file_name, package});
  if (!left_out.empty()) {
    print_text(command.json ? stderr : stdout, "note: {}\n", left_out_sentence(left_out));
  }
}

/// The files whose names are known in advance.
std::vector<fs::path> outputs_of(const PairCommand& command) {
  std::vector<fs::path> files;
  const fs::path folder = command.into;
  if (!command.into.empty()) files = {folder / "points.csv", folder / package_file_name};
  if (!command.into.empty() && has_mixed_sizes(command)) files.push_back(folder / "sizes.csv");
  if (!command.out.empty()) files.push_back(command.out);
  if (!command.impacts.empty()) files.push_back(command.impacts);
  return files;
}

void run_pair(const PairCommand& command) {
  require_ascending(command.arguments.size_edges);
  for (const std::string& folder : {command.into, command.histograms}) {
    if (!folder.empty()) require_writable_folder(folder);
  }
  for (const std::string& file : {command.out, command.impacts}) {
    if (file.empty()) continue;
    require_writable_folder(fs::absolute(file).parent_path());
  }
  const PassageTable table = read_passages(
      command.events, {assignments(command.units, "--unit"),
                       assignments(command.columns, "--column"), command.positive == "away"});
  if (!command.into.empty()) provenance_of(command, table);  // throws before the computation
  const std::vector<fs::path> outputs = outputs_of(command);
  const Replacing replacing = command.replace ? Replacing::data : Replacing::results;
  require_free(outputs, replacing);
  std::optional<Claim> claim;
  if (!outputs.empty()) claim.emplace(outputs.front());
  const PairRequest request = command.arguments.request(command.events);
  const PairedPassages paired = pair_and_average(table, request);
  const PairingResult& pairs = paired.pairs;
  const Averages& averages = paired.averages;
  if (!command.json) print_text("{}", pairing_text(table, pairs, averages));
  require_impacts(paired, request);
  if (command.json) print_text("{}", pairing_json(table, pairs, averages));
  const std::string points = points_csv(averages);
  std::vector<WholeFile> files;
  if (!command.into.empty()) add_dataset(command, table, pairs, points, files);
  if (!command.out.empty()) files.push_back({command.out, points});
  if (!command.impacts.empty()) files.push_back({command.impacts, impacts_csv(table, pairs)});
  if (!command.histograms.empty()) {
    for (const auto& [name, text] : histogram_files(distributions(table, pairs))) {
      files.push_back({fs::path(command.histograms) / name, text});
    }
  }
  write_whole_files(files, replacing);
}

void add_input_options(const Command& app, PairCommand& command) {
  app.option("PASSAGES", command.events,
             "CSV file, one row per passage: time, velocity, diameter; optional "
             "tangential_velocity and series (a run; times of different runs are not compared)")
      .required();
  app.option("--unit", command.units,
             "FIELD=UNIT, e.g. time=ms velocity=m/s diameter=um; not needed where datapackage.json "
             "beside the file states the units")
      .list();
  app.option("--column", command.columns,
             "FIELD=NAME, for files with other column names, e.g. velocity=LDA1")
      .list();
  app.option("--positive", command.positive,
             "the direction in which velocities are positive: towards the surface or away from it")
      .shows_default()
      .one_of({"towards", "away"});
}

void add_search_options(const Command& app, PairCommand& command) {
  app.option("--height", command.arguments.height,
             "first estimate of the height of the measuring plane above the surface [mm]")
      .shows_default()
      .within(1e-3, 1e3);
  app.option("--height-range", command.arguments.height_range,
             "the true height lies within this factor of the first estimate")
      .shows_default()
      .within(1.01, 10.0);
  app.flag("--keep-height", command.arguments.keep_height, "use --height unchanged");
  app.option("--diameter-tolerance", command.arguments.diameter_tolerance,
             "largest relative difference of the two diameters of one sphere; the data set the "
             "limit below this")
      .shows_default()
      .within(1e-3, 2.0);
  app.option("--velocity-tolerance", command.arguments.velocity_tolerance,
             "largest relative difference between a rebound and its return; the data set the limit "
             "below this")
      .shows_default()
      .within(1e-3, 0.5);
}

void add_selection_options(const Command& app, PairCommand& command) {
  app.flag("--keep-later", command.arguments.keep_later, "use second and third impacts as well");
  app.option("--threshold", command.arguments.threshold,
             "leave out incident velocities below this [m/s, at the plane], as the paper does to "
             "remove second impacts; recoil prints the effect")
      .within(0.0, 1e4);
  app.option("--angle", command.arguments.angle,
             "use only rebounds within this angle of the normal [degrees]; the paper uses 8; needs "
             "tangential_velocity")
      .within(0.0, 90.0);
  app.option("--lost-share", command.arguments.lost_share,
             "share of rebounds that the instrument misses (default: the share that it misses on "
             "their way down)")
      .within(0.0, 0.9);
}

void add_output_options(const Command& app, PairCommand& command) {
  app.option("--out", command.out, "write the points here (CSV)");
  Option into = app.option("--into", command.into,
                           "write a dataset folder: points, datapackage.json and, unless there are "
                           "size classes, sizes.csv");
  Option like = app.option("--like", command.like, "take the materials of this dataset folder");
  into.needs(like);
  like.needs(into);
  app.option("--provenance", command.provenance,
             "where the passages come from, if no datapackage.json beside them states it")
      .one_of(all_names<Provenance>());
  app.option("--per-bin", command.arguments.per_bin, "approximate number of impacts in one point")
      .shows_default()
      .within(2, 1000000);
  const Option classes =
      app.option("--size-classes", command.arguments.size_classes,
                 "number of size classes with equally many spheres, each a series of points")
          .shows_default()
          .within(1, 100);
  app.option(
         "--size-edges", command.arguments.size_edges,
         "limits of the size classes [um], e.g. 20,40,60,110; spheres outside them are left out")
      .list()
      .excludes(classes)
      .within(1e-3, 1e6, "diameter");
  app.option("--impacts", command.impacts,
             "write all impacts and all unpaired passages here (CSV)");
  app.flag("--mean-diameter", command.arguments.mean_diameter,
           "use the mean diameter of all spheres of a series and size class (d10, as in the paper) "
           "instead of the mean of each point");
  app.option("--histograms", command.histograms,
             "write histograms and size distributions (CSV) into this folder");
  app.flag("--replace", command.replace, "replace an existing points.csv or dataset");
  add_json_flag(app, command.json);
}

}  // namespace

void add_pair(Program& program) {
  const Command app = program.command("pair",
                                      "find impacts in the passages that a phase Doppler "
                                      "instrument records, and average them into points",
                                      R"(
A sphere crosses the measuring plane on its way down and, if it rebounds, on its way up. The
time between is the time of free flight to the surface and back; both velocities and the
height of the plane determine it. recoil finds the height at which most passages agree, then
pairs passages by flight time and diameter, each with at most one other. Rebounds that come
down again are later impacts and are left out. Velocities are corrected to the surface,
v_s^2 = v_p^2 + 2 g h, and averaged over about 40 impacts. recoil estimates how many of the
passages without a rebound were lost, were too slow to return, and were captured.

  recoil pair run7.csv --unit time=s,velocity=m/s,diameter=um --out points.csv
  recoil pair run7.csv --height 1.2 --size-edges 20,40,60,110 --angle 8 \
      --into my-run --like datasets/li1999-sst65-silicon --provenance measured \
      --histograms my-run/histograms
  recoil check my-run)");
  const auto command = std::make_shared<PairCommand>();
  add_input_options(app, *command);
  add_search_options(app, *command);
  add_selection_options(app, *command);
  add_output_options(app, *command);
  app.runs([command] { run_pair(*command); });
}

}  // namespace recoil
