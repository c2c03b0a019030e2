#include "report/coverage_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <regex>
#include <sstream>

#include "core/error.hpp"
#include "core/files.hpp"

namespace recoil {
namespace {

// The middle of what the study asks for, by which rows are ranked [%].
constexpr double wanted = 95.0;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream parts(line.substr(1));
  for (std::string cell; std::getline(parts, cell, '|');) {
    const std::size_t first = cell.find_first_not_of(' ');
    const std::size_t last = cell.find_last_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

/// Reads the lines of one file into a table.
class TableReader {
 public:
  explicit TableReader(const std::filesystem::path& file) { table_.file = file; }

  void learn(const std::string& line) {
    ++line_;
    std::smatch found;
    static const std::regex made("^([0-9]+) simulated data sets.* level ([0-9.]+) %");
    if (std::regex_search(line, found, made)) {
      table_.datasets = std::stoi(found[1]);
      table_.level = 0.01 * std::stod(found[2]);
    }
    if (line.starts_with("| design | parameter |")) {
      heads_ = cells_of(line);
    } else if (heads_.empty() || !line.starts_with("|")) {
      return;
    } else if (!line.starts_with("|---")) {
      add_row(cells_of(line));
    }
    table_.markdown += line + "\n";
  }

  const CoverageTable& table() const { return table_; }

 private:
  void add_row(const std::vector<std::string>& cells) {
    if (table_.datasets == 0)
      fail("a row", "nothing before it says how many data sets and which level");
    if (cells.size() != heads_.size()) {
      fail(fmt::format("{} columns", cells.size()),
           fmt::format("its heads name {}", heads_.size()));
    }
    CoverageTableRow row;
    row.design = cells[0];
    row.parameter = cells[1];
    row.identifiable = number(at(cells, "identifiable, %"));
    row.held = number(at(cells, "recommended, %"));
    row.held_identifiable = at(cells, "where identifiable, %");
    row.verdict = cells.back();
    table_.rows.push_back(std::move(row));
  }

  const std::string& at(const std::vector<std::string>& cells, const std::string& head) const {
    const auto found = std::find(heads_.begin(), heads_.end(), head);
    if (found == heads_.end()) fail(fmt::format("no column '{}'", head), "the summary needs it");
    return cells[static_cast<std::size_t>(found - heads_.begin())];
  }

  double number(const std::string& text) const {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0') fail(fmt::format("'{}'", text), "a percentage was expected");
    return value;
  }

  [[noreturn]] void fail(const std::string& problem, const std::string& why) const {
    throw InputError({table_.file.string(), line_, 0}, problem, why,
                     "let ./run study write the table again");
  }

  CoverageTable table_;
  std::vector<std::string> heads_;
  int line_ = 0;
};

std::optional<GridDesign> design_named(const std::string& name) {
  for (const GridDesign& design : coverage_grid()) {
    if (design.name() == name) return design;
  }
  return std::nullopt;
}

bool warned(const CoverageTableRow& row) { return row.verdict.ends_with("warned"); }
bool misses(const CoverageTableRow& row) {
  return !warned(row) && !row.verdict.starts_with("holds");
}

/// How far the row is from what is wanted, over all data sets or where it was identifiable [%].
double off(const CoverageTableRow& row) {
  const double all = std::abs(row.held - wanted);
  if (warned(row) || row.held_identifiable == "-") return all;
  return std::max(all, std::abs(std::strtod(row.held_identifiable.c_str(), nullptr) - wanted));
}

/// Misses first, then what nobody warned of, then by distance.
bool worse(const CoverageTableRow& a, const CoverageTableRow& b) {
  if (misses(a) != misses(b)) return misses(a);
  if (warned(a) != warned(b)) return !warned(a);
  return off(a) > off(b);
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string short_name(const CoverageTableRow& row) {
  return row.parameter.substr(0, row.parameter.find('('));
}

struct Tally {
  int rows = 0, held = 0, warned = 0, narrow = 0, wide = 0;

  void add(const CoverageTableRow& row) {
    ++rows;
    held += row.verdict.starts_with("holds") ? 1 : 0;
    warned += row.verdict == "warned" ? 1 : 0;
    narrow += misses(row) && row.verdict != "TOO WIDE" ? 1 : 0;
    wide += row.verdict == "TOO WIDE" ? 1 : 0;
  }
  std::string words() const {
    return fmt::format(
        "of {} rows {} hold, in {} more the verdict warns, {} are too narrow and {} too wide", rows,
        held, warned, narrow, wide);
  }
};

std::string grid_row(const GridDesign& design, int datasets,
                     const std::vector<const CoverageTableRow*>& rows) {
  const CoverageTableRow& worst = **std::min_element(
      rows.begin(), rows.end(), [](const auto* a, const auto* b) { return worse(*a, *b); });
  std::vector<std::string> warnings, failures;
  for (const CoverageTableRow* row : rows) {
    if (warned(*row)) warnings.push_back(short_name(*row));
    if (misses(*row)) failures.push_back(short_name(*row) + " " + lower(row->verdict));
  }
  return fmt::format(
      "| {} | {} | {} | {} | {} | {} | {}: {:.1f} ({}) | {:.0f} | {} | {} |\n", design.points,
      to_string(design.noise), design.sd_stated ? "stated" : "estimated",
      design.adhesion_free ? "free" : "fixed", design.captures ? "with" : "-", datasets,
      short_name(worst), worst.held, worst.held_identifiable, 100.0 - worst.identifiable,
      warnings.empty() ? "-" : fmt::format("{}", fmt::join(warnings, ", ")),
      failures.empty() ? "holds" : fmt::format("{}", fmt::join(failures, ", ")));
}

/// The rows of one design, and on how many data sets they rest.
struct DesignRows {
  int datasets = 0;
  std::vector<const CoverageTableRow*> rows;
};

/// The grid in its own order, one row per design that some table holds.
std::string grid_section(const std::vector<CoverageTable>& tables, const std::string& picture) {
  std::string sizes;
  Tally all;
  std::map<std::string, DesignRows> designs;
  for (const CoverageTable& table : tables) {
    Tally own;
    for (const CoverageTableRow& row : table.rows) {
      if (!design_named(row.design)) continue;
      DesignRows& design = designs[row.design];
      design.datasets = table.datasets;
      design.rows.push_back(&row);
      own.add(row);
      all.add(row);
    }
    if (own.rows == 0) continue;
    sizes += fmt::format("- [{0}]({0}): {1} data sets per design; {2}.\n",
                         table.file.filename().string(), table.datasets, own.words());
  }
  std::string body;
  for (const GridDesign& design : coverage_grid()) {
    const auto found = designs.find(design.name());
    if (found != designs.end()) {
      body += grid_row(design, found->second.datasets, found->second.rows);
    }
  }
  if (body.empty()) return "";
  return fmt::format(
             "## Other kinds of data\n\nOne diameter, n points evenly in log V from just above the "
             "capture velocity (with captures below it) to 50 times that; the tables of every "
             "parameter and interval:\n\n{}\nTogether, {}. Below, one row per design: its worst "
             "parameter with the share of the data sets whose recommended interval holds the truth "
             "(in brackets: of those in which the verdict calls it identifiable), how often the "
             "verdict warned of that parameter, and the parameters of which it warned in nine of "
             "ten. A parameter holds with 93 to 97 % in both shares.\n\n",
             sizes, all.words()) +
         (picture.empty()
              ? ""
              : fmt::format("![coverage of the recommended intervals]({})\n\n", picture)) +
         "| n | scatter | its size | f0 | captures | data sets | worst parameter: held, % (where "
         "identifiable) | warned, % | warned of | verdict "
         "|\n|---|---|---|---|---|---|---|---|---|---|\n" +
         body;
}

}  // namespace

std::vector<CoverageTable> read_coverage_tables(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (std::filesystem::is_directory(folder)) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("coverage-") && name.ends_with(".md")) files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<CoverageTable> tables;
  for (const std::filesystem::path& file : files) {
    TableReader reader(file);
    std::istringstream text(read_text_file(file));
    for (std::string line; std::getline(text, line);) reader.learn(line);
    if (!reader.table().rows.empty()) tables.push_back(reader.table());
  }
  if (tables.empty()) {
    throw InputError({folder.string()}, "no coverage tables here",
                     "they are read from files named coverage-*.md", "./run study writes them");
  }
  return tables;
}

std::string coverage_summary(const std::vector<CoverageTable>& tables, const std::string& picture) {
  std::string text = "# Coverage of the intervals\n\n";
  for (const CoverageTable& table : tables) {
    Tally tally;
    for (const CoverageTableRow& row : table.rows) {
      if (!design_named(row.design)) tally.add(row);
    }
    if (tally.rows == 0) continue;
    text += fmt::format(
        "## The shipped designs\n\n{} data sets each ([how they were made]({})); {}.\n\n{}\n",
        table.datasets, table.file.filename().string(), tally.words(), table.markdown);
  }
  return text + grid_section(tables, picture);
}

std::vector<GridResult> grid_of_tables(const std::vector<CoverageTable>& tables) {
  std::vector<GridResult> results;
  for (const GridDesign& design : coverage_grid()) {
    GridResult result{design, {}};
    for (const CoverageTable& table : tables) {
      const auto count = [&](double percent) {
        return static_cast<int>(std::lround(0.01 * percent * table.datasets));
      };
      for (const CoverageTableRow& row : table.rows) {
        if (row.design != design.name()) continue;
        result.coverage.datasets = table.datasets;
        CoverageRow made;
        made.parameter = row.parameter;
        made.identifiable = count(row.identifiable);
        made.cells = {{"recommended", table.datasets, count(row.held), 0, 0, 0.0}};
        result.coverage.rows.push_back(std::move(made));
      }
    }
    if (!result.coverage.rows.empty()) results.push_back(std::move(result));
  }
  return results;
}

}  // namespace recoil
