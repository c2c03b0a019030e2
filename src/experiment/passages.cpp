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
#include "data/dataset.hpp"
#include "data/limits.hpp"
#include "data/text.hpp"
#include "experiment/passage_columns.hpp"

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

/// The cells of one line. Instruments write plain lines: a quoted cell may not hold the delimiter.
void split(std::string_view line, char delimiter, std::vector<std::string_view>& cells) {
  cells.clear();
  while (cells.size() <= most_columns) {
    const std::size_t end = line.find(delimiter);
    cells.push_back(unquoted(line.substr(0, end)));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
  }
}

/// Turns lines into passages and counts what it cannot use.
class PassageReader {
 public:
  PassageReader(PassageTable& table, PassageColumns columns, double sign)
      : table_(table), columns_(std::move(columns)), sign_(sign) {}

  void row(const std::vector<std::string_view>& cells, int line) {
    ++table_.rows;
    Passage passage;
    passage.line = line;
    const std::string problem = understand(cells, passage);
    if (problem.empty()) {
      latest_.resize(table_.series.size(), -INFINITY);
      double& latest = latest_[passage.series];
      if (passage.time < latest && table_.unsorted++ == 0) table_.first_unsorted = line;
      latest = std::max(latest, passage.time);
      table_.passages.push_back(passage);
      return;
    }
    if (table_.first_damaged.size() < most_examples)
      table_.first_damaged.push_back({line, problem});
    ++table_.damaged;
  }

 private:
  std::string understand(const std::vector<std::string_view>& cells, Passage& passage) {
    if (cells.size() != columns_.width) {
      return fmt::format("{} cells, the header has {}", cells.size(), columns_.width);
    }
    const std::array<std::pair<PassageField, double*>, 4> places = {{
        {PassageField::time, &passage.time},
        {PassageField::velocity, &passage.velocity},
        {PassageField::tangential, &passage.tangential},
        {PassageField::diameter, &passage.diameter},
    }};
    for (const auto& [field, place] : places) {
      if (!columns_.index[field]) continue;
      const std::string_view cell = cells[*columns_.index[field]];
      const std::optional<double> value = parse_number(cell);
      if (!value) {
        return fmt::format("{} is {}", name_of(field),
                           cell.empty() ? std::string("empty") : quote(printable(cell)));
      }
      *place = *value * columns_.factor[field];
    }
    const double speed = std::abs(passage.velocity);
    if (!limits::velocity.contains(speed)) {
      return fmt::format("velocity = {:g} m/s", passage.velocity);
    }
    if (!(std::abs(passage.tangential) <= limits::velocity.upper)) {
      return fmt::format("tangential_velocity = {:g} m/s", passage.tangential);
    }
    if (!limits::diameter.contains(passage.diameter)) {
      return fmt::format("diameter = {:g} m", passage.diameter);
    }
    passage.velocity *= sign_;
    return read_series(cells, passage);
  }

  std::string read_series(const std::vector<std::string_view>& cells, Passage& passage) {
    const auto index = columns_.index[PassageField::series];
    const std::string_view name = index ? cells[*index] : "all";
    if (!table_.series.empty() && table_.series[last_series_] == name) {
      passage.series = static_cast<std::uint32_t>(last_series_);
      return "";
    }
    if (name.empty()) return "series is empty";
    const std::string text(name);
    try {
      require_text(text, "");
    } catch (const InputError&) {
      return "series is not UTF-8 text";
    }
    if (printable(text) != text) return "series has control characters";
    const auto found = std::find(table_.series.begin(), table_.series.end(), text);
    last_series_ = static_cast<std::size_t>(found - table_.series.begin());
    if (found == table_.series.end()) table_.series.push_back(text);
    passage.series = static_cast<std::uint32_t>(last_series_);
    return "";
  }

  PassageTable& table_;
  PassageColumns columns_;
  double sign_;
  std::vector<double> latest_;  ///< of each series
  std::size_t last_series_ = 0;
};

void sort_and_unite(PassageTable& table) {
  std::vector<Passage>& passages = table.passages;
  const auto content = [](const Passage& e) {
    return std::tie(e.series, e.time, e.velocity, e.diameter, e.tangential);
  };
  std::sort(passages.begin(), passages.end(), [&](const Passage& a, const Passage& b) {
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
  std::sort(table.first_duplicated.begin(), table.first_duplicated.end());
  if (table.duplicated > most_examples) table.first_duplicated.resize(most_examples);
}

/// A file of which most is damage was not understood.
void require_sense(const PassageTable& table) {
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
      PassageColumns columns = passage_columns(header, file, package_text, format);
      table.ignored = columns.ignored;
      table.provenance = columns.provenance;
      table.units = columns.units;
      table.has_tangential = columns.index[PassageField::tangential].has_value();
      reader.emplace(table, std::move(columns), format.positive_away ? -1.0 : 1.0);
      continue;
    }
    split(content, delimiter, cells);
    reader->row(cells, line);
  }
  if (!reader) {
    throw InputError({file, 1, 1}, "the file is empty", "",
                     "begin with a line that names the columns: time,velocity,diameter");
  }
  require_sense(table);
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
