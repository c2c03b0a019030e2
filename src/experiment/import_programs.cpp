#include "experiment/import_programs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "core/files.hpp"
#include "data/text.hpp"
#include "experiment/import_table.hpp"
#include "experiment/recording.hpp"

namespace recoil {
namespace {

constexpr std::size_t head_lines = 50;  // among which the header is

/// A run, and the entries of --map for its columns.
struct Run {
  std::string name;
  std::vector<std::string> map;
  std::vector<std::string> words;  ///< for the note
};

std::string in_lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

std::vector<std::size_t> line_starts(std::string_view text, std::size_t most) {
  std::vector<std::size_t> starts;
  for (std::size_t at = 0; at < text.size() && starts.size() < most;) {
    starts.push_back(at);
    at = std::min(text.find('\n', at), text.size() - 1) + 1;
  }
  return starts;
}

/// Blanks what stands in a text of Logger Pro above the names of the columns, and their short names
/// between these and their units.
void blank_vernier_preamble(std::string& text) {
  if (!text.starts_with("Vernier Format")) return;
  const std::vector<std::size_t> starts = line_starts(text, 7);
  const auto blank = [&](std::size_t line) {
    const auto end =
        std::find(text.begin() + static_cast<std::ptrdiff_t>(starts[line]), text.end(), '\n');
    std::fill(text.begin() + static_cast<std::ptrdiff_t>(starts[line]), end, ' ');
  };
  const auto words = [&](std::size_t line) {
    const std::string_view rest = std::string_view(text).substr(starts[line]);
    const std::string_view content = trimmed(rest.substr(0, rest.find('\n')));
    return content.empty() ? 0 : 1 + std::ranges::count(content, '\t');
  };
  if (starts.size() < 7) return;
  for (std::size_t line = 0; line < 3; ++line) blank(line);
  const bool short_names = words(4) > 0 && words(4) == words(3) && words(5) == words(3) &&
                           !parse_number(trimmed(std::string_view(text).substr(
                               starts[5], text.find_first_of("\t\n", starts[5]) - starts[5])));
  if (short_names) blank(4);
}

/// The rows from the header on; empty if there is none.
std::vector<CsvRow> head_of(const ImportRequest& request) {
  ImportRequest first = request;
  const std::vector<std::size_t> starts = line_starts(*request.text, head_lines + 1);
  first.text =
      request.text->substr(0, starts.size() > head_lines ? starts.back() : std::string::npos);
  std::vector<ImportNote> unused;
  std::vector<CsvRow> rows;
  try {
    rows = import_rows(first, unused);
  } catch (const InputError&) {
    return {};  // the reader says why
  }
  const auto filled = [](const CsvRow& row) {
    return std::ranges::count_if(row, [](const CsvField& cell) { return !cell.text.empty(); });
  };
  while (rows.size() > 1 && filled(rows.front()) == 1 && filled(rows[1]) > 1) {
    rows.erase(rows.begin());
  }
  return rows;
}

/// True for "Bounce 3 (s)" or "Stop 3 (s)": a time in an export of phyphox.
bool is_bounce(std::string_view name) {
  if (name == "Start (s)") return true;
  for (const std::string_view word : {"Bounce ", "Stop "}) {
    if (!name.starts_with(word) || !name.ends_with(" (s)")) continue;
    const std::string_view number = name.substr(word.size(), name.size() - word.size() - 4);
    return !number.empty() && number.find_first_not_of("0123456789") == number.npos;
  }
  return false;
}

/// The columns of times in an export of phyphox. Cells of impacts that were not heard are emptied.
std::vector<Run> phyphox_runs(ImportRequest& request, std::vector<CsvRow> rows) {
  std::vector<std::size_t> at;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < rows.front().size(); ++i) {
    const std::string& name = rows.front()[i].text;
    if (name == "Event time (s)")
      return {{"", {fmt::format("time=\"{}\"", name)}, {"time = " + name}}};
    if (!is_bounce(name)) continue;
    at.push_back(i);
    names.push_back(name);
  }
  if (names.size() < 3 || rows.size() > head_lines) return {};
  const NumberFormat format = number_format(request);
  std::string text;
  int line = 1;
  for (CsvRow& row : rows) {
    for (; line < row.front().line; ++line) text += '\n';
    for (const std::size_t i : at) {
      if (i < row.size() && parse_number(row[i].text, format) == 0.0) row[i].text.clear();
    }
    for (std::size_t i = 0; i < row.size(); ++i) {
      std::string cell = row[i].text;
      replace_all(cell, "\"", "\"\"");
      text += fmt::format("{}\"{}\"", i == 0 ? "" : "\t", cell);
    }
  }
  request.text = text + '\n';
  const std::string all = fmt::format("{}", fmt::join(names, "+"));
  return {{"", {"time=\"" + all + '"'}, {"time = " + all}}};
}

/// The columns of time and height of each run.
std::vector<Run> track_runs(const std::vector<CsvRow>& rows) {
  static const std::set<std::string> times = {"t", "time"};
  static const std::set<std::string> heights = {"y",        "height",     "position",
                                                "distance", "y position", "vertical position"};
  struct Columns {
    std::string run, time, height;
  };
  std::vector<Columns> found;
  for (const CsvField& cell : rows.front()) {
    const std::size_t colon = cell.text.find(':');
    const std::string run(colon == std::string::npos ? "" : cell.text.substr(0, colon));
    const std::string_view rest =
        std::string_view(cell.text).substr(colon == std::string::npos ? 0 : colon + 1);
    const std::string name = in_lower_case(trimmed(rest.substr(0, rest.find_first_of("(["))));
    auto its = std::ranges::find(found, run, &Columns::run);
    if (its == found.end()) its = found.insert(found.end(), {run, "", ""});
    if (times.contains(name) && its->time.empty()) its->time = cell.text;
    if (heights.contains(name) && its->height.empty()) its->height = cell.text;
  }
  const bool units = rows.size() > 1 && std::ranges::none_of(rows[1], [](const CsvField& cell) {
                       return parse_number(cell.text).has_value();
                     });
  std::vector<Run> runs;
  for (const Columns& one : found) {
    if (one.time.empty() || one.height.empty()) continue;
    const bool tracker = one.time == "t" && one.height == "y" && !units;
    runs.push_back({one.run,
                    {fmt::format("time=\"{}\"{}", one.time, tracker ? ":s" : ""),
                     fmt::format("height=\"{}\"{}", one.height, tracker ? ":m" : "")},
                    {fmt::format("time = {}{}", one.time, tracker ? " [s]" : ""),
                     fmt::format("height = {}{}", one.height, tracker ? " [m]" : "")}});
  }
  return runs;
}

/// The runs of a file; none if its columns are not known, or if the user names others.
std::vector<Run> runs_of(ImportRequest& request) {
  const bool track = request.format == ImportFormat::track;
  if (!track && request.format != ImportFormat::intervals) return {};
  static const std::set<std::string> those = {"time", "interval", "frame", "height", "pixel"};
  for (const std::string& entry : split_lists(request.map)) {
    const auto pair = split_pair(entry);
    if (pair && those.contains(pair->first)) return {};
  }
  blank_vernier_preamble(*request.text);
  const std::vector<CsvRow> rows = head_of(request);
  if (rows.empty()) return {};
  return track ? track_runs(rows) : phyphox_runs(request, rows);
}

/// Makes a table of the instants of a recording, with their error unless the request states one.
void listen(ImportRequest& request, std::vector<ImportNote>& notes) {
  const HeardImpacts heard =
      hear_impacts(request.text ? *request.text : read_bytes(request.file), request.file.string());
  request.text = heard.table;
  request.map.emplace_back("time=time:s");
  ImportNote note{ImportRemark::impacts_heard, {}, heard.count};
  note.time_sd = heard.time_sd;
  notes.push_back(note);
  if (request.time_error.empty()) request.time_error = fmt::format("{:.9g}s", heard.time_sd);
}

}  // namespace

std::vector<ImportPart> import_parts(const ImportRequest& request, std::vector<ImportNote>& notes) {
  std::vector<std::filesystem::path> files = {request.file};
  files.insert(files.end(), request.more_files.begin(), request.more_files.end());
  std::vector<ImportPart> parts;
  for (const std::filesystem::path& file : files) {
    ImportRequest one = request;
    one.file = file;
    one.more_files.clear();
    if (one.format == ImportFormat::recording) listen(one, notes);
    if (!one.text) one.text = table_text(one, notes);
    const std::string name = files.size() > 1 ? file.stem().string() : "";
    const std::vector<Run> runs = runs_of(one);
    for (const Run& run : runs) {
      ImportPart part{one, name};
      part.request.map.insert(part.request.map.end(), run.map.begin(), run.map.end());
      if (runs.size() > 1) part.launch += (name.empty() ? "" : "/") + run.name;
      parts.push_back(std::move(part));
      notes.push_back({ImportRemark::columns_known, run.words});
    }
    if (runs.empty()) parts.push_back({std::move(one), name});
  }
  if (parts.size() == 1) return parts;
  // They are launches of one ball.
  for (ImportPart& part : parts) {
    if (part.request.series.empty()) part.request.series = default_series(request);
  }
  return parts;
}

}  // namespace recoil
