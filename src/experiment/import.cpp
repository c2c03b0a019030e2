#include "experiment/import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "core/files.hpp"
#include "data/contact.hpp"
#include "data/text.hpp"
#include "experiment/import_formats.hpp"
#include "experiment/import_programs.hpp"
#include "experiment/import_table.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

/// Takes the magnitudes of signed velocities: all incident ones have one sign, all rebound ones the
/// other.
void drop_signs(const ImportTable& table, ImportedPoints& out) {
  const auto any = [&](Quantity quantity, double sign) {
    return std::ranges::any_of(out.points, [&](const ImportedPoint& point) {
      return sign * point.value[quantity].value_or(0.0) > 0.0;
    });
  };
  const bool in_below = any(Quantity::incident_velocity, -1.0);
  const bool out_below = any(Quantity::rebound_velocity, -1.0);
  if (!in_below && !out_below) return;
  if ((in_below && any(Quantity::incident_velocity, 1.0)) ||
      (out_below && any(Quantity::rebound_velocity, 1.0)) || (in_below && out_below)) {
    table.fail(0, in_below ? "incident_velocity" : "rebound_velocity",
               "the signs of the velocities are mixed",
               "an impact comes in with one sign and leaves with the other",
               "correct them, or give magnitudes");
  }
  for (ImportedPoint& point : out.points) {
    for (const Quantity quantity : {Quantity::incident_velocity, Quantity::rebound_velocity}) {
      auto& value = point.value[quantity];
      if (value) value = std::abs(*value);
    }
  }
  out.notes.push_back({ImportRemark::signed_velocities});
}

/// Converts standard deviations of single impacts to those of means.
/// @throws InputError if it is not known which of the two they are
void resolve_deviations(const ImportRequest& request, const ImportTable& table,
                        std::vector<ImportedPoint>& points) {
  for (const Quantity quantity : {Quantity::restitution_sd, Quantity::velocity_sd}) {
    const bool of_means = request.sd_of.empty() && table.is_named(to_string(quantity));
    if (of_means || request.sd_of == "mean") continue;
    for (ImportedPoint& point : points) {
      auto& sd = point.value[quantity];
      double count = point.value[Quantity::events].value_or(1.0);
      if (quantity == Quantity::restitution_sd) {
        count -= point.value[Quantity::captured].value_or(0.0);
      }
      if (!sd || !(count > 1.0)) continue;
      if (request.sd_of == "one") {
        sd = *sd / std::sqrt(count);
        continue;
      }
      throw InputError(
          {request.file.string(), point.line, 1},
          fmt::format("{} of {:g} impacts: is it that of one impact or of their mean?",
                      name_of(quantity), count),
          fmt::format("the two differ by sqrt({:g})", count),
          "state it with --sd-of one or --sd-of mean (a standard error is that of the mean)");
    }
  }
}

/// How many impacts of a row did not rebound: a number, or a word for all or none of them.
std::optional<double> captured_in(const ImportTable& table, std::size_t row) {
  static const std::set<std::string> all = {"yes",   "y",        "true",    "x",        "stuck",
                                            "stick", "sticks",   "capture", "ja",       "haftet",
                                            "oui",   "captured", "adhered", "deposited"};
  static const std::set<std::string> none = {"no",   "n",       "false",     "nein",     "non",
                                             "free", "rebound", "rebounded", "rebounds", "bounced"};
  if (table.lacks(row, "captured")) return std::nullopt;
  const std::string text = table.text(row, "captured");
  const std::string word = plain_word(text);
  if (all.contains(word)) return table.value(row, "events").value_or(1.0);
  if (none.contains(word)) return 0.0;
  if (!word.empty() && std::isalpha(static_cast<unsigned char>(word.front())) != 0) {
    table.fail(row, "captured", fmt::format("{} does not say whether spheres stuck", quote(text)),
               "a word or their number is known", "write their number, or yes or no");
  }
  return table.value(row, "captured");
}

/// Reads any table whose quantities are those of a dataset.
/// @param units of the columns of the replaced dataset
ImportedPoints read_columns(const ImportRequest& request, const FieldUnits& units) {
  std::vector<ImportQuantity> known;
  for (const Quantity quantity : values_of<Quantity>()) {
    known.push_back(
        {to_string(quantity), dimension_of(quantity), quantity == Quantity::incident_velocity});
  }
  ImportTable table(request, known, units);
  const bool counts = table.has("events") && table.has("captured");
  const bool direct = table.has("restitution");
  const bool speed = table.has("rebound_velocity");
  if (direct ? speed : !speed && !counts) {
    throw InputError(
        {request.file.string(), 1, 1},
        direct ? "both restitution and rebound_velocity are there" : "which column is the rebound?",
        direct ? "they could contradict each other" : "",
        "name one with --map restitution=COLUMN or rebound_velocity=COLUMN:m/s");
  }
  if (table.has("tangential_restitution") && !table.has("incidence_angle")) {
    table.fail(0, "tangential_restitution", "a tangential restitution without an incidence angle",
               "the angle gives the tangential velocity",
               "name the angle from the normal with --map incidence_angle=COLUMN:deg");
  }
  std::vector<std::pair<Quantity, std::string>> numbers;
  for (const ImportQuantity& quantity : known) {
    if (quantity.dimension == Dimension::text) continue;
    if (!table.has(quantity.name) && !table.has_beside(quantity.name)) continue;
    numbers.emplace_back(*value_named<Quantity>(quantity.name), quantity.name);
  }
  ImportedPoints out;
  out.points.reserve(table.size());
  std::map<std::string, bool> sized_series;
  std::vector<std::string> perhaps_stuck;
  for (std::size_t r = 0; r < table.size(); ++r) {
    ImportedPoint point;
    point.line = table.line(r);
    point.series = table.name(r, "series");
    point.setting = table.text(r, "setting");
    point.launch = table.text(r, "launch");
    for (const auto& [quantity, name] : numbers) {
      point.value[quantity] =
          quantity == Quantity::captured ? captured_in(table, r) : table.value(r, name);
    }
    const bool rebound = (direct && !table.lacks(r, "restitution")) ||
                         (speed && !table.lacks(r, "rebound_velocity")) ||
                         (counts && !table.lacks(r, "events") && !table.lacks(r, "captured"));
    bool sized = !table.lacks(r, "diameter");
    if (!sized) {
      const auto [own, is_new] = sized_series.try_emplace(point.series);
      if (is_new) own->second = known_diameter(request, point.series, {}).has_value();
      sized = own->second;
    }
    const bool placed =
        !table.lacks(r, "incident_velocity") && !table.lacks(r, "incidence_angle") && sized;
    const bool answered = rebound || point.value[Quantity::captured].value_or(0.0) > 0.0;
    if (!placed || !answered) {
      table.leave_out(r);
      if (placed && !table.has("captured")) {
        perhaps_stuck.push_back(fmt::format("line {}", point.line));
      }
      continue;
    }
    out.points.push_back(std::move(point));
  }
  out.notes = table.notes();
  if (!perhaps_stuck.empty()) {
    out.notes.push_back({ImportRemark::rebounds_empty, perhaps_stuck, perhaps_stuck.size()});
  }
  drop_signs(table, out);
  resolve_deviations(request, table, out.points);
  const std::vector<std::string> unused = table.unused();
  if (!unused.empty()) out.notes.push_back({ImportRemark::columns_not_used, unused});
  return out;
}

ImportedPoints read_points_of(const ImportRequest& request, const Json& system,
                              const FieldUnits& units) {
  switch (request.format) {
    case ImportFormat::webplotdigitizer:
      return read_digitised(request);
    case ImportFormat::heights:
      return read_heights(request, sphere_in_air(system));
    case ImportFormat::intervals:
    case ImportFormat::recording:
      return read_intervals(request, sphere_in_air(system));
    case ImportFormat::track:
      return read_track(request, sphere_in_air(system));
    case ImportFormat::rest:
      return read_rest(request, sphere_in_air(system));
    case ImportFormat::tops:
      return read_tops(request, sphere_in_air(system));
    case ImportFormat::blocks:
      return read_blocks(request, sphere_in_air(system));
    case ImportFormat::csv:
      break;
  }
  return read_columns(request, units);
}

/// Joins a note with an earlier one of the same kind.
void join_note(const ImportNote& note, ImportNote& earlier) {
  for (const std::string& name : note.names) {
    if (std::ranges::find(earlier.names, name) == earlier.names.end()) {
      earlier.names.push_back(name);
    }
  }
  earlier.count += note.count;
  earlier.releases.insert(earlier.releases.end(), note.releases.begin(), note.releases.end());
  AirShare& air = earlier.air;
  if (note.air.slow < air.slow) {
    std::tie(air.slow, air.slow_share) = std::pair(note.air.slow, note.air.slow_share);
  }
  if (note.air.fast > air.fast) {
    std::tie(air.fast, air.fast_share) = std::pair(note.air.fast, note.air.fast_share);
  }
  air.reynolds = std::max(air.reynolds, note.air.reynolds);
}

}  // namespace

ImportedPoints read_parts(const std::vector<ImportPart>& parts, const Json& system,
                          const FieldUnits& units) {
  ImportedPoints all;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    ImportedPoints own = read_points_of(parts[k].request, system, units);
    if (parts.size() == 1) return own;
    const bool one_launch = std::ranges::all_of(own.points, [&](const ImportedPoint& point) {
      return point.launch == own.points.front().launch;
    });
    for (ImportedPoint& point : own.points) {
      point.part = k;
      const bool timed = !point.launch.empty();
      if (timed) point.launch = parts[k].launch + (one_launch ? "" : "/" + point.launch);
    }
    std::ranges::move(own.points, std::back_inserter(all.points));
    for (ImportNote& note : own.notes) {
      const auto earlier = std::ranges::find(all.notes, note.remark, &ImportNote::remark);
      if (earlier == all.notes.end()) {
        all.notes.push_back(std::move(note));
      } else {
        join_note(note, *earlier);
      }
    }
  }
  return all;
}

namespace {

/// Adds the scatter of the experiment to the errors of the readings.
void add_scatter(const ImportRequest& request, std::vector<ImportedPoint>& points) {
  const StatedError scatter = stated_error(request.scatter, Dimension::ratio, "1", "--scatter");
  if (!scatter.stated()) return;
  for (ImportedPoint& point : points) {
    const auto e = point.restitution();
    if (!e) continue;
    auto& error = point.value[Quantity::restitution_sd];
    const double sd = std::hypot(error.value_or(0.0), scatter.of(*e));
    if (sd > 0.0) error = sd;
  }
}

/// Refuses points of which more than half return faster than they came, and leaves out single
/// impossible impacts of flights.
void require_possible(const ImportRequest& request, ImportedPoints& imported) {
  constexpr double most = limits::restitution.upper;
  std::vector<const ImportedPoint*> above;
  std::size_t impossible = 0;
  for (const ImportedPoint& point : imported.points) {
    const double e = point.restitution().value_or(0.0);
    if (e > 1.0) above.push_back(&point);
    if (e > most) ++impossible;
  }
  const bool flights =
      request.format != ImportFormat::csv && request.format != ImportFormat::webplotdigitizer;
  if (!flights && impossible > 0) return;  // refused with its unit later
  if (above.size() > 1 && 2 * above.size() > imported.points.size()) {
    std::string how = "check the columns in --map, their units and the axes";
    if (request.format == ImportFormat::heights) {
      how = "exchange drop_height and rebound_height in --map, or check their units";
    } else if (request.format == ImportFormat::intervals) {
      how =
          "state with --map launch=COLUMN which rows belong together; --transpose reads launches "
          "that are in columns";
    } else if (request.format == ImportFormat::track) {
      how =
          "check the times (a film that shows pictures twice has too many) and leave out what was "
          "held";
    }
    throw InputError({request.file.string(), above.front()->line, 1},
                     fmt::format("restitution is above 1 in {} of {} points", above.size(),
                                 imported.points.size()),
                     "a ball returns no faster than it came, apart from errors", how);
  }
  if (impossible == 0 || 2 * impossible > imported.points.size()) return;
  ImportNote note{ImportRemark::impossible_left_out};
  std::erase_if(imported.points, [&](const ImportedPoint& point) {
    const double e = point.restitution().value_or(0.0);
    if (e <= most) return false;
    note.names.push_back(fmt::format("line {} (e = {:.3g})", point.line, e));
    return true;
  });
  imported.notes.push_back(note);
}

/// Throws `error`, which is about the dataset to be written, with the line of the imported file
/// instead.
[[noreturn]] void fail_in_source(const InputError& error, const std::vector<ImportPart>& parts,
                                 const fs::path& points_file,
                                 const std::vector<ImportedPoint>& points) {
  const Location& at = error.where();
  const auto file_of = [&](std::size_t part) { return parts[part].request.file.string(); };
  // Errors of materials have no place in the imported file.
  Location place{at.file == points_file.string() ? file_of(0) : std::string()};
  const auto row = static_cast<std::size_t>(at.line) - 2;
  if (at.file == points_file.string() && at.line >= 2 && row < points.size()) {
    place.file = file_of(points[row].part);
    place.line = points[row].line;
    place.column = 1;
  }
  throw InputError(place, error.problem(), error.why(), error.suggestion());
}

void refuse_existing(const ImportRequest& request) {
  std::error_code failed;
  if (fs::exists(request.into, failed) && !fs::is_directory(request.into, failed)) {
    throw InputError({request.into.string()}, "this is a file, not a folder",
                     "a dataset is a folder", "choose another --into");
  }
  if (request.replace) return;
  for (const char* name : {package_file_name, "points.csv"}) {
    if (!fs::exists(request.into / name, failed)) continue;
    throw InputError({(request.into / name).string()}, "there is a dataset here already", "",
                     "add --replace to replace its points, or choose another --into");
  }
}

/// Refuses points of the reconstruction that is to be replaced: they are not digitised.
void refuse_reconstructed_points(const ImportRequest& request, const Dataset& imported) {
  const Dataset before = load_dataset(request.into);
  const auto known = [&](const ImpactPoint& point) {
    return std::ranges::any_of(before.points, [&](const ImpactPoint& old) {
      return std::abs(old.incident_velocity / point.incident_velocity - 1.0) < 1e-9 &&
             std::abs(old.restitution - point.restitution) < 1e-9 &&
             std::abs(old.diameter / point.diameter - 1.0) < 1e-9;
    });
  };
  const auto same = std::ranges::count_if(imported.points, known);
  if (2 * static_cast<std::size_t>(same) <= imported.points.size()) return;
  throw InputError(
      {request.file.string()},
      fmt::format("{} of {} points are those of the reconstruction", same, imported.points.size()),
      "a recipe made them; they were not measured or digitised",
      "import points of an experiment, or give --provenance synthetic");
}

/// Renames the recipe of a former reconstruction, which no longer belongs to the points.
void set_recipe_aside(const fs::path& folder, std::vector<ImportNote>& notes) {
  std::error_code failed;
  if (!fs::exists(folder / recipe_name, failed)) return;
  fs::rename(folder / recipe_name, folder / set_aside_recipe_name, failed);
  if (failed) {
    throw InputError({(folder / recipe_name).string()}, "the recipe cannot be renamed",
                     failed.message(), "rename it by hand, since the points are no longer its own");
  }
  notes.push_back({ImportRemark::recipe_set_aside});
}

/// True if the dataset states no adhesion and it is negligible in every point: the diameter is at
/// least 1 mm, and the work of separation of Johnson, Kendall & Roberts (1971), 7.09 (W^5 R^4 /
/// E*^2)^(1/3), with Gilman's estimate of W, is below 1e-6 of the incident energy m V^2 / 2.
bool adhesion_is_negligible(const ImportRequest& request, const Json& system,
                            const Dataset& dataset) {
  constexpr double smallest_ball = 1e-3;  // [m]
  constexpr double negligible = 1e-6;
  if (request.adhesion_energy || system.contains("adhesion_energy") ||
      system.contains("adhesion_force_f0") || system["particle"].contains("surface_energy") ||
      system["surface"].contains("surface_energy")) {
    return false;
  }
  return std::ranges::all_of(dataset.points, [&](const ImpactPoint& point) {
    if (point.diameter < smallest_ball || point.all_captured()) return false;
    const ContactProperties contact = derive_contact(dataset.system, point.diameter);
    const auto [diameter, density] =
        contact.as_one_sphere(point.diameter, dataset.system.particle.density);
    const double modulus = 0.75 * contact.stiffness;
    const double work = 7.09 * std::cbrt(std::pow(contact.adhesion_energy, 5) *
                                         std::pow(0.5 * diameter, 4) / (modulus * modulus));
    const double velocity = point.incident_velocity;
    return work < negligible * 0.5 * sphere_mass(diameter, density) * velocity * velocity;
  });
}

/// The point of the summary. @param series index
ImpactPoint summarised(const ImportedPoint& imported, std::size_t series) {
  ImpactPoint point;
  point.series = series;
  point.diameter = imported.value[Quantity::diameter].value_or(0.0);
  point.incident_velocity = imported.value[Quantity::incident_velocity].value_or(0.0);
  point.restitution = imported.restitution().value_or(0.0);
  point.restitution_sd = imported.value[Quantity::restitution_sd];
  point.velocity_sd = imported.value[Quantity::velocity_sd];
  point.setting_velocity_sd = imported.value[Quantity::setting_velocity_sd];
  point.events = static_cast<int>(imported.value[Quantity::events].value_or(1.0));
  point.captured = static_cast<int>(imported.value[Quantity::captured].value_or(0.0));
  point.setting = imported.setting;
  point.launch = imported.launch;
  point.line = imported.line;
  return point;
}

}  // namespace

ImportResult read_bounces(const ImportRequest& asked, double density) {
  ImportRequest request = asked;
  request.particle = fmt::format("material=ball,density={:.17g}", density);
  request.surface = "material=floor";
  ImportResult result;
  const std::vector<ImportPart> parts = import_parts(request, result.notes);
  std::vector<ImportNote> of_package;  // there is no package
  const Json system = imported_system(request, std::nullopt, of_package);
  ImportedPoints imported = read_parts(parts, system, {});
  resolve_diameters(request, imported);
  require_possible(request, imported);
  result.notes.insert(result.notes.end(), imported.notes.begin(), imported.notes.end());
  Dataset& dataset = result.dataset;
  dataset.id = default_series(request);
  dataset.system.method = value_named<Method>(system["method"].get<std::string>()).value();
  for (const ImportedPoint& point : imported.points) {
    auto series = std::ranges::find(dataset.series, point.series);
    if (series == dataset.series.end()) {
      dataset.series.push_back(point.series);
      series = std::prev(dataset.series.end());
    }
    const auto index = static_cast<std::size_t>(series - dataset.series.begin());
    dataset.points.push_back(summarised(point, index));
  }
  return result;
}

ImportResult import_points(const ImportRequest& request) {
  refuse_existing(request);
  std::vector<ImportNote> notes;
  const std::vector<ImportPart> parts = import_parts(request, notes);  // before options are missed
  const auto existing =
      request.replace ? existing_package(request.into) : std::optional<ExistingPackage>();
  const FieldUnits units = existing              ? existing->units
                           : request.usual_units ? usual_units()
                                                 : FieldUnits();
  ImportResult result;
  Json system = imported_system(request, existing, result.notes);
  ImportedPoints imported = read_parts(parts, system, units);
  if (imported.points.empty() && request.format == ImportFormat::track) {
    throw InputError({request.file.string()}, "no impact was found in these tracks",
                     "it needs a minimum with 4 samples of free flight on either side",
                     "check the columns in --map, or film with more frames per second");
  }
  resolve_diameters(request, imported);
  add_scatter(request, imported.points);
  require_possible(request, imported);

  notes.insert(notes.end(), imported.notes.begin(), imported.notes.end());
  result.notes.insert(result.notes.begin(), notes.begin(), notes.end());
  const PointsText points = points_text(imported.points);
  std::string package = imported_package(request, system, points, existing, result.notes);
  const fs::path points_file = request.into / (existing ? existing->points_path : "points.csv");
  try {
    result.dataset = parse_dataset(package, points.csv, request.into);
  } catch (const InputError& error) {
    fail_in_source(error, parts, points_file, imported.points);
  }
  if (adhesion_is_negligible(request, system, result.dataset)) {
    system["adhesion_energy"] = 0.0;
    std::vector<ImportNote> again;
    package = imported_package(request, system, points, existing, again);
    result.dataset.system.adhesion_energy = 0.0;
    result.dataset.sha256 = checksum_of(package, points.csv);
    result.notes.push_back({ImportRemark::adhesion_left_out});
  }
  if (existing && existing->provenance == Provenance::reconstruction &&
      result.dataset.provenance != Provenance::synthetic) {
    refuse_reconstructed_points(request, result.dataset);
  }
  // The points are written first. If the program ends in between, the folder has the old
  // provenance, or, without a package, is no dataset yet.
  require_writable_folder(request.into);
  write_whole_files({{points_file, points.csv}, {request.into / package_file_name, package}},
                    request.replace ? Replacing::data : Replacing::results);
  set_recipe_aside(request.into, result.notes);
  return result;
}

}  // namespace recoil
