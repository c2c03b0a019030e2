#include "data/dataset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <system_error>
#include <tuple>
#include <utility>

#include "core/files.hpp"
#include "data/csv.hpp"
#include "data/datapackage.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_package = 16ULL * 1024 * 1024;  ///< [bytes]

/// Reads the rows of the CSV file into the series, points and warnings of a dataset.
class PointReader {
 public:
  PointReader(const std::string& file, const Package& package, Dataset& dataset)
      : file_(file), package_(package), dataset_(dataset) {}

  void read_row(const CsvRow& row) {
    if (header_.empty()) {
      if (package_.header) {
        read_header(row);
        return;
      }
      for (const Column& column : package_.columns) {
        field_of_[column.quantity] = header_.size();
        header_.push_back(&column);
      }
    }
    require_width(row, header_.size(), file_);
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
    refuse_impossible_sd();
    remark_repeated();
    remark_tiny();
    name_series();
    for (const auto& [remark, warning] : warnings_) dataset_.warnings.push_back(warning);
  }

 private:
  [[noreturn]] void fail(const CsvField& cell, const std::string& problem, const std::string& why,
                         const std::string& suggestion) const {
    throw InputError(cell.in(file_), problem, why, suggestion);
  }

  void read_header(const CsvRow& row) {
    header_line_ = row.front().line;
    std::vector<std::string> names;
    for (const Column& column : package_.columns) names.push_back(column.name);
    for (const CsvField& cell : row) {
      const auto column = std::ranges::find(names, cell.text);
      if (column == names.end()) {
        const bool other_delimiter =
            row.size() == 1 && cell.text.find_first_of(",;\t|") != std::string::npos;
        fail(cell, fmt::format("the column {} is not in the schema", quote(cell.text)),
             "so its meaning and unit are not known",
             other_delimiter ? "state the delimiter under 'dialect' of the resource"
                             : did_you_mean(cell.text, names));
      }
      const Column& known = package_.columns[static_cast<std::size_t>(column - names.begin())];
      if (std::exchange(field_of_[known.quantity], header_.size())) {
        fail(cell, fmt::format("the column '{}' appears twice", cell.text), "",
             "remove or rename one");
      }
      header_.push_back(&known);
    }
    for (const Column& column : package_.columns) {
      if (field_of_[column.quantity]) continue;
      throw InputError({file_, header_line_, 1},
                       fmt::format("the column '{}' is missing", column.name),
                       "the schema in datapackage.json lists it",
                       "add the column, or remove it from the schema");
    }
  }

  /// Refuses a standard deviation a thousand times below the median, which would force the fit
  /// through one point.
  void refuse_impossible_sd() const {
    constexpr double most_ratio = 1000.0;
    if (stated_sd_.size() < 3) return;
    std::vector<StatedSd> sorted = stated_sd_;
    std::ranges::sort(sorted, {}, &StatedSd::of_impact);
    const StatedSd& least = sorted.front();
    const double middle = sorted[sorted.size() / 2].of_impact;
    if (!(least.of_impact * most_ratio < middle)) return;
    throw InputError({file_, least.line, least.column},
                     fmt::format("restitution_sd = {:g}", least.stated),
                     fmt::format("that of a single impact is {:.2g} times smaller than usual here",
                                 middle / least.of_impact),
                     "correct it, or leave the cell empty when it is not known");
  }

  bool has(Quantity quantity) const { return field_of_[quantity].has_value(); }

  const CsvField& field(Quantity quantity) const { return (*row_)[field_of_[quantity].value()]; }

  const Column& column(Quantity quantity) const { return *header_[field_of_[quantity].value()]; }

  /// The cell of a quantity; null if there is no such column or the value is missing.
  const CsvField* cell(Quantity quantity) const {
    if (!has(quantity)) return nullptr;
    const CsvField& found = field(quantity);
    const auto& missing = column(quantity).missing_values;
    const bool unknown =
        found.text.empty() || std::ranges::find(missing, found.text) != missing.end();
    if (unknown && column(quantity).required) {
      fail(found, fmt::format("'{}' is empty", column(quantity).name),
           "the schema says that it is required", "fill it in or remove the row");
    }
    return unknown ? nullptr : &found;
  }

  /// The value in the unit of the file.
  double stated(const CsvField& cell, const Column& column) const {
    if (column.boolean) {
      const auto among = [&](const std::vector<std::string>& words) {
        return std::ranges::find(words, cell.text) != words.end();
      };
      if (among(column.yes)) return 1.0;
      if (among(column.no)) return 0.0;
      fail(cell, fmt::format("{} is neither true nor false", quote(cell.text)),
           "the schema says boolean",
           fmt::format("write {} or {}", join(column.yes), join(column.no)));
    }
    const auto parsed = parse_number(cell.text, column.format);
    const double value =
        parsed ? *parsed
               : number_in(cell, file_,
                           fmt::format("'{}'{}", column.name,
                                       column.unit.empty() ? "" : " in " + column.unit),
                           column.format);
    if (value < column.minimum.value_or(value) || value > column.maximum.value_or(value)) {
      const bool low = value < column.minimum.value_or(value);
      fail(cell, fmt::format("{} = {}", column.name, printable(cell.text)),
           fmt::format("the schema's {} is {:g}", low ? "minimum" : "maximum",
                       low ? *column.minimum : *column.maximum),
           "correct it, or the constraint");
    }
    if (column.integer && value != std::trunc(value)) {
      fail(cell, fmt::format("{} = {} is not a whole number", column.name, printable(cell.text)),
           "the schema says integer, or it counts impacts", "write 1, 2, 3, ...");
    }
    return value;
  }

  /// The value in SI, which has to be in the range; nullopt if it is missing.
  std::optional<double> value(Quantity quantity, const Range& range) const {
    const CsvField* const found = cell(quantity);
    if (found == nullptr) return std::nullopt;
    const Column& col = column(quantity);
    const double given = stated(*found, col);
    const double converted = col.scale(given);
    if (range.contains(converted)) return converted;
    const std::string problem = fmt::format("{} = {:g}{}", col.name, given, unit_suffix(col.unit));
    if (range.lower >= 0.0 && (converted < 0.0 || (converted == 0.0 && range.lower > 0.0))) {
      const bool optional = name_of(quantity).ends_with("_sd");
      fail(*found, problem, range.lower > 0.0 ? "it has to be positive" : "it cannot be negative",
           optional                                ? "leave the cell empty when it is not known"
           : quantity == Quantity::incidence_angle ? "write its magnitude"
                                                   : "correct it or remove the row");
    }
    fail(*found, problem, range.sentence(), range.hint_for(converted));
  }

  [[noreturn]] void fail_empty(Quantity quantity, const std::string& why) const {
    fail(field(quantity), fmt::format("'{}' is empty", column(quantity).name), why,
         "fill it in or remove the row");
  }

  double needed(Quantity quantity, const Range& range) const {
    if (const auto known = value(quantity, range)) return *known;
    fail_empty(quantity, "every point needs it");
  }

  int count(Quantity quantity, const Range& range, int fallback) const {
    return static_cast<int>(value(quantity, range).value_or(fallback));
  }

  Conditions stated_conditions() const {
    Conditions stated;
    for (const Condition condition : values_of<Condition>()) {
      const auto found = value(quantity_of(condition), info_of(condition));
      if (found) stated.set(condition, *found);
    }
    return stated;
  }

  /// The index of this row's series. Rows with the same name and different conditions have
  /// different series.
  std::size_t series_index() {
    const CsvField* const name = cell(Quantity::series);
    if (name == nullptr) {
      fail(field(Quantity::series), "'series' is empty", "points are grouped by it",
           "give the series a name");
    }
    const bool again = last_series_ != series_of_.end() && last_series_->first.first == name->text;
    if (!again && printable(name->text) != name->text) {
      fail(*name, "the name of the series has control characters", "",
           "use letters, digits and blanks");
    }
    const Conditions stated = stated_conditions();
    if (again && last_series_->first.second == stated) return last_series_->second;
    const auto [known, added] =
        series_of_.try_emplace(std::pair(name->text, stated), dataset_.series.size());
    if (added) {
      dataset_.series.push_back(name->text);
      dataset_.series_conditions.push_back(stated);
    }
    last_series_ = known;
    return known->second;
  }

  /// Appends the conditions in which series differ to the names of series with the same name.
  void name_series() {
    std::map<std::string, std::vector<std::size_t>> groups;
    for (std::size_t s = 0; s < dataset_.series.size(); ++s) {
      groups[dataset_.series[s]].push_back(s);
    }
    for (const auto& [name, members] : groups) {
      const Conditions& first = dataset_.series_conditions[members.front()];
      std::vector<Condition> differing;
      for (const Condition condition : values_of<Condition>()) {
        if (std::ranges::any_of(members, [&](std::size_t s) {
              return dataset_.series_conditions[s].of(condition) != first.of(condition);
            })) {
          differing.push_back(condition);
        }
      }
      if (differing.empty()) continue;
      for (const std::size_t s : members) {
        std::vector<std::string> words;
        for (const Condition condition : differing) {
          const auto mine = dataset_.series_conditions[s].of(condition);
          words.push_back(mine ? fmt::format("{} {:g}{}", name_of(condition), *mine,
                                             unit_suffix(info_of(condition).unit))
                               : fmt::format("{} not stated", name_of(condition)));
        }
        dataset_.series[s] += fmt::format(" ({})", join(words));
      }
    }
  }

  /// The restitution of a point. 0 if all spheres were captured, and if only counts are known
  /// (`restitution` or `rebound_velocity` is empty beside `events` and `captured`).
  double restitution(ImpactPoint& point) const {
    const bool rebound = has(Quantity::rebound_velocity);
    const Quantity quantity = rebound ? Quantity::rebound_velocity : Quantity::restitution;
    constexpr double largest = limits::restitution.upper;
    std::optional<double> known;
    if (rebound) {
      known = value(quantity,
                    {0.0, largest * point.incident_velocity, "m/s",
                     point.incidence_angle > 0.0
                         ? "give the normal component of the rebound: it is at most 1.2 times "
                           "that of the incident velocity"
                         : "it is at most 1.2 times the incident velocity: correct one of "
                           "them, or its unit"});
      if (known) known = std::min(*known / point.incident_velocity, largest);
    } else if (has(quantity)) {
      Range range = limits::restitution;
      range.hint = "a rebound is not faster than the impact: correct it; in per cent its unit is %";
      known = value(quantity, range);
    }
    if (known == 0.0 && !point.counted) point.captured = point.events;
    if (point.all_captured()) {
      if (known.value_or(0.0) == 0.0) return 0.0;
      fail(field(quantity),
           fmt::format("a rebound of {} although all were captured", quote(field(quantity).text)),
           "the mean is that of the spheres that rebounded",
           "write 0 or leave the cell empty, or correct 'captured'");
    }
    if (known == 0.0) {
      fail(field(quantity),
           fmt::format("a rebound of 0 although 'captured' is {} of {}", point.captured,
                       point.events),
           "a sphere that does not rebound is captured",
           "correct 'captured', or leave the cell empty if the rebounds were only counted");
    }
    point.counts_only = !known && point.counted && cell(Quantity::events) != nullptr;
    if (known || point.counts_only) return known.value_or(0.0);
    if (has(quantity)) {
      fail_empty(quantity, "not all spheres of this point were captured");
    }
    fail_empty(point.counted ? Quantity::events : Quantity::captured,
               "without a rebound every point needs it");
  }

  /// The angle of this row from the normal [rad]; 0 without such a column.
  double incidence_angle() const {
    if (!has(Quantity::incidence_angle)) return 0.0;
    if (const auto angle = value(Quantity::incidence_angle, limits::incidence_angle)) return *angle;
    fail(field(Quantity::incidence_angle),
         fmt::format("'{}' is empty", column(Quantity::incidence_angle).name),
         "the normal component of the velocity is fitted",
         "write 0 for an impact along the normal, or remove the row");
  }

  /// V_n = V cos(angle) of this row [m/s].
  double normal_velocity(double cosine) const {
    const double normal = needed(Quantity::incident_velocity, limits::velocity) * cosine;
    if (limits::velocity.contains(normal)) return normal;
    fail(field(Quantity::incidence_angle), fmt::format("a normal velocity of {:g} m/s", normal),
         limits::velocity.sentence(), std::string(limits::incidence_angle.hint));
  }

  std::optional<double> tangential_restitution(const ImpactPoint& point) const {
    const auto known = value(Quantity::tangential_restitution, limits::tangential_restitution);
    if (!known || (point.incidence_angle > 0.0 && !point.all_captured())) return known;
    const bool captured = point.all_captured();
    fail(field(Quantity::tangential_restitution),
         fmt::format("a tangential restitution {}",
                     captured ? "although all were captured" : "at an angle of 0"),
         captured ? "it is that of the spheres that rebounded"
                  : "a sphere along the normal has no tangential velocity",
         "leave the cell empty");
  }

  void read_point() {
    ImpactPoint point;
    point.line = row_->front().line;
    point.series = series_index();
    point.diameter = needed(Quantity::diameter, limits::diameter);
    point.incidence_angle = incidence_angle();
    const double cosine = std::cos(point.incidence_angle);
    point.incident_velocity = normal_velocity(cosine);
    point.events = count(Quantity::events, limits::events, 1);
    point.captured = count(Quantity::captured,
                           {0.0, static_cast<double>(point.events), "impacts",
                            "'captured' is a part of 'events', which is 1 when it is not given"},
                           0);
    point.counted = cell(Quantity::captured) != nullptr;
    if (point.counted && column(Quantity::captured).boolean && point.events > 1) {
      fail(field(Quantity::captured), "'captured' is true or false of a single impact",
           fmt::format("this point averages {} impacts", point.events),
           "write how many were captured, and \"type\": \"integer\" in the schema");
    }
    point.restitution = restitution(point);
    point.restitution_sd = value(Quantity::restitution_sd, limits::restitution_sd);
    if (point.restitution_sd) {
      const int impacts = std::max(1, point.events - point.captured);
      const CsvField& sd = field(Quantity::restitution_sd);
      stated_sd_.push_back(
          {*point.restitution_sd * std::sqrt(impacts), *point.restitution_sd, sd.line, sd.column});
    }
    point.tangential_restitution = tangential_restitution(point);
    point.velocity_sd = value(Quantity::velocity_sd, limits::velocity_sd);
    point.setting_velocity_sd = value(Quantity::setting_velocity_sd, limits::velocity_sd);
    for (auto* const sd : {&point.velocity_sd, &point.setting_velocity_sd}) {
      if (*sd) **sd *= cosine;
    }
    point.diameter_sd = value(Quantity::diameter_sd, limits::diameter_sd);
    point.series_diameter_sd = value(Quantity::series_diameter_sd, limits::diameter_sd);
    if (const CsvField* const setting = cell(Quantity::setting)) point.setting = setting->text;
    if (const CsvField* const launch = cell(Quantity::launch)) point.launch = launch->text;
    remark(point);
    dataset_.points.push_back(point);
  }

  void add(PointRemark remark, int line) {
    DatasetWarning& warning = warnings_[remark];
    warning = {remark, warning.count + 1, warning.count == 0 ? line : warning.first_line,
               warning.largest};
  }

  void remark(const ImpactPoint& point) {
    if (point.restitution > 1.0) add(PointRemark::restitution_above_one, point.line);
    if (point.all_captured() && !point.counted) add(PointRemark::unmarked_zero, point.line);
    const Method method = package_.system.method;
    const bool balls = method == Method::drop_heights || method == Method::bounce_intervals;
    if (point.diameter > limits::unusual_diameter && !balls) {
      add(PointRemark::unusual_diameter, point.line);
    }
    const auto above_velocity = [&](const std::optional<double>& sd) {
      return sd.value_or(0.0) > point.incident_velocity;
    };
    if (above_velocity(point.velocity_sd) || above_velocity(point.setting_velocity_sd)) {
      add(PointRemark::error_above_velocity, point.line);
    }
    if (point.incidence_angle > (1.0 + 1e-12) * limits::usual_incidence_angle) {
      add(PointRemark::oblique, point.line);
      double& largest = warnings_[PointRemark::oblique].largest;
      largest = std::max(largest, point.incidence_angle);
    }
  }

  /// Values of e that are all tiny are in per cent, or velocities in different units.
  void remark_tiny() {
    constexpr double tiny = 0.02;
    std::vector<int> lines;
    for (const ImpactPoint& point : dataset_.points) {
      if (point.restitution > tiny) return;
      if (point.restitution > 0.0) lines.push_back(point.line);
    }
    for (const int line : lines) add(PointRemark::tiny_restitution, line);
  }

  /// Repeated drops with one setting may give the same reading; others are remarked.
  void remark_repeated() {
    using Reading = std::tuple<double, double, double, std::size_t>;
    std::vector<std::pair<Reading, int>> sorted;
    for (const ImpactPoint& p : dataset_.points) {
      if (!p.setting.empty()) continue;
      sorted.push_back({{p.incident_velocity, p.restitution, p.diameter, p.series}, p.line});
    }
    std::ranges::sort(sorted);
    std::vector<int> lines;
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      if (sorted[i].first == sorted[i - 1].first) lines.push_back(sorted[i].second);
    }
    std::ranges::sort(lines);
    for (const int line : lines) add(PointRemark::repeated, line);
  }

  const std::string& file_;
  const Package& package_;
  Dataset& dataset_;
  const CsvRow* row_ = nullptr;
  int header_line_ = 1;
  std::vector<const Column*> header_;  ///< of each field of a row
  PerValue<Quantity, std::optional<std::size_t>> field_of_;
  std::map<std::pair<std::string, Conditions>, std::size_t> series_of_;
  decltype(series_of_)::const_iterator last_series_ = series_of_.end();
  std::map<PointRemark, DatasetWarning> warnings_;
  struct StatedSd {
    double of_impact;  ///< sqrt(rebounds) times what is stated [1]
    double stated;     ///< [1]
    int line;
    int column;
  };
  std::vector<StatedSd> stated_sd_;
};

/// The dataset of `package` without points; the checksum is that of the package.
Dataset without_points(const Package& package, const std::string& package_text,
                       const fs::path& folder) {
  Dataset dataset;
  for (const Column& column : package.columns) {
    dataset.columns.push_back({column.name, column.unit});
  }
  dataset.id = package.id;
  dataset.title = package.title;
  dataset.provenance = package.provenance;
  dataset.system = package.system;
  dataset.sources = package.sources;
  dataset.folder = folder;
  dataset.sha256 = checksum_of(package_text, "");
  return dataset;
}

Dataset with_points(const Package& package, const std::string& package_text,
                    const std::string& csv_text, const fs::path& folder) {
  const std::string file = (folder / package.points_path).string();
  require_text(csv_text, file);
  Dataset dataset = without_points(package, package_text, folder);
  dataset.points.reserve(static_cast<std::size_t>(std::ranges::count(csv_text, '\n')));
  PointReader reader(file, package, dataset);
  read_csv(
      csv_text, file, package.delimiter, [&](const CsvRow& row) { reader.read_row(row); },
      package.comment);
  reader.finish();
  dataset.sha256 = checksum_of(package_text, csv_text);
  return dataset;
}

void read_mixed_sizes(const Package& package, const fs::path& folder, Dataset& dataset) {
  const fs::path file = folder / package.mixed_sizes;
  std::error_code failed;
  if (!fs::exists(file, failed)) {
    throw InputError(package.mixed_sizes_where, "there is no file '" + package.mixed_sizes + "'",
                     "every point averages over its sizes", "correct the path or add the file");
  }
  dataset.mixed_sizes = load_sizes(file);
  dataset.sha256 = sha256_hex(dataset.sha256 + dataset.mixed_sizes->sha256);
}

void require_package(const fs::path& folder) {
  std::error_code failed;
  const auto status = fs::status(folder, failed);
  if (!fs::exists(status)) {
    throw InputError({folder.string()}, "no such folder", "", "check the path");
  }
  if (!fs::is_directory(status)) {
    throw InputError({folder.string()}, "this is a file, not a folder",
                     "a dataset is a folder with datapackage.json and its points",
                     "name the folder");
  }
  if (!fs::exists(folder / package_file_name, failed)) {
    throw InputError({(folder / package_file_name).string()}, "no such file",
                     "it describes the dataset", "add it, as in a shipped dataset");
  }
}

/// True if `text` has at most a header.
bool has_no_point(const std::string& text) {
  constexpr const char* blank = " \t\r\n";
  const std::size_t header = text.find_first_not_of(blank);
  const std::size_t end = header == std::string::npos ? header : text.find('\n', header);
  return end == std::string::npos || text.find_first_not_of(blank, end) == std::string::npos;
}

/// Messages quote the points, so that a link must not lead to a file of somebody else.
void require_inside(const fs::path& file, const fs::path& folder) {
  std::error_code failed;
  const fs::path place = fs::weakly_canonical(file, failed);
  const fs::path inside = fs::relative(place, fs::weakly_canonical(folder, failed), failed);
  if (failed || *inside.begin() != "..") return;
  throw InputError({file.string()}, fmt::format("this is a link to {}", place.string()),
                   "points have to be in the folder of their dataset", "copy the file here");
}

Dataset load(const fs::path& folder, bool may_lack_points) {
  require_package(folder);
  const fs::path package_file = folder / package_file_name;
  const std::string package_text = read_text_file(package_file, largest_package);
  const Package package = read_package(package_text, package_file.string(), name_of_folder(folder));
  const fs::path points_file = folder / package.points_path;
  std::error_code failed;
  const bool missing = !fs::exists(points_file, failed);
  if (missing && !may_lack_points) {
    throw InputError(package.points_where, "there is no file '" + package.points_path + "'", "",
                     "correct the path or add the file");
  }
  if (!missing) require_inside(points_file, folder);
  std::string bytes = missing ? "" : read_bytes(points_file);
  const auto size = static_cast<double>(bytes.size());
  const bool other_bytes = package.points_bytes.value_or(size) != size ||
                           (!package.points_hash.empty() &&
                            package.points_hash != hash_hex(package.points_hash_algorithm, bytes));
  const std::string csv_text = as_text(std::move(bytes), points_file);
  if (may_lack_points && has_no_point(csv_text)) {
    return without_points(package, package_text, folder);
  }
  Dataset dataset = with_points(package, package_text, csv_text, folder);
  if (!package.mixed_sizes.empty()) read_mixed_sizes(package, folder, dataset);
  if (other_bytes) dataset.warnings.push_back({PointRemark::other_bytes, 1, 1});
  return dataset;
}

}  // namespace

Conditions conditions_of(const Dataset& dataset, std::size_t series) {
  if (series >= dataset.series_conditions.size()) return dataset.system.conditions;
  return dataset.series_conditions[series].or_else(dataset.system.conditions);
}

std::vector<double> distinct_diameters(const Dataset& dataset) {
  std::vector<double> diameters;
  for (const ImpactPoint& point : dataset.points) diameters.push_back(point.diameter);
  std::ranges::sort(diameters);
  diameters.erase(std::unique(diameters.begin(), diameters.end()), diameters.end());
  return diameters;
}

std::string name_of_folder(const fs::path& folder) {
  const fs::path plain = folder.lexically_normal();
  const fs::path name = plain.has_filename() ? plain.filename() : plain.parent_path().filename();
  return name.empty() || name == "." || name == ".." ? "dataset" : name.string();
}

Dataset parse_dataset(const std::string& datapackage_text, const std::string& csv_text,
                      const fs::path& folder) {
  const Package package =
      read_package(datapackage_text, (folder / package_file_name).string(), name_of_folder(folder));
  return with_points(package, datapackage_text, csv_text, folder);
}

Dataset load_dataset(const fs::path& folder) { return load(folder, false); }

Dataset load_dataset_to_be_measured(const fs::path& folder) { return load(folder, true); }

std::string checksum_of(const std::string& datapackage_text, const std::string& csv_text) {
  return sha256_hex(datapackage_text + "\n" + csv_text);
}

std::vector<std::string> reconstruction_remarks(const std::vector<Dataset>& datasets) {
  std::vector<std::string> remarks;
  for (const Dataset& dataset : datasets) {
    if (dataset.provenance != Provenance::reconstruction) continue;
    remarks.push_back(dataset.id +
                      " is a reconstruction: a committed recipe (recipe.toml) made its points. "
                      "A diagnosis finds what the recipe put into them. It tests the method and "
                      "shows nothing about the experiment.");
  }
  return remarks;
}

}  // namespace recoil
