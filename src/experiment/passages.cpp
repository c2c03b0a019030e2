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

/// Assigns columns of the header to fields, by --column or by the field's name. The unit is that of
/// --unit, or else that of the data package.
std::vector<FieldColumn> find_columns(const std::vector<std::string>& header,
                                      const std::string& package_text, const PassageFormat& format,
                                      PassageTable& table) {
  require_fields(format.units, "--unit");
  require_fields(format.columns, "--column");
  const Stated stated = read_stated(package_text, table.file);
  table.provenance = stated.provenance;
  std::vector<FieldColumn> columns;
  for (const Field& field : fields) {
    const std::string name(field.name);
    const auto renamed = format.columns.find(name);
    const std::string& wanted = renamed != format.columns.end() ? renamed->second : name;
    const auto found = std::ranges::find(header, wanted);
    if (found == header.end()) {
      if (!field.needed && renamed == format.columns.end()) continue;
      throw InputError({table.file, 1, 1}, fmt::format("there is no column {}", quote(wanted)),
                       fmt::format("the columns are {}", listed(header)),
                       fmt::format("name it with --column {}=NAME", name));
    }
    FieldColumn column{&field, static_cast<std::size_t>(found - header.begin())};
    const Location place = {table.file, 1, static_cast<int>(column.index) + 1};
    if (std::find(found + 1, header.end(), wanted) != header.end()) {
      throw InputError(place, fmt::format("two columns are called {}", quote(wanted)), "",
                       "rename one");
    }
    if (field.dimension != Dimension::text) {
      const bool by_option = format.units.contains(name);
      if (!by_option && !stated.units.contains(wanted)) {
        throw InputError(
            place, fmt::format("the unit of '{}' is not known", name),
            stated.found ? "datapackage.json beside the file states none"
                         : "there is no datapackage.json beside the file that lists it",
            fmt::format("give --unit {}={}", name, fmt::join(unit_names(field.dimension), "|")));
      }
      const std::string& unit = by_option ? format.units.at(name) : stated.units.at(wanted);
      column.factor = known_scale(field.dimension, unit, fmt::format("'{}'", name), place).factor;
      table.units.push_back({name, unit});
      table.has_tangential = table.has_tangential || field.place == &Passage::tangential;
    }
    columns.push_back(column);
  }
  for (std::size_t i = 0; i < header.size(); ++i) {
    const bool used = std::ranges::find(columns, i, &FieldColumn::index) != columns.end();
    if (!used) table.ignored.push_back(printable(header[i]));
  }
  return columns;
}

/// Converts rows to passages and counts the damaged ones.
class PassageReader {
 public:
  PassageReader(PassageTable& table, std::vector<FieldColumn> columns, std::size_t width,
                double sign)
      : table_(table), columns_(std::move(columns)), width_(width), sign_(sign) {}

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
    if (cells.size() != width_) {
      return fmt::format("{} cells, the header has {}", cells.size(), width_);
    }
    std::string_view series = "all";
    for (const FieldColumn& column : columns_) {
      const std::string_view cell = cells[column.index];
      if (column.field->place == nullptr) {
        series = cell;
        continue;
      }
      const std::optional<double> value = parse_number(cell);
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
  throw InputError({table.file, first.line, 1}, first.problem,
                   fmt::format("{} of {} rows cannot be used", table.damaged, table.rows),
                   "check the delimiter and the units, and that decimals have a point");
}

}  // namespace

PassageTable parse_passages(const std::string& text, const std::string& file,
                            const std::string& package_text, const PassageFormat& format) {
  PassageTable table;
  table.file = file;
  std::string_view rest = text;
  std::vector<std::string_view> cells;
  std::optional<PassageReader> reader;
  char delimiter = ',';
  for (int line = 1; !rest.empty(); ++line) {
    const std::size_t end = rest.find('\n');
    const std::string_view content = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (content.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    if (!reader) {
      require_text(content, file);
      delimiter = delimiter_of(content);
      split(content, delimiter, cells);
      const std::vector<std::string> header(cells.begin(), cells.end());
      reader.emplace(table, find_columns(header, package_text, format, table), header.size(),
                     format.positive_away ? -1.0 : 1.0);
      continue;
    }
    split(content, delimiter, cells);
    reader->read_row(cells, line);
  }
  if (!reader) {
    throw InputError({file, 1, 1}, "the file is empty", "",
                     "begin with a line that names the columns: time,velocity,diameter");
  }
  require_usable(table);
  sort_and_unite(table);
  return table;
}

PassageTable read_passages(const std::filesystem::path& path, const PassageFormat& format) {
  const std::string text = read_text_file(path, largest_file);
  const std::filesystem::path package = path.parent_path() / package_file_name;
  const std::string package_text =
      std::filesystem::is_regular_file(package) ? read_text_file(package) : std::string();
  return parse_passages(text, path.string(), package_text, format);
}

}  // namespace recoil
