#include "experiment/look.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "experiment/import_formats.hpp"
#include "experiment/import_programs.hpp"
#include "experiment/recording.hpp"

namespace recoil {
namespace {

/// What `imported_system` says of spheres of which nothing is known.
const Json& unknown_system() {
  static const Json system = {{"particle", Json::object()}};
  return system;
}

/// The first lines of a text, enough to know its columns.
std::string beginning_of(const std::string& text) {
  constexpr int enough = 40;
  std::size_t at = 0;
  for (int line = 0; line < enough && at < text.size(); ++line) {
    at = std::min(text.find('\n', at), text.size() - 1) + 1;
  }
  return text.substr(0, at);
}

/// Do the first two lines name series, and X and Y of each?
bool is_digitised(const ImportRequest& request) {
  std::vector<ImportNote> notes;
  const std::vector<CsvRow> rows = import_rows(request, notes);
  return rows.size() > 1 && std::ranges::all_of(rows[1], [](const CsvField& cell) {
           return cell.text == "X" || cell.text == "Y";
         });
}

/// What keeps a file from being read in its format; nullopt if nothing does.
std::optional<InputError> refusal(const ImportRequest& request) {
  try {
    std::vector<ImportNote> notes;
    read_parts(import_parts(request, notes), unknown_system(), {});
    return std::nullopt;
  } catch (const InputError& error) {
    return error;
  }
}

}  // namespace

ImportFormat format_of(const ImportRequest& asked) {
  ImportRequest request = asked;
  request.more_files.clear();
  if (!request.text && is_recording(read_bytes(request.file))) return ImportFormat::recording;
  std::vector<ImportNote> notes;
  request.text = beginning_of(request.text ? *request.text : table_text(request, notes));
  if (is_digitised(request)) return ImportFormat::webplotdigitizer;
  std::vector<ImportFormat> fitting;
  std::vector<ImportFormat> lacking;  // an option, not a column
  std::vector<InputError> errors;
  std::map<ImportFormat, InputError> refusals;
  for (const ImportFormat format : values_of<ImportFormat>()) {
    if (format == ImportFormat::webplotdigitizer || format == ImportFormat::recording) continue;
    request.format = format;
    const std::optional<InputError> error = refusal(request);
    if (error) refusals.emplace(format, *error);
    if (!error) {
      fitting.push_back(format);
    } else if (error->where().file.empty()) {
      lacking.push_back(format);
    } else {
      errors.push_back(*error);
    }
  }
  if (fitting.empty()) {
    const InputError& of_any_table = refusals.at(ImportFormat::csv);
    if (std::ranges::all_of(refusals, [&](const auto& refusal) {
          return refusal.second.problem() == of_any_table.problem();
        })) {
      throw InputError(of_any_table);  // no format is the reason
    }
  }
  if (fitting.empty()) fitting = lacking;
  if (std::ranges::find(fitting, ImportFormat::track) != fitting.end()) {
    std::erase(fitting, ImportFormat::intervals);
  }
  if (fitting.size() == 1) return fitting.front();
  std::vector<std::string> names;
  for (const ImportFormat format : fitting) names.emplace_back(to_string(format));
  if (!names.empty()) {
    throw InputError({request.file.string()},
                     fmt::format("this can be {}", fmt::join(names, " or ")),
                     "its columns fit several formats", "state it with --format");
  }
  const auto line_of = [](const InputError& error) { return error.where().line; };
  const auto [first, last] = std::ranges::minmax_element(errors, {}, line_of);
  if (last->where().line > first->where().line) throw InputError(*last);  // in a row of its format
  throw InputError(
      first->where(), "it is not known what this file holds", first->why(),
      "state it with --map, as in --map incident_velocity=COLUMN:m/s,restitution=COLUMN, --map "
      "incident_velocity=COLUMN:m/s,rebound_velocity=COLUMN:m/s or --map "
      "drop_height=COLUMN:cm,rebound_height=COLUMN:cm");
}

FileLook look_at(const ImportRequest& request) {
  FileLook look;
  const std::vector<ImportPart> parts = import_parts(request, look.notes);
  const ImportedPoints read = read_parts(parts, unknown_system(), {});
  look.notes.insert(look.notes.end(), read.notes.begin(), read.notes.end());
  look.points = read.points.size();
  const bool sized = std::ranges::all_of(read.points, [&](const ImportedPoint& point) {
    return known_diameter(request, point.series, point.value[Quantity::diameter]).has_value();
  });
  if (!sized) look.missing.emplace_back("--diameter");
  if (request.like.empty() && request.particle.empty()) look.missing.emplace_back("--particle");
  if (request.like.empty() && request.surface.empty()) look.missing.emplace_back("--surface");
  if (!request.provenance && request.format == ImportFormat::csv) {
    look.missing.emplace_back("--provenance");
  }
  return look;
}

}  // namespace recoil
