#include "data/points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "data/csv_table.hpp"
#include "data/limits.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

/// What a value may be in SI, and what one outside of it usually means.
struct Range {
  double lower;
  double upper;
  std::string unit;  ///< as it ends the sentence: " m/s"
  std::string hint_above;
  std::string hint_below;
};

class PointReader {
 public:
  PointReader(const std::string& file, const Package& package, Dataset& dataset)
      : file_(file), package_(package), dataset_(dataset) {}

  void row(const CsvRow& row) {
    if (header_.empty()) {
      read_header(row);
      return;
    }
    check_width(row);
    row_ = &row;
    read_point();
  }

  void finish() {
    if (header_.empty()) {
      throw InputError({file_, 1, 1}, "the file is empty", "",
                       "give it a header and one line for each point");
    }
    if (dataset_.points.empty()) {
      throw InputError({file_, header_line_, 1}, "there is a header but no point below it", "",
                       "write one line for each point");
    }
    name_series();
    for (const auto& [remark, warning] : warnings_) dataset_.warnings.push_back(warning);
  }

 private:
  [[noreturn]] void fail(const CsvField& cell, const std::string& problem, const std::string& why,
                         const std::string& suggestion) const {
    throw InputError({file_, cell.line, cell.column}, problem, why, suggestion);
  }

  void read_header(const CsvRow& row) {
    header_line_ = row.front().line;
    std::vector<std::string> names;
    for (const Column& column : package_.columns) names.push_back(column.name);
    for (const CsvField& cell : row) {
      const auto column = std::find(names.begin(), names.end(), cell.text);
      if (column == names.end()) {
        const bool other_delimiter =
            row.size() == 1 && cell.text.find_first_of(",;\t|") != std::string::npos;
        fail(cell, fmt::format("the column {} is not in the schema", quote(cell.text)),
             "so its meaning and unit are not known",
             other_delimiter ? "state the delimiter under 'dialect' of the resource"
                             : did_you_mean(cell.text, names));
      }
      const auto index = static_cast<std::size_t>(column - names.begin());
      if (std::find(header_.begin(), header_.end(), index) != header_.end()) {
        fail(cell, fmt::format("the column '{}' appears twice", cell.text), "",
             "remove or rename one");
      }
      field_of_[package_.columns[index].quantity] = header_.size();
      header_.push_back(index);
    }
    for (const Column& column : package_.columns) {
      if (!field_of_.contains(column.quantity)) {
        throw InputError({file_, header_line_, 1},
                         fmt::format("the column '{}' is missing", column.name),
                         "the schema in datapackage.json lists it",
                         "add the column, or remove it from the schema");
      }
    }
  }

  void check_width(const CsvRow& row) const {
    if (row.size() == header_.size()) return;
    const bool too_many = row.size() > header_.size();
    fail(too_many ? row[header_.size()] : row.back(),
         fmt::format("this row has {} cell{}", row.size(), row.size() == 1 ? "" : "s"),
         fmt::format("the header has {}", header_.size()),
         too_many ? "write decimals with a point (1.5), and quote text that has commas"
                  : "leave a cell empty when its value is not known, but keep the comma");
  }

  /// The cell of a quantity; nothing when there is no such column or the cell says "not known".
  const CsvField* cell(Quantity quantity) const {
    const auto found = field_of_.find(quantity);
    if (found == field_of_.end()) return nullptr;
    const CsvField& field = (*row_)[found->second];
    const auto& missing = package_.missing_values;
    const bool unknown = field.text.empty() ||
                         std::find(missing.begin(), missing.end(), field.text) != missing.end();
    return unknown ? nullptr : &field;
  }

  const Column& column(Quantity quantity) const {
    return package_.columns[header_[field_of_.at(quantity)]];
  }

  /// The value as the file states it, before conversion.
  double stated(const CsvField& field, const Column& column) const {
    const std::optional<double> value = parse_number(field.text);
    if (!value) not_a_number(field, column);
    if (column.integer && *value != std::trunc(*value)) {
      fail(field, fmt::format("{} = {} is not a whole number", column.name, printable(field.text)),
           "the schema says integer, or it counts impacts", "write 1, 2, 3, ...");
    }
    return *value;
  }

  [[noreturn]] void not_a_number(const CsvField& field, const Column& column) const {
    std::string word = field.text;
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::string suggestion = "write a decimal number such as 4.9 or 4.9e-6";
    const std::size_t comma = word.find(',');
    if (comma != std::string::npos) {
      word[comma] = '.';
      suggestion = parse_number(word) ? fmt::format("a decimal comma? write {}", word)
                                      : "write decimals with a point";
    } else if (word.find("nan") != std::string::npos || word.find("inf") != std::string::npos ||
               word == "na" || word == "null" || word == "-") {
      suggestion = "remove the row, or leave the cell empty if the column is optional";
    }
    fail(field, fmt::format("{} is not a number", quote(field.text)),
         fmt::format("'{}' has to be a finite number{}", column.name,
                     column.unit.empty() ? "" : " in " + column.unit),
         suggestion);
  }

  /// A value in SI that has to lie in the range.
  std::optional<double> value(Quantity quantity, const Range& range) const {
    const CsvField* const field = cell(quantity);
    if (field == nullptr) return std::nullopt;
    const Column& col = column(quantity);
    const double given = stated(*field, col);
    const double converted = given * col.factor;
    if (converted >= range.lower && converted <= range.upper) return converted;
    const std::string problem = fmt::format("{} = {:g}{}", col.name, given, unit_suffix(col.unit));
    if (given < 0.0 || (given == 0.0 && range.lower > 0.0)) {
      const bool optional = quantity == Quantity::restitution_sd ||
                            quantity == Quantity::velocity_sd || quantity == Quantity::diameter_sd;
      fail(*field, problem, range.lower > 0.0 ? "it has to be positive" : "it cannot be negative",
           optional ? "leave the cell empty when it is not known" : "correct it or remove the row");
    }
    fail(*field, problem,
         fmt::format("it has to lie between {:g} and {:g}{}", range.lower, range.upper, range.unit),
         converted > range.upper ? range.hint_above : range.hint_below);
  }

  double needed(Quantity quantity, const Range& range) const {
    if (const auto known = value(quantity, range)) return *known;
    fail((*row_)[field_of_.at(quantity)], fmt::format("'{}' is empty", column(quantity).name),
         "every point needs it", "fill it in or remove the row");
  }

  int count(Quantity quantity, const Range& range, int fallback) const {
    return static_cast<int>(value(quantity, range).value_or(fallback));
  }

  /// What this row states of its conditions.
  Conditions conditions() const {
    Conditions stated;
    for (const Condition condition : values_of<Condition>()) {
      const ConditionInfo& info = info_of(condition);
      const std::string hint(info.hint);
      const auto found =
          value(quantity_of(condition),
                {info.lower, info.upper, unit_suffix(std::string(info.unit)), hint, hint});
      if (found) stated.set(condition, *found);
    }
    return stated;
  }

  /// The series of this row: the one that it names, under the conditions that it states.
  std::size_t series_index() {
    const CsvField* const field = cell(Quantity::series);
    if (field == nullptr) {
      fail((*row_)[field_of_.at(Quantity::series)], "'series' is empty", "points are grouped by it",
           "give the series a name");
    }
    if (printable(field->text) != field->text) {
      fail(*field, "the name of the series has control characters", "",
           "use letters, digits and blanks");
    }
    const Conditions stated = conditions();
    const auto [known, added] =
        series_of_.try_emplace(std::pair(field->text, stated), dataset_.series.size());
    if (added) {
      dataset_.series.push_back(field->text);
      dataset_.series_conditions.push_back(stated);
    }
    return known->second;
  }

  /// Series of one name in the file are told apart by the conditions in which they differ.
  void name_series() {
    const std::vector<std::string> names = dataset_.series;
    for (std::size_t s = 0; s < names.size(); ++s) {
      std::string differing;
      for (const Condition condition : values_of<Condition>()) {
        const auto mine = dataset_.series_conditions[s].of(condition);
        bool differs = false;
        for (std::size_t other = 0; other < names.size(); ++other) {
          differs = differs || (names[other] == names[s] &&
                                dataset_.series_conditions[other].of(condition) != mine);
        }
        if (!differs) continue;
        differing += differing.empty() ? "" : ", ";
        differing += mine ? fmt::format("{} {:g}{}", name_of(condition), *mine,
                                        unit_suffix(info_of(condition).unit))
                          : fmt::format("{} not stated", name_of(condition));
      }
      if (!differing.empty()) dataset_.series[s] += fmt::format(" ({})", differing);
    }
  }

  /// e, or nothing when the cell is empty.
  std::optional<double> restitution(double incident) const {
    constexpr double largest = limits::largest_restitution;
    if (!field_of_.contains(Quantity::rebound_velocity)) {
      return value(Quantity::restitution,
                   {0.0, largest, ", since only noise can bring it above 1",
                    "correct it; a restitution in per cent has the unit %", ""});
    }
    const auto rebound = value(Quantity::rebound_velocity,
                               {0.0, largest * incident, " m/s, 1.2 times the incident velocity",
                                "correct it, its unit or the incident velocity", ""});
    if (!rebound) return std::nullopt;
    return std::min(*rebound / incident, largest);
  }

  double checked_restitution(const ImpactPoint& point) const {
    const Quantity quantity = field_of_.contains(Quantity::rebound_velocity)
                                  ? Quantity::rebound_velocity
                                  : Quantity::restitution;
    const std::optional<double> known = restitution(point.incident_velocity);
    const CsvField& field = (*row_)[field_of_.at(quantity)];
    if (point.all_captured()) {
      if (known.value_or(0.0) == 0.0) return 0.0;
      fail(field, fmt::format("a rebound of {} although all were captured", quote(field.text)),
           "the mean is that of the spheres that rebounded",
           "write 0 or leave the cell empty, or correct 'captured'");
    }
    if (known) return *known;
    fail(field, fmt::format("'{}' is empty", column(quantity).name),
         "not all spheres of this point were captured", "fill it in or remove the row");
  }

  void read_point() {
    ImpactPoint point;
    point.line = row_->front().line;
    point.series = series_index();
    point.diameter =
        needed(Quantity::diameter, {limits::smallest_diameter, limits::largest_diameter, " m",
                                    "the unit is probably um", "the unit is probably m"});
    point.incident_velocity =
        needed(Quantity::incident_velocity, {limits::slowest_velocity, limits::fastest_velocity,
                                             " m/s", "check the unit", "check the unit"});
    point.events =
        count(Quantity::events,
              {1.0, limits::most_events, " impacts", "split the point", "count the impacts"}, 1);
    const std::string captured_hint =
        "'captured' is a part of 'events', which is 1 when it is not given";
    point.captured = count(
        Quantity::captured,
        {0.0, static_cast<double>(point.events), ", the events of this point", captured_hint, ""},
        0);
    point.counted = cell(Quantity::captured) != nullptr;
    point.restitution = checked_restitution(point);
    point.restitution_sd = value(
        Quantity::restitution_sd,
        {limits::smallest_restitution_sd, limits::largest_restitution_sd, "",
         "a deviation in per cent has the unit %", "leave the cell empty when it is not known"});
    point.velocity_sd = value(Quantity::velocity_sd,
                              {limits::slowest_velocity_sd, limits::fastest_velocity, " m/s",
                               "check the unit", "leave the cell empty when it is not known"});
    point.diameter_sd =
        value(Quantity::diameter_sd,
              {limits::smallest_diameter_sd, limits::largest_diameter, " m",
               "the unit is probably um", "leave the cell empty when it is not known"});
    if (const CsvField* const setting = cell(Quantity::setting)) point.setting = setting->text;
    remark(point);
    dataset_.points.push_back(point);
  }

  void remark(const ImpactPoint& point) {
    const auto add = [&](PointRemark remark) {
      DatasetWarning& warning = warnings_[remark];
      if (warning.count++ == 0) warning = {remark, 1, point.line};
    };
    if (point.restitution > 1.0) add(PointRemark::restitution_above_one);
    if (point.restitution == 0.0 && !point.all_captured()) add(PointRemark::unmarked_zero);
    const Method method = package_.system.method;
    const bool balls = method == Method::drop_heights || method == Method::bounce_intervals;
    if (point.diameter > limits::unusual_diameter && !balls) add(PointRemark::unusual_diameter);
    // Drops of one setting may well read the same.
    if (!point.setting.empty()) return;
    if (!seen_.emplace(point.series, point.diameter, point.incident_velocity, point.restitution)
             .second) {
      add(PointRemark::repeated);
    }
  }

  const std::string& file_;
  const Package& package_;
  Dataset& dataset_;
  const CsvRow* row_ = nullptr;
  int header_line_ = 1;
  std::vector<std::size_t> header_;  ///< per field of a row: its index in package_.columns
  std::map<Quantity, std::size_t> field_of_;
  std::map<std::pair<std::string, Conditions>, std::size_t> series_of_;
  std::set<std::tuple<std::size_t, double, double, double>> seen_;
  std::map<PointRemark, DatasetWarning> warnings_;
};

}  // namespace

void read_points(std::string_view text, const std::string& file, const Package& package,
                 Dataset& dataset) {
  require_text(text, file);
  PointReader reader(file, package, dataset);
  read_csv(text, file, package.delimiter, [&](const CsvRow& row) { reader.row(row); });
  reader.finish();
}

}  // namespace recoil
