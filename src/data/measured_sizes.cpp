#include "data/measured_sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/units.hpp"
#include "data/csv_table.hpp"
#include "data/datapackage.hpp"
#include "data/folder_names.hpp"
#include "data/json_document.hpp"
#include "data/limits.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_sizes = 2000;
constexpr std::size_t no_column = static_cast<std::size_t>(-1);
const std::vector<std::string> weight_names = {"count", "weight", "fraction"};

/// What the package beside the file says of it.
struct SizesResource {
  std::string unit;
  std::string provenance;
  std::string description;
  std::optional<double> probe_height;
};

std::string text_under(const JsonNode& node, const char* key) {
  const auto found = node.find(key);
  return found ? printable(found->string()) : std::string();
}

void read_sizes_resource(const JsonNode& resource, SizesResource& out) {
  out.provenance = text_under(resource, "provenance");
  out.description = text_under(resource, "description");
  if (const auto height = resource.find("probe_height")) {
    out.probe_height = height->number();
    if (!(*out.probe_height >= 0.0 && *out.probe_height <= 1.0)) {
      height->fail(fmt::format("probe_height = {:g} m", *out.probe_height),
                   "it has to lie between 0 and 1 m", "give it in m: 1 mm is 0.001");
    }
  }
  const std::map<std::string, std::string> units = field_units(resource);
  for (const char* column : {"diameter", "lower"}) {
    if (units.contains(column)) out.unit = units.at(column);
  }
}

SizesResource resource_beside(const std::filesystem::path& file) {
  SizesResource out;
  const std::filesystem::path package = file.parent_path() / package_file_name;
  std::error_code failed;
  if (!std::filesystem::exists(package, failed)) return out;
  const std::string text = read_text_file(package);
  require_text(text, package.string());
  const JsonDocument document(text, package.string());
  if (const auto resource = find_resource(document.root(), file.filename().string())) {
    read_sizes_resource(*resource, out);
  }
  return out;
}

class SizesReader {
 public:
  SizesReader(std::string file, double factor) : file_(std::move(file)), factor_(factor) {}

  void row(const CsvRow& row) {
    if (width_ == 0) {
      read_header(row);
      return;
    }
    if (row.size() != width_) {
      fail(row.back(), fmt::format("this row has {} cells", row.size()),
           fmt::format("the header has {}", width_), "give every column a value");
    }
    const double lower = size(row[diameter_ != no_column ? diameter_ : lower_]);
    const double upper = diameter_ != no_column ? lower : size(row[upper_]);
    if (upper < lower) {
      fail(row[upper_], fmt::format("upper = {} lies below lower", row[upper_].text), "",
           "swap them");
    }
    const double weight = weight_ == no_column ? 1.0 : number(row[weight_]);
    if (weight < 0.0) {
      fail(row[weight_], fmt::format("{} particles", row[weight_].text),
           "a count cannot be negative", "correct it");
    }
    if (!(weight > 0.0)) return;
    weights_[{0.5 * (lower + upper), upper - lower}] += weight;
    smallest_ = std::min(smallest_, lower);
    largest_ = std::max(largest_, upper);
  }

  double smallest() const { return smallest_; }
  double largest() const { return largest_; }

  std::vector<SizeBin> finish() const {
    if (weights_.empty()) {
      throw InputError({file_, 1, 1}, "there are no particles in this file", "",
                       "give it the columns diameter,count");
    }
    if (weights_.size() > most_sizes) {
      throw InputError({file_}, fmt::format("the file has {} different diameters", weights_.size()),
                       fmt::format("at most {} are simulated", most_sizes), "sort them into bins");
    }
    std::vector<SizeBin> bins;
    for (const auto& [size, weight] : weights_) {
      bins.push_back({size.first, weight, size.second});
    }
    return bins;
  }

 private:
  [[noreturn]] void fail(const CsvField& cell, const std::string& problem, const std::string& why,
                         const std::string& suggestion) const {
    throw InputError({file_, cell.line, cell.column}, problem, why, suggestion);
  }

  /// A diameter in SI.
  double size(const CsvField& cell) const {
    const double diameter = number(cell) * factor_;
    if (diameter >= limits::smallest_diameter && diameter <= limits::largest_diameter) {
      return diameter;
    }
    fail(cell, fmt::format("a diameter of {}", printable(cell.text)),
         fmt::format("it has to lie between {:g} and {:g} m", limits::smallest_diameter,
                     limits::largest_diameter),
         "state its unit with --unit um, mm or m");
  }

  double number(const CsvField& cell) const {
    if (const auto value = parse_number(cell.text)) return *value;
    fail(cell, fmt::format("{} is not a number", quote(cell.text)),
         "diameters and counts have to be finite numbers", "write a decimal number such as 49.5");
  }

  void read_header(const CsvRow& row) {
    width_ = row.size();
    for (std::size_t i = 0; i < row.size(); ++i) {
      std::size_t* const column = column_named(row[i].text);
      if (column == nullptr) {
        fail(row[i], fmt::format("unknown column {}", quote(row[i].text)), "",
             "known: diameter, lower, upper, count, weight, fraction");
      }
      if (*column != no_column) {
        fail(row[i], fmt::format("{} is a second column with the same meaning", quote(row[i].text)),
             "", "remove one");
      }
      *column = i;
    }
    if (diameter_ == no_column && (lower_ == no_column || upper_ == no_column)) {
      fail(row.front(), "neither 'diameter' nor 'lower' and 'upper' is there", "",
           "add it; its unit is um unless --unit says otherwise");
    }
  }

  std::size_t* column_named(const std::string& name) {
    if (name == "diameter") return &diameter_;
    if (name == "lower") return &lower_;
    if (name == "upper") return &upper_;
    const bool weight =
        std::find(weight_names.begin(), weight_names.end(), name) != weight_names.end();
    return weight ? &weight_ : nullptr;
  }

  std::string file_;
  double factor_;
  std::size_t width_ = 0;
  std::size_t diameter_ = no_column;
  std::size_t lower_ = no_column;
  std::size_t upper_ = no_column;
  std::size_t weight_ = no_column;
  double smallest_ = INFINITY;
  double largest_ = 0.0;
  std::map<std::pair<double, double>, double> weights_;  // of (diameter, width)
};

}  // namespace

double MeasuredSizes::total() const {
  double sum = 0.0;
  for (const SizeBin& bin : bins) sum += bin.weight;
  return sum;
}

double MeasuredSizes::mean_diameter() const {
  double sum = 0.0;
  for (const SizeBin& bin : bins) sum += bin.weight * bin.diameter;
  return sum / total();
}

std::vector<SizeBin> spread_within_bins(const std::vector<SizeBin>& bins, int parts) {
  std::vector<SizeBin> spread;
  for (const SizeBin& bin : bins) {
    if (!(bin.width > 0.0)) {
      spread.push_back(bin);
      continue;
    }
    for (int i = 0; i < parts; ++i) {
      const double offset = (i + 0.5) / parts - 0.5;
      spread.push_back({bin.diameter + offset * bin.width, bin.weight / parts, bin.width / parts});
    }
  }
  return spread;
}

MeasuredSizes load_sizes(const std::filesystem::path& file, const std::string& unit) {
  const std::string text = read_text_file(file);
  require_text(text, file.string());
  const SizesResource beside = resource_beside(file);
  const std::string name = !unit.empty() ? unit : beside.unit.empty() ? "um" : beside.unit;
  const auto factor = unit_factor(Dimension::length, name);
  if (!factor) {
    throw InputError({file.string()}, fmt::format("unknown unit {} of the diameter", quote(name)),
                     "", fmt::format("use {}", join(unit_names(Dimension::length))));
  }
  SizesReader reader(file.string(), *factor);
  read_csv(text, file.string(), ',', [&](const CsvRow& row) { reader.row(row); });
  MeasuredSizes sizes;
  sizes.file = file;
  sizes.bins = reader.finish();
  sizes.smallest = reader.smallest();
  sizes.largest = reader.largest();
  sizes.provenance = beside.provenance;
  sizes.description = beside.description;
  sizes.probe_height = beside.probe_height;
  sizes.sha256 = sha256_hex(text);
  return sizes;
}

std::optional<MeasuredSizes> sizes_of_dataset(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "sizes.csv";
  std::error_code failed;
  if (!std::filesystem::exists(file, failed)) return std::nullopt;
  return load_sizes(file);
}

}  // namespace recoil
