#include "experiment/passages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <tuple>

#include "core/error.hpp"
#include "core/files.hpp"
#include "data/csv.hpp"
#include "data/datapackage.hpp"
#include "data/quantity.hpp"
#include "data/text.hpp"
#include "experiment/column_names.hpp"
#include "experiment/import_table.hpp"

namespace recoil {
namespace {

constexpr std::uintmax_t largest_file = 2ULL << 30;  ///< some 5 10^7 passages [bytes]
constexpr std::size_t most_columns = 200;

std::string_view unquoted(std::string_view cell) {
  cell = trimmed(cell);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') {
    cell = cell.substr(1, cell.size() - 2);
  }
  return cell;
}

/// Splits one line into cells. A quoted cell must not contain the delimiter, as in all instruments'
/// files.
void split(std::string_view line, char delimiter, std::vector<std::string_view>& cells) {
  cells.clear();
  while (cells.size() <= most_columns) {
    const std::size_t end = line.find(delimiter);
    cells.push_back(unquoted(line.substr(0, end)));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
  }
}

struct Field {
  std::string_view name;
  Dimension dimension;
  bool needed;
  double Passage::*place;  ///< null for the series, which is a text
};
constexpr std::array<Field, 5> fields = {{
    {"time", Dimension::time, true, &Passage::time},
    {"velocity", Dimension::velocity, true, &Passage::velocity},
    {"tangential_velocity", Dimension::velocity, false, &Passage::tangential},
    {"diameter", Dimension::length, true, &Passage::diameter},
    {"series", Dimension::text, false, nullptr},
}};

struct FieldColumn {
  const Field* field = nullptr;
  std::size_t index = 0;
  double factor = 1.0;  ///< to SI
};

/// What the data package states about one file.
struct Stated {
  std::map<std::string, std::string> units;  ///< column -> unit
  std::optional<Provenance> provenance;
  bool found = false;  ///< the package has a resource of this name
};

Stated read_stated(const std::string& package_text, const std::string& file) {
  Stated stated;
  if (package_text.empty()) return stated;
  const std::filesystem::path path(file);
  const JsonDocument document(package_text, (path.parent_path() / package_file_name).string());
  const auto resource = find_resource(document.root(), path.filename().string());
  if (!resource) return stated;
  stated.found = true;
  stated.units = field_units(*resource);
  const auto recoil = document.root().find("recoil");
  if (recoil && recoil->find("provenance")) stated.provenance = read_provenance(*recoil);
  return stated;
}

/// @throws InputError for an option about a field that does not exist
void require_fields(const std::map<std::string, std::string>& given, const std::string& option) {
  std::vector<std::string> names;
  for (const Field& field : fields) names.emplace_back(field.name);
  for (const auto& [name, value] : given) {
    if (std::ranges::find(names, name) != names.end()) continue;
    throw InputError(
        {}, fmt::format("{} {}={}: there is no field {}", option, name, value, quote(name)), "",
        did_you_mean(name, names));
  }
}

/// The line that names the columns.
struct Header {
  int line = 1;
  char delimiter = ',';
  std::vector<std::string> names;
};

/// The places of the columns that a field may mean, by --column or by a name that `columns_of`
/// knows.
std::vector<std::size_t> places_of(const Field& field, const std::vector<std::string>& header,
                                   const PassageFormat& format) {
  const std::string name(field.name);
  const auto renamed = format.columns.find(name);
  if (renamed == format.columns.end()) return columns_of(name, field.dimension, header);
  return columns_of(renamed->second, field.dimension, header);
}

/// Assigns columns of the header to fields. The unit is that of --unit, or else of the header, or
/// else of the data package.
std::vector<FieldColumn> find_columns(const Header& header, const std::string& package_text,
                                      const PassageFormat& format, PassageTable& table) {
  const Stated stated = read_stated(package_text, table.file);
  table.provenance = stated.provenance;
  std::vector<FieldColumn> columns;
  for (const Field& field : fields) {
    const std::string name(field.name);
    const auto renamed = format.columns.find(name);
    const std::string& wanted = renamed != format.columns.end() ? renamed->second : name;
    const std::vector<std::size_t> found = places_of(field, header.names, format);
    if (found.empty()) {
      if (!field.needed && renamed == format.columns.end()) continue;
      throw InputError({table.file, header.line, 1},
                       fmt::format("there is no column {}", quote(wanted)),
                       fmt::format("the columns are {}", listed(header.names)),
                       fmt::format("name it with --column {}=NAME", name));
    }
    const std::string& title = header.names[found.front()];
    if (found.size() > 1) {
      std::vector<std::string> meant;
      for (const std::size_t i : found) meant.push_back(header.names[i]);
      const bool same = std::ranges::count(meant, title) > 1;
      throw InputError({table.file, header.line, static_cast<int>(found.front()) + 1},
                       same ? fmt::format("two columns are called {}", quote(title))
                            : fmt::format("several columns may be the {}", name),
                       same ? "" : listed(meant),
                       same ? "rename one"
                            : fmt::format("name it with --column {}={}", name, shell_word(title)));
    }
    FieldColumn column{&field, found.front()};
    const Location place = {table.file, header.line, static_cast<int>(column.index) + 1};
    if (field.dimension != Dimension::text) {
      const auto by_option = format.units.find(name);
      const auto by_package = stated.units.find(title);
      std::string unit = by_option != format.units.end() ? by_option->second : std::string();
      if (unit.empty()) unit = unit_in_brackets(title);
      if (unit.empty() && by_package != stated.units.end()) unit = by_package->second;
      if (unit.empty()) {
        throw InputError(
            place, fmt::format("the unit of '{}' is not known", name),
            stated.found ? "datapackage.json beside the file states none"
                         : "neither the header nor a datapackage.json beside the file states it",
            fmt::format("give --unit {}={}", name, fmt::join(unit_names(field.dimension), "|")));
      }
      column.factor = known_scale(field.dimension, unit, fmt::format("'{}'", name), place).factor;
      table.units.push_back({name, unit});
      table.has_tangential = table.has_tangential || field.place == &Passage::tangential;
    }
    columns.push_back(column);
  }
  for (std::size_t i = 0; i < header.names.size(); ++i) {
    const bool used = std::ranges::find(columns, i, &FieldColumn::index) != columns.end();
    if (!used) table.ignored.push_back(printable(header.names[i]));
  }
  return columns;
}

/// Converts rows to passages and counts the damaged ones.
class PassageReader {
 public:
  PassageReader(PassageTable& table, std::vector<FieldColumn> columns, std::size_t width,
                const NumberFormat& numbers, double sign)
      : table_(table),
        columns_(std::move(columns)),
        width_(width),
        numbers_(numbers),
        points_(numbers.decimal == "."),
        sign_(sign) {}

  void read_row(const std::vector<std::string_view>& cells, int line) {
    ++table_.rows;
    Passage passage;
    passage.line = line;
    const std::string problem = read_passage(cells, passage);
    if (!problem.empty()) {
      if (table_.damaged++ < most_examples) table_.first_damaged.push_back({line, problem});
      return;
    }
    latest_.resize(table_.series.size(), -INFINITY);
    double& latest = latest_[passage.series];
    if (passage.time < latest && table_.unsorted++ == 0) table_.first_unsorted = line;
    latest = std::max(latest, passage.time);
    table_.passages.push_back(passage);
  }

 private:
  /// @returns the problem of the row, empty if there is none.
  std::string read_passage(const std::vector<std::string_view>& cells, Passage& passage) {
    const bool more =
        std::any_of(cells.begin() + static_cast<std::ptrdiff_t>(std::min(width_, cells.size())),
                    cells.end(), [](std::string_view cell) { return !cell.empty(); });
    if (cells.size() < width_ || more) {
      return fmt::format("{} cells, the header has {}", cells.size(), width_);
    }
    std::string_view series = "all";
    for (const FieldColumn& column : columns_) {
      const std::string_view cell = cells[column.index];
      if (column.field->place == nullptr) {
        series = cell;
        continue;
      }
      const std::optional<double> value =
          points_ ? parse_number(cell) : parse_number(cell, numbers_);
      if (!value) {
        return fmt::format("{} is {}", column.field->name,
                           cell.empty() ? std::string("empty") : quote(printable(cell)));
      }
      passage.*column.field->place = *value * column.factor;
    }
    if (!limits::velocity.contains(std::abs(passage.velocity))) {
      return fmt::format("velocity = {:g} m/s", passage.velocity);
    }
    if (!(std::abs(passage.tangential) <= limits::velocity.upper)) {
      return fmt::format("tangential_velocity = {:g} m/s", passage.tangential);
    }
    if (!limits::diameter.contains(passage.diameter)) {
      return fmt::format("diameter = {:g} m", passage.diameter);
    }
    passage.velocity *= sign_;
    return read_series(series, passage);
  }

  std::string read_series(std::string_view name, Passage& passage) {
    if (table_.series.empty() || table_.series[last_series_] != name) {
      if (name.empty()) return "series is empty";
      const std::string text(name);
      try {
        require_text(text, "");
      } catch (const InputError&) {
        return "series is not UTF-8 text";
      }
      if (printable(text) != text) return "series has control characters";
      const auto [known, added] = index_.try_emplace(text, table_.series.size());
      if (added) table_.series.push_back(text);
      last_series_ = known->second;
    }
    passage.series = static_cast<std::uint32_t>(last_series_);
    return "";
  }

  PassageTable& table_;
  std::vector<FieldColumn> columns_;
  std::size_t width_;
  NumberFormat numbers_;
  bool points_;  ///< decimal points, which are faster to read
  double sign_;
  std::vector<double> latest_;  ///< of each series [s]
  std::map<std::string, std::size_t> index_;
  std::size_t last_series_ = 0;
};

/// Sorts by series and time and removes repeated rows.
void sort_and_unite(PassageTable& table) {
  std::vector<Passage>& passages = table.passages;
  const auto content = [](const Passage& e) {
    return std::tie(e.series, e.time, e.velocity, e.diameter, e.tangential);
  };
  std::ranges::sort(passages, [&](const Passage& a, const Passage& b) {
    return std::tuple_cat(content(a), std::tie(a.line)) <
           std::tuple_cat(content(b), std::tie(b.line));
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < passages.size(); ++i) {
    if (kept > 0 && content(passages[kept - 1]) == content(passages[i])) {
      table.first_duplicated.push_back(passages[i].line);
    } else {
      passages[kept++] = passages[i];
    }
  }
  passages.resize(kept);
  table.duplicated = table.first_duplicated.size();
  std::ranges::sort(table.first_duplicated);
  if (table.duplicated > most_examples) table.first_duplicated.resize(most_examples);
}

/// Refuses a file with mostly damaged rows, whose delimiter or units are not those assumed.
void require_usable(const PassageTable& table) {
  if (table.rows == 0) {
    throw InputError({table.file, 1, 1}, "there is a header but no row below it", "",
                     "write one row for each passage through the probe volume");
  }
  if (2 * table.damaged <= table.rows) return;
  const BadRow& first = table.first_damaged.front();
  throw InputError(
      {table.file, first.line, 1}, first.problem,
      fmt::format("{} of {} rows cannot be used", table.damaged, table.rows),
      "check the delimiter and the units; --decimal-comma reads 2,5 as two and a half");
}

/// Calls `on_line` with each line that is not blank, its number and the place of its end, until
/// that returns false.
template <class OnLine>
void each_line(std::string_view text, std::size_t from, int first, const OnLine& on_line) {
  for (int line = first; from < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    const std::string_view content = text.substr(from, end - from);
    from = end + 1;
    if (content.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    if (!on_line(content, line, from)) return;
  }
}

/// The line of column names: the first with all needed fields, or else the first without a number
/// above a line of as many cells with a number, or else the first.
/// @param[out] rest where the next line begins
Header find_header(const std::string& text, const std::string& file, const PassageFormat& format,
                   std::size_t& rest) {
  constexpr int most_above = 100;  // lines
  const NumberFormat commas = {","};
  struct Candidate {
    Header header;
    std::size_t rest = 0;
  };
  std::optional<Candidate> first;
  std::optional<Candidate> plain;
  std::optional<Candidate> named;
  std::map<char, Candidate> before;  // without a number, by delimiter
  std::vector<std::string_view> cells;
  each_line(text, 0, 1, [&](std::string_view content, int line, std::size_t next) {
    if (line > most_above) return false;
    for (const char delimiter : {'\t', ';', ','}) {
      split(content, delimiter, cells);
      while (cells.size() > 1 && cells.back().empty()) cells.pop_back();
      Candidate here{{line, delimiter, {cells.begin(), cells.end()}}, next};
      const bool numbers = std::ranges::any_of(cells, [&](std::string_view cell) {
        return parse_number(cell) || parse_number(cell, commas);
      });
      const auto above = before.find(delimiter);
      if (numbers && !plain && cells.size() > 1 && above != before.end() &&
          above->second.header.names.size() == cells.size()) {
        plain = above->second;
      }
      before.erase(delimiter);
      if (!numbers) before.emplace(delimiter, here);
      if (!first && delimiter == delimiter_of(content)) first = here;
      const bool all = std::ranges::all_of(fields, [&](const Field& field) {
        return !field.needed || !places_of(field, here.header.names, format).empty();
      });
      if (all) {
        named = here;
        return false;
      }
    }
    return true;
  });
  const auto found = named ? named : plain ? plain : first;
  if (!found) {
    throw InputError({file, 1, 1}, "the file is empty", "",
                     "begin with a line that names the columns: time,velocity,diameter");
  }
  rest = found->rest;
  for (const std::string& name : found->header.names) require_text(name, file);
  return found->header;
}

/// Do the numbers of the first rows have decimal commas?
bool has_decimal_commas(const std::string& text, std::size_t from, const Header& header,
                        const std::vector<FieldColumn>& columns) {
  constexpr int rows = 200;
  if (header.delimiter == ',') return false;
  DecimalCommas commas;
  std::vector<std::string_view> cells;
  each_line(text, from, 0, [&](std::string_view content, int line, std::size_t) {
    split(content, header.delimiter, cells);
    for (const FieldColumn& column : columns) {
      if (column.field->place != nullptr && column.index < cells.size()) {
        commas.see(cells[column.index]);
      }
    }
    return line < rows;
  });
  return commas.found();
}

}  // namespace

PassageTable parse_passages(const std::string& text, const std::string& file,
                            const std::string& package_text, const PassageFormat& format) {
  PassageTable table;
  table.file = file;
  require_fields(format.units, "--unit");
  require_fields(format.columns, "--column");
  std::size_t rest = 0;
  const Header header = find_header(text, file, format, rest);
  if (header.line > 1) {
    table.notes.push_back(
        {ImportRemark::lines_skipped, {fmt::format("lines 1 to {}", header.line - 1)}});
  }
  const std::vector<FieldColumn> columns = find_columns(header, package_text, format, table);
  const bool commas = format.decimal_comma || has_decimal_commas(text, rest, header, columns);
  if (commas && !format.decimal_comma) table.notes.push_back({ImportRemark::decimal_commas});
  PassageReader reader(table, columns, header.names.size(), {commas ? "," : "."},
                       format.positive_away ? -1.0 : 1.0);
  std::vector<std::string_view> cells;
  each_line(text, rest, header.line + 1, [&](std::string_view content, int line, std::size_t) {
    split(content, header.delimiter, cells);
    reader.read_row(cells, line);
    return true;
  });
  require_usable(table);
  sort_and_unite(table);
  return table;
}

PassageTable read_passages(const std::filesystem::path& path, const PassageFormat& format) {
  ImportRequest request;
  request.file = path;
  request.decimal_comma = format.decimal_comma;
  std::vector<ImportNote> notes;
  const std::string text = table_text(request, notes, largest_file);
  const std::filesystem::path package = path.parent_path() / package_file_name;
  const std::string package_text =
      std::filesystem::is_regular_file(package) ? read_text_file(package) : std::string();
  PassageTable table = parse_passages(text, path.string(), package_text, format);
  table.notes.insert(table.notes.begin(), notes.begin(), notes.end());
  return table;
}

}  // namespace recoil
