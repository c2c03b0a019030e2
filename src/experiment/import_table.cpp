#include "experiment/import_table.hpp"

#include <fmt/format.h>
#include <iconv.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <regex>
#include <set>
#include <span>

#include "core/files.hpp"
#include "data/text.hpp"
#include "experiment/column_names.hpp"
#include "experiment/recording.hpp"
#include "experiment/workbook.hpp"

namespace recoil {
namespace {

/// The diameter that --diameter states for a series.
std::optional<double> stated_diameter(const ImportRequest& request, const std::string& series) {
  std::optional<double> for_all;
  for (const std::string& word : request.diameters) {
    const auto pair = split_pair(word);
    if (pair && pair->first != series) continue;
    const double value =
        parse_quantity(pair ? pair->second : word, Dimension::length, "um", "--diameter");
    if (pair) return value;
    for_all = value;
  }
  return for_all;
}

/// The diameter [m] in the name of a series: "2.58 um", "d = 4.9um on Mo".
std::optional<double> diameter_in_name(const std::string& series) {
  static const std::regex pattern(
      R"re((^|[^0-9.])([0-9]+\.?[0-9]*)\s*(nm|um|µm|μm|mm)($|[^a-zA-Z]))re");
  std::smatch match;
  if (!std::regex_search(series, match, pattern)) return std::nullopt;
  const auto number = parse_number(match[2].str());
  const auto factor = unit_factor(Dimension::length, match[3].str());
  return number && factor ? std::optional<double>(*number * *factor) : std::nullopt;
}

/// True if the text of a cell means that its value is not known.
bool is_unknown(const std::string& text) {
  static const std::set<std::string> words = {"",    "-",   "–",   "NA",   "N/A",  "n/a", "#N/A",
                                              "nan", "NaN", "NAN", "null", "NULL", "None"};
  if (!text.empty() && text.front() >= '0' && text.front() <= '9') return false;
  return words.contains(text);
}

/// Splits "0.85 ± 0.02" or "0.85 +- 0.02" into value and error, which is empty if there is none.
std::pair<std::string, std::string> value_and_error(const std::string& text) {
  if (text.find_first_of("+\xC2") == std::string::npos) return {text, ""};
  for (const std::string_view mark : {"±", "+-", "+/-"}) {
    const std::size_t at = text.find(mark);
    if (at == std::string::npos || at == 0) continue;
    return {std::string(trimmed(std::string_view(text).substr(0, at))),
            std::string(trimmed(std::string_view(text).substr(at + mark.size())))};
  }
  return {text, ""};
}

/// The name of the quantity that is the standard deviation of `quantity`.
std::string error_name(const std::string& quantity) {
  return quantity == "incident_velocity" ? "velocity_sd" : quantity + "_sd";
}

/// `text` in UTF-8. A text that is not is read as Windows-1252.
std::string utf8_text(std::string text, const std::string& file, std::vector<ImportNote>& notes) {
  try {
    require_text(text, file);
    return text;
  } catch (const InputError&) {
    const iconv_t converter = iconv_open("UTF-8", "WINDOWS-1252");
    if (converter == reinterpret_cast<iconv_t>(-1)) throw;
    std::string out(3 * text.size(), '\0');  // a euro sign has three bytes
    char* in = text.data();
    char* at = out.data();
    std::size_t left = text.size();
    std::size_t room = out.size();
    const std::size_t failed = iconv(converter, &in, &left, &at, &room);
    iconv_close(converter);
    if (failed == static_cast<std::size_t>(-1)) throw;
    out.resize(out.size() - room);
    notes.push_back({ImportRemark::encoding_assumed});
    return out;
  }
}

/// The lines of `text` that are not blank, without their ends. They are views of `text`, whose
/// lines may be blanked but not moved.
using Lines = std::vector<std::string_view>;

Lines lines_of(std::string_view text) {
  Lines lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    const std::string_view line = text.substr(at, end - at);
    if (!trimmed(line).empty()) lines.push_back(line);
    at = end + 1;
  }
  return lines;
}

bool is_comment(std::string_view line) { return trimmed(line).starts_with('#'); }

/// Replaces a line of `text` by blanks.
void blank(std::string& text, std::string_view line) {
  std::fill_n(text.begin() + (line.data() - text.data()), line.size(), ' ');
}

/// The delimiter in a first line "sep=;", which is then blanked.
std::optional<char> take_separator(std::string& text, Lines& lines) {
  if (lines.empty()) return std::nullopt;
  const std::string_view first = trimmed(lines.front());
  if (!first.starts_with("sep=") || first.size() != 5) return std::nullopt;
  const char delimiter = first.back();
  blank(text, lines.front());
  lines.erase(lines.begin());
  return delimiter;
}

/// The cells of one line; none if a quotation mark is misplaced.
CsvRow cells_of(std::string_view line, char delimiter) {
  CsvRow cells;
  try {
    read_csv(line, "", delimiter, [&](CsvRow& row) { cells = std::move(row); });
  } catch (const InputError&) {
    cells.clear();
  }
  return cells;
}

/// "m/s" of "(m/s)" or "[m/s]".
std::string without_brackets(const std::string& text) {
  const bool enclosed = text.size() > 2 && ((text.front() == '(' && text.back() == ')') ||
                                            (text.front() == '[' && text.back() == ']'));
  return enclosed ? text.substr(1, text.size() - 2) : text;
}

bool has_number(const CsvRow& row, const NumberFormat& format) {
  return std::ranges::any_of(
      row, [&](const CsvField& cell) { return parse_number(cell.text, format).has_value(); });
}

/// The delimiter that gives all lines the same number of cells, except for a title above the
/// header. If there is none, the most frequent delimiter of the first line.
char likely_delimiter(const Lines& lines, const NumberFormat& format) {
  constexpr std::size_t enough = 200;  // lines
  for (const char delimiter : {'\t', ';', ',', '|', ' '}) {
    if (format.decimal == std::string(1, delimiter)) continue;
    const auto divided = [&](std::string_view line) { return line.find(delimiter) != line.npos; };
    if (delimiter != ' ' && std::ranges::none_of(lines, divided)) continue;
    std::size_t width = 0;
    std::size_t above = 0;
    bool even = true;
    for (std::size_t i = 0; even && i < std::min(enough, lines.size()); ++i) {
      if (is_comment(lines[i])) continue;
      const CsvRow cells = cells_of(lines[i], delimiter);
      if (width == 0 && cells.size() == 1) {
        ++above;
      } else if (width == 0) {
        width = cells.size();
        even = width > 1 && (above == 0 || !has_number(cells, format));
      } else {
        even = cells.size() == width;
      }
    }
    if (even && width > 1) return delimiter;
  }
  const auto first = std::ranges::find_if_not(lines, is_comment);
  return first == lines.end() ? ',' : delimiter_of(trimmed(*first));
}

/// Blanks the lines that begin with '#', except for one that is the header.
/// @throws InputError for such a line below the header that could be a row
void blank_comments(std::string& text, const Lines& lines, char delimiter,
                    const ImportRequest& request, std::vector<ImportNote>& notes) {
  const auto first = std::ranges::find_if_not(lines, is_comment);
  if (first == lines.end()) return;
  const auto last = std::find_if_not(lines.rbegin(), lines.rend(), is_comment);
  const std::size_t width = cells_of(trimmed(*last), delimiter).size();
  const bool headless = has_number(cells_of(trimmed(*first), delimiter), number_format(request));
  std::vector<std::string> skipped;
  for (auto line = lines.begin(); line != lines.end(); ++line) {
    if (!is_comment(*line)) continue;
    const std::string_view content = trimmed(*line);
    const auto at = static_cast<std::size_t>(content.data() - text.data());
    const bool like_row = width > 1 && cells_of(content, delimiter).size() == width;
    const bool heads = headless && std::next(line) == first && width > 1;
    const CsvRow rest = cells_of(content.substr(1), delimiter);
    if (heads && (like_row || rest.size() == width)) {
      if (rest.size() == width && !rest.front().text.empty()) text[at] = ' ';
      continue;
    }
    const Location where = locate(text, at, request.file.string());
    if (line > first && like_row) {
      throw InputError(where, "a row that begins with '#'",
                       "it is not known whether it is a comment or a point",
                       "remove it, or write its first cell without '#'");
    }
    blank(text, *line);
    skipped.push_back(fmt::format("line {}", where.line));
  }
  if (!skipped.empty()) notes.push_back({ImportRemark::lines_skipped, skipped});
}

}  // namespace

std::string usual_unit(const std::string& quantity, Dimension dimension) {
  if (dimension == Dimension::text) return "";
  return quantity.find("diameter") == std::string::npos ? si_unit(dimension) : "um";
}

StatedError stated_error(const std::string& word, Dimension dimension, const std::string& usual,
                         const std::string& option) {
  StatedError error;
  if (word.empty()) return error;
  const auto parts = number_and_unit(word);
  if (parts && parts->second == "%") {
    error.relative = parts->first / 100.0;
  } else {
    error.absolute = parse_quantity(word, dimension, usual, option);
  }
  if (error.relative < 0.0 || error.absolute < 0.0 || !error.stated()) {
    throw InputError({}, fmt::format("{} {} is not positive", option, quote(word)),
                     "it is a standard deviation", "leave the option out if it is not known");
  }
  return error;
}

std::vector<std::string> split_list(std::string_view text) {
  std::vector<std::string> parts;
  std::string part;
  bool quoted = false;
  for (const char c : text) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      parts.emplace_back(trimmed(part));
      part.clear();
    } else {
      part += c;
    }
  }
  parts.emplace_back(trimmed(part));
  std::erase(parts, "");
  return parts;
}

std::vector<std::string> split_lists(const std::vector<std::string>& lists) {
  std::vector<std::string> all;
  for (const std::string& list : lists) {
    for (std::string& part : split_list(list)) all.push_back(std::move(part));
  }
  return all;
}

std::optional<std::pair<std::string, std::string>> split_pair(const std::string& word) {
  const std::size_t at = word.find('=');
  if (at == std::string::npos) return std::nullopt;
  return std::pair{std::string(trimmed(std::string_view(word).substr(0, at))),
                   std::string(trimmed(std::string_view(word).substr(at + 1)))};
}

std::optional<double> ImportedPoint::restitution() const {
  const auto rebound = value[Quantity::rebound_velocity];
  if (!rebound) return value[Quantity::restitution];
  return *rebound / (*value[Quantity::incident_velocity] *
                     std::cos(value[Quantity::incidence_angle].value_or(0.0)));
}

ImportedPoint imported_point(const std::string& series, int line, std::optional<double> diameter,
                             double velocity, std::optional<double> restitution) {
  ImportedPoint point;
  point.series = series;
  point.line = line;
  point.value[Quantity::diameter] = diameter;
  point.value[Quantity::incident_velocity] = velocity;
  point.value[Quantity::restitution] = restitution;
  return point;
}

std::string default_series(const ImportRequest& request) {
  if (!request.series.empty()) return request.series;
  return descriptor_named(request.file) ? "points" : request.file.stem().string();
}

std::optional<double> known_diameter(const ImportRequest& request, const std::string& series,
                                     std::optional<double> in_file) {
  if (in_file) return in_file;
  const std::optional<double> stated = stated_diameter(request, series);
  return stated ? stated : diameter_in_name(series);
}

void resolve_diameters(const ImportRequest& request, ImportedPoints& imported) {
  const StatedError error =
      stated_error(request.diameter_error, Dimension::length, "um", "--diameter-error");
  bool for_all = false;
  for (const std::string& word : request.diameters) {  // including those that are not needed
    const auto pair = split_pair(word);
    parse_quantity(pair ? pair->second : word, Dimension::length, "um", "--diameter");
    if (pair) continue;
    if (for_all) {
      throw InputError({},
                       fmt::format("--diameter {} is a second diameter of all series", quote(word)),
                       "", "give one, or SERIES=DIAMETER");
    }
    for_all = true;
  }
  std::vector<std::string> series;
  std::vector<std::string> named;  // series whose names hold their diameters
  std::set<std::string> seen;
  std::map<std::string, std::optional<double>> of_series;
  bool used = request.diameters.empty();
  for (ImportedPoint& point : imported.points) {
    if (seen.insert(point.series).second) series.push_back(point.series);
    auto& diameter = point.value[Quantity::diameter];
    if (!diameter) {
      used = true;
      const auto [known, is_new] = of_series.try_emplace(point.series);
      if (is_new) {
        known->second = known_diameter(request, point.series, {});
        const bool from_name = known->second && !stated_diameter(request, point.series);
        if (from_name) named.push_back(point.series);
      }
      diameter = known->second;
    }
    if (!diameter) {
      throw InputError({request.file.string(), point.line, 1},
                       fmt::format("the diameter of series {} is not known", quote(point.series)),
                       "", "give --diameter 4.9um, or --diameter \"SERIES=4.9um\" for each series");
    }
    auto& sd = point.value[Quantity::diameter_sd];
    if (error.stated() && !sd) sd = error.of(*diameter);
  }
  for (const std::string& word : request.diameters) {
    const auto pair = split_pair(word);
    if (!pair || seen.contains(pair->first)) continue;
    throw InputError({}, fmt::format("--diameter {}: there is no such series", quote(word)), "",
                     did_you_mean(pair->first, series));
  }
  if (!used) imported.notes.push_back({ImportRemark::diameter_not_used});
  if (!named.empty()) imported.notes.push_back({ImportRemark::diameters_from_names, named});
}

NumberFormat number_format(const ImportRequest& request) {
  return {request.decimal_comma ? "," : "."};
}

std::string table_text(const ImportRequest& request, std::vector<ImportNote>& notes,
                       std::uintmax_t max_bytes) {
  const std::string file = request.file.string();
  std::string bytes = read_bytes(request.file, max_bytes);
  if (is_workbook(bytes)) {
    Sheet sheet = read_sheet(bytes, file, request.sheet, request.decimal_comma ? ',' : '.');
    ImportNote note{ImportRemark::sheet_read, {sheet.name}};
    note.names.insert(note.names.end(), sheet.others.begin(), sheet.others.end());
    notes.push_back(note);
    return std::move(sheet.table);
  }
  if (is_recording(bytes)) {
    throw InputError({file}, "this is a recording, not a table", "", "write --format recording");
  }
  if (!request.sheet.empty()) {
    throw InputError({file}, "--sheet, but this is not a workbook",
                     "recoil reads .xlsx, .ods and .xls", "leave the option out");
  }
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    throw InputError({file}, "this file is in UTF-16", "recoil reads UTF-8",
                     "save it as UTF-8, or convert it: iconv -f UTF-16 -t UTF-8 FILE > NEW");
  }
  return utf8_text(as_text(std::move(bytes), request.file), file, notes);
}

std::vector<CsvRow> import_rows(const ImportRequest& request, std::vector<ImportNote>& notes) {
  const std::string file = request.file.string();
  std::string text = *request.text;
  Lines lines = lines_of(text);
  const std::optional<char> stated = take_separator(text, lines);
  const char delimiter = stated ? *stated : likely_delimiter(lines, number_format(request));
  blank_comments(text, lines, delimiter, request, notes);
  std::vector<CsvRow> rows;
  rows.reserve(lines.size());
  read_csv(text, file, delimiter, [&](CsvRow& row) {
    const bool empty =
        std::ranges::all_of(row, [](const CsvField& cell) { return cell.text.empty(); });
    if (!empty) rows.push_back(std::move(row));
  });
  if (rows.empty()) {
    throw InputError({file, 1, 1}, "the file is empty", "", "export the points again");
  }
  if (!request.transpose) return rows;
  std::vector<CsvRow> columns;
  for (const CsvRow& row : rows) {
    require_width(row, rows.front().size(), file);
    columns.resize(row.size());
    for (std::size_t i = 0; i < row.size(); ++i) columns[i].push_back(row[i]);
  }
  return columns;
}

/// Do the numbers of the first rows have decimal commas?
bool have_decimal_commas(const std::vector<CsvRow>& table) {
  constexpr std::size_t enough = 200;  // rows
  DecimalCommas commas;
  for (std::size_t i = 0; i < std::min(enough, table.size()); ++i) {
    for (const CsvField& cell : table[i]) commas.see(cell.text);
  }
  return commas.found();
}

ImportTable::ImportTable(const ImportRequest& request, const std::vector<ImportQuantity>& known,
                         const FieldUnits& units)
    : file_(request.file.string()),
      series_(default_series(request)),
      format_(number_format(request)),
      known_(known),
      field_units_(units),
      rows_(import_rows(request, notes_)) {
  if (!request.decimal_comma && have_decimal_commas(rows_)) {
    format_.decimal = ",";
    notes_.push_back({ImportRemark::decimal_commas});
  }
  read_header(request.transpose);
  for (const CsvRow& row : rows_) require_width(row, header_.size(), file_);
  for (const std::string& entry : split_lists(request.map)) read_map(entry);
  find_columns_by_name();
  for (const ImportQuantity& quantity : known_) {
    if (!quantity.needed || has(quantity.name)) continue;
    throw InputError(
        {file_, header_.front().line, 1}, fmt::format("which column is {}?", quantity.name),
        named_
            ? fmt::format("the header has {}", listed(header_names()))
            : fmt::format("there is no header: the columns are called {}", listed(header_names())),
        fmt::format("name it with --map {}=COLUMN{}", quantity.name,
                    quantity.dimension == Dimension::text ? "" : ":UNIT"));
  }
  resolve_replicates();
  if (rows_.empty()) {
    throw InputError({file_, header_.front().line, 1}, "there is a header but no row below it", "",
                     "export the points again");
  }
}

/// Removes the header from the rows, and titles of one cell above it.
/// @param transposed the names that stood above columns are now labels of rows, and no header
void ImportTable::read_header(bool transposed) {
  const auto filled = [](const CsvRow& row) {
    return std::ranges::count_if(row, [](const CsvField& c) { return !c.text.empty(); });
  };
  while (rows_.size() > 1 && filled(rows_.front()) == 1 && rows_.back().size() > 1 &&
         filled(rows_[1]) > 1) {
    notes_.push_back(
        {ImportRemark::lines_skipped, {fmt::format("line {}", rows_.front().front().line)}});
    rows_.erase(rows_.begin());
  }
  header_ = rows_.front();
  for (CsvField& cell : header_) cell.text = trimmed(with_plain_blanks(cell.text));
  const bool labelled = transposed && header_.size() > 1;
  named_ = !std::ranges::all_of(
      std::span(header_).subspan(labelled ? 1 : 0),
      [&](const CsvField& cell) { return cell.text.empty() || parse_number(cell.text, format_); });
  if (named_) {
    rows_.erase(rows_.begin());
    const auto is_unit = [](const CsvField& cell) {
      return cell.text.empty() || dimension_of_unit(without_brackets(cell.text));
    };
    if (rows_.size() > 1 && filled(rows_.front()) > 0 && !has_number(rows_.front(), format_) &&
        std::ranges::all_of(rows_.front(), is_unit)) {
      units_ = rows_.front();
      rows_.erase(rows_.begin());
    }
    return;
  }
  for (std::size_t i = 0; i < header_.size(); ++i) header_[i].text = std::to_string(i + 1);
}

/// Quantities of which one tells the other.
constexpr std::pair<std::string_view, std::string_view> alternatives[] = {
    {"restitution", "rebound_velocity"},
    {"interval", "time"},
    {"time", "frame"},
    {"height", "pixel"}};

/// Assigns columns that have the name of a quantity, or another name of it.
void ImportTable::find_columns_by_name() {
  const std::vector<std::string> header = header_names();
  std::vector<std::string> units;
  for (const CsvField& cell : units_) units.push_back(without_brackets(cell.text));
  for (const ImportQuantity& quantity : known_) {
    const bool known_otherwise = std::ranges::any_of(alternatives, [&](const auto& pair) {
      return (quantity.name == pair.first && has(std::string(pair.second))) ||
             (quantity.name == pair.second && has(std::string(pair.first)));
    });
    if (has(quantity.name)) continue;
    std::vector<std::size_t> at = columns_of(quantity.name, quantity.dimension, header, units);
    if (at.empty()) continue;
    const bool own = header[at.front()].starts_with(quantity.name);
    if (!own) std::erase_if(at, [&](std::size_t i) { return known_otherwise || is_used(i); });
    const bool one = std::ranges::all_of(
        at, [&](std::size_t i) { return own || header[i] == header[at.front()]; });
    if (at.empty() || !one) continue;
    read_map(fmt::format("{}=\"{}\"", quantity.name, header[at.front()]));
    if (header[at.front()] != quantity.name) {
      found_.push_back(fmt::format("{} = {}", quantity.name, header[at.front()]));
    }
  }
}

bool ImportTable::is_used(std::size_t column) const {
  return std::ranges::any_of(columns_, [&](const auto& entry) {
    return std::ranges::find(entry.second.at, column) != entry.second.at.end();
  });
}

/// Checks that all quantities with several columns have the same number of columns.
void ImportTable::resolve_replicates() {
  for (const ImportQuantity& quantity : known_) {
    const auto found = columns_.find(quantity.name);
    if (quantity.dimension == Dimension::text || found == columns_.end()) continue;
    const std::size_t count = found->second.at.size();
    if (count <= 1) continue;
    if (replicates_ > 1 && count != replicates_) {
      throw InputError({}, fmt::format("--map {} names {} columns", quantity.name, count),
                       fmt::format("another quantity has {}", replicates_),
                       "name one column, or as many as the other has");
    }
    replicates_ = count;
  }
}

void ImportTable::read_map(const std::string& entry) {
  std::vector<std::string> names;
  for (const ImportQuantity& quantity : known_) names.push_back(quantity.name);
  const auto pair = split_pair(entry);
  if (!pair) {
    throw InputError({},
                     fmt::format("--map {} is not of the form quantity=column:unit", quote(entry)),
                     "", fmt::format("quantities are {}", join(names)));
  }
  const auto quantity = std::ranges::find(known_, pair->first, &ImportQuantity::name);
  if (quantity == known_.end()) {
    // "velocity" is nearest to velocity_sd but means the needed quantity, incident_velocity.
    const auto meant = std::ranges::find_if(known_, [&](const ImportQuantity& q) {
      return q.needed && q.name.ends_with("_" + pair->first);
    });
    throw InputError({file_}, fmt::format("--map: unknown quantity {}", quote(pair->first)),
                     "this format does not have this quantity",
                     did_you_mean(meant == known_.end() ? pair->first : meant->name, names));
  }
  std::string column = pair->second;
  if (column.size() > 1 && column.front() == '"' && column.back() == '"') {
    column = column.substr(1, column.size() - 2);
  }
  std::string unit;
  const std::vector<std::string> header = header_names();
  const auto is_column = [&](const std::string& name) {
    return std::ranges::find(header, name) != header.end();
  };
  if (const std::size_t at = column.rfind(':'); !is_column(column) && at != std::string::npos) {
    unit = column.substr(at + 1);
    column = column.substr(0, at);
  }
  const bool text = quantity->dimension == Dimension::text;
  Source source;
  const auto constant = number_and_unit(column);
  if (!text && !is_column(column) && constant && unit.empty() &&
      (constant->second.empty() || dimension_of_unit(constant->second))) {
    source.constant =
        parse_quantity(column, quantity->dimension, usual_unit(quantity->name, quantity->dimension),
                       fmt::format("--map {}", quantity->name));
  } else {
    for (std::size_t at = 0; at <= column.size();) {
      const std::size_t end =
          is_column(column) ? column.size() : std::min(column.find('+', at), column.size());
      source.at.push_back(column_named(column.substr(at, end - at)));
      at = end + 1;
    }
  }
  for (const std::size_t at : source.at) {
    if (text) break;
    source.scale.push_back(scale_of(*quantity, unit, at));
    for (const auto& [other, used] : columns_) {
      if (used.scale.empty() || other == quantity->name) continue;
      if (std::ranges::find(used.at, at) == used.at.end()) continue;
      throw InputError(header_[at].in(file_),
                       fmt::format("the column {} is taken for both {} and {}",
                                   quote(header_[at].text), other, quantity->name),
                       "", "name another column in --map");
    }
  }
  if (!columns_.emplace(quantity->name, source).second) {
    throw InputError({}, fmt::format("--map {} is given twice", quantity->name), "", "remove one");
  }
}

std::vector<std::string> ImportTable::header_names() const {
  std::vector<std::string> names;
  for (const CsvField& cell : header_) names.push_back(cell.text);
  return names;
}

std::size_t ImportTable::column_named(const std::string& name) const {
  const std::vector<std::string> names = header_names();
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) {
    throw InputError({file_, header_.front().line, 1},
                     fmt::format("no column is called {}", quote(name)),
                     named_ ? "--map asks for it" : "there is no header, and --map asks for it",
                     named_ ? did_you_mean(name, names)
                            : fmt::format("the columns are called {}", listed(names)));
  }
  const auto again = std::find(std::next(found), names.end(), name);
  if (again == names.end()) return static_cast<std::size_t>(found - names.begin());
  throw InputError(header_[static_cast<std::size_t>(again - names.begin())].in(file_),
                   fmt::format("the column {} appears twice", quote(name)),
                   "it is not known which one --map means", "rename one of them");
}

Scale ImportTable::scale_of(const ImportQuantity& quantity, const std::string& unit,
                            std::size_t column) const {
  const CsvField& cell = header_[column];
  std::string name = unit.empty() ? unit_in_brackets(cell.text) : unit;
  if (name.empty() && column < units_.size()) name = without_brackets(units_[column].text);
  const auto usual = field_units_.find(quantity.name);
  if (name.empty() && cell.text == quantity.name && usual != field_units_.end()) {
    name = usual->second;
  }
  const auto in_header = unit_factor(quantity.dimension, unit_in_brackets(cell.text));
  const auto in_map = unit_factor(quantity.dimension, unit);
  if (in_header && in_map && *in_header != *in_map) {
    throw InputError(cell.in(file_), fmt::format("--map {} states {}", quantity.name, quote(unit)),
                     fmt::format("the header states {}", quote(unit_in_brackets(cell.text))),
                     "leave the unit out of --map, or correct the header");
  }
  // "0.35mm", or a factor to SI: "0.0254"
  const auto factor = number_and_unit(name);
  if (factor) name = factor->second;
  const bool pure =
      quantity.dimension == Dimension::count || quantity.dimension == Dimension::ratio;
  if (name.empty() && pure) name = "1";
  if (name.empty() && factor) return {factor->first};
  if (name.empty()) {
    throw InputError(
        cell.in(file_), fmt::format("the unit of {} is not stated", quote(cell.text)), "",
        fmt::format(
            "write --map {}, or the unit in the header, as in V [m/s]",
            shell_word(fmt::format("{}=\"{}\":UNIT", quantity.name, shortened(cell.text, 40)))));
  }
  Scale scale = known_scale(quantity.dimension, name, quantity.name, cell.in(file_));
  if (factor) scale.factor *= factor->first;
  return scale;
}

const CsvField* ImportTable::cell_of(std::size_t row, const std::string& quantity) const {
  const auto found = columns_.find(quantity);
  if (found == columns_.end() || found->second.at.empty()) return nullptr;
  const std::vector<std::size_t>& columns = found->second.at;
  return &cells(row)[columns[std::min(row % replicates_, columns.size() - 1)]];
}

const Scale& ImportTable::scale_in(std::size_t row, const Source& source) const {
  return source.scale[std::min(row % replicates_, source.scale.size() - 1)];
}

bool ImportTable::lacks(std::size_t row, const std::string& quantity) const {
  const CsvField* const cell = cell_of(row, quantity);
  return cell != nullptr && is_unknown(cell->text);
}

bool ImportTable::has_beside(const std::string& quantity) const {
  if (!quantity.ends_with("_sd")) return false;
  return std::ranges::any_of(columns_, [&](const auto& column) {
    const auto& [other, source] = column;
    if (error_name(other) != quantity || source.scale.empty()) return false;
    for (std::size_t row = 0; row < size(); ++row) {
      if (!value_and_error(cell_of(row, other)->text).second.empty()) return true;
    }
    return false;
  });
}

bool ImportTable::is_named(const std::string& quantity) const {
  const auto found = columns_.find(quantity);
  return found != columns_.end() && !found->second.at.empty() &&
         header_[found->second.at.front()].text.starts_with(quantity);
}

std::vector<ImportNote> ImportTable::notes() const {
  std::vector<ImportNote> notes = notes_;
  if (!found_.empty()) notes.push_back({ImportRemark::columns_known, found_});
  if (left_out_.empty()) return notes;
  if (left_out_.size() == size()) {
    throw InputError({file_, line(0), 1}, "every row has an empty cell", "no point is left",
                     "check the columns that --map names");
  }
  std::vector<std::string> lines;
  for (const std::size_t row : left_out_) {
    const std::string name = fmt::format("line {}", line(row));
    if (lines.empty() || lines.back() != name) lines.push_back(name);
  }
  notes.push_back({ImportRemark::rows_left_out, lines, left_out_.size()});
  return notes;
}

std::optional<double> ImportTable::value(std::size_t row, const std::string& quantity) const {
  const auto found = columns_.find(quantity);
  if (found == columns_.end()) return error_beside(row, quantity);
  if (found->second.constant) return found->second.constant;
  const CsvField& cell = *cell_of(row, quantity);
  if (const auto number = parse_number(cell.text, format_)) {
    return scale_in(row, found->second)(*number);
  }
  if (is_unknown(cell.text)) return std::nullopt;
  const auto [text, error] = value_and_error(cell.text);
  if (!error.empty()) {
    const std::string sd = error_name(quantity);
    const bool takes = std::ranges::find(known_, sd, &ImportQuantity::name) != known_.end();
    if (!takes || has(sd)) {
      fail(row, quantity, fmt::format("{} is a value and its error", quote(cell.text)),
           takes ? fmt::format("{} has a column of its own", sd)
                 : fmt::format("no error of {} is read", quantity),
           takes ? "remove one of the two" : "remove the error");
    }
  }
  return scale_in(
      row, found->second)(number_in({text, cell.line, cell.column}, file_, quantity, format_));
}

/// The standard deviation in the cell of its quantity: 0.02 in "0.85 ± 0.02".
std::optional<double> ImportTable::error_beside(std::size_t row,
                                                const std::string& quantity) const {
  if (!quantity.ends_with("_sd")) return std::nullopt;
  for (const auto& [other, source] : columns_) {
    if (error_name(other) != quantity || source.scale.empty()) continue;
    const CsvField& cell = *cell_of(row, other);
    const std::string error = value_and_error(cell.text).second;
    if (error.empty()) continue;
    return number_in({error, cell.line, cell.column}, file_, quantity, format_) *
           scale_in(row, source).factor;
  }
  return std::nullopt;
}

double ImportTable::needed(std::size_t row, const std::string& quantity) const {
  if (const auto known = value(row, quantity)) return *known;
  fail(row, quantity, fmt::format("{} is empty", quantity), "", "fill it in or remove the row");
}

double ImportTable::positive(std::size_t row, const std::string& quantity) const {
  const double known = needed(row, quantity);
  if (known > 0.0) return known;
  fail(row, quantity, fmt::format("{} = {:g}", quantity, known), "it has to be positive",
       "correct it, or leave the cell empty");
}

std::string ImportTable::text(std::size_t row, const std::string& quantity) const {
  const auto found = columns_.find(quantity);
  if (found == columns_.end()) return "";
  std::string joined;
  for (const std::size_t column : found->second.at) {
    if (!joined.empty()) joined += '/';
    joined += cells(row)[column].text;
  }
  return joined;
}

std::string ImportTable::name(std::size_t row, const std::string& quantity) const {
  const std::string own = text(row, quantity);
  return own.empty() ? series_ : own;
}

void ImportTable::require_one_of(const std::string& one, const std::string& other,
                                 const std::string& how) const {
  if (has(one) != has(other)) return;
  throw InputError({file_, header_.front().line, 1},
                   has(one) ? fmt::format("both {} and {} are there", one, other)
                            : fmt::format("which column is the {}?", one),
                   "", how);
}

void ImportTable::fail(std::size_t row, const std::string& quantity, const std::string& problem,
                       const std::string& why, const std::string& suggestion) const {
  const CsvField* const cell = cell_of(row, quantity);
  throw InputError((cell != nullptr ? *cell : cells(row).front()).in(file_), problem, why,
                   suggestion);
}

std::string ImportTable::exchanged_map(const std::string& quantity) const {
  const Source& source = columns_.at(quantity);
  const bool labelled = std::ranges::count(source.at, std::size_t{0}) == 0;
  // Labels in the first column become a header, unless they are numbers.
  const bool named = labelled && !std::ranges::all_of(rows_, [&](const CsvRow& row) {
                       return row.front().text.empty() || parse_number(row.front().text, format_);
                     });
  std::vector<std::string> names;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    // Without a header the first column is that of the names above the columns.
    std::string name = named ? rows_[r].front().text : std::to_string(r + (named_ ? 2 : 1));
    if (name.find_first_of(",+=:") != std::string::npos) name = '"' + name + '"';
    names.push_back(name);
  }
  const auto known = std::ranges::find(known_, quantity, &ImportQuantity::name);
  std::string unit = si_unit(known->dimension);
  if (const double factor = source.scale.front().factor; factor != 1.0) {
    unit = fmt::format("{:.9g}{}", factor, unit);
  }
  const std::string launch = named ? header_.front().text : named_ ? "1" : "";
  return fmt::format("{}{}={}:{}", launch.empty() ? "" : "launch=" + launch + ",", quantity,
                     fmt::join(names, "+"), unit);
}

std::vector<std::string> ImportTable::unused() const {
  std::set<std::size_t> used;
  for (const auto& [quantity, source] : columns_) used.insert(source.at.begin(), source.at.end());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < header_.size(); ++i) {
    const auto filled = [&](const CsvRow& row) { return !row[i].text.empty(); };
    if (used.contains(i) || (header_[i].text.empty() && std::ranges::none_of(rows_, filled))) {
      continue;
    }
    names.push_back(header_[i].text.empty() ? fmt::format("{} (no header)", i + 1)
                                            : header_[i].text);
  }
  return names;
}

}  // namespace recoil
