#include "data/measured_sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/files.hpp"
#include "data/csv.hpp"
#include "data/datapackage.hpp"
#include "data/dataset.hpp"
#include "data/quantity.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_sizes = 2000;
constexpr Range plane_height{0.0, 1.0, "m", "give it in m: 1 mm is 0.001"};

class SizesReader {
 public:
  SizesReader(std::string file, double factor) : file_(std::move(file)), factor_(factor) {}

  void read_row(const CsvRow& row) {
    if (width_ == 0) {
      read_header(row);
      return;
    }
    require_width(row, width_, file_);
    const double lower = size(row[diameter_ ? *diameter_ : *lower_]);
    const double upper = diameter_ ? lower : size(row[*upper_]);
    if (upper < lower) {
      fail(row[*upper_], fmt::format("upper = {} lies below lower", row[*upper_].text), "",
           "swap them");
    }
    const double weight = weight_ ? number_in(row[*weight_], file_, "a count") : 1.0;
    if (weight < 0.0) {
      fail(row[*weight_], fmt::format("{} particles", row[*weight_].text),
           "a count cannot be negative", "correct it");
    }
    if (!(weight > 0.0)) return;
    weights_[{0.5 * (lower + upper), upper - lower}] += weight;
    smallest_ = std::min(smallest_, lower);
    largest_ = std::max(largest_, upper);
  }

  void finish(MeasuredSizes& sizes) const {
    if (weights_.empty()) {
      throw InputError({file_, 1, 1}, "there are no particles in this file", "",
                       "give it the columns diameter,count");
    }
    if (weights_.size() > most_sizes) {
      throw InputError({file_}, fmt::format("the file has {} different diameters", weights_.size()),
                       fmt::format("at most {} are simulated", most_sizes), "sort them into bins");
    }
    for (const auto& [size, weight] : weights_) {
      sizes.bins.push_back({size.first, weight, size.second});
    }
    sizes.smallest = smallest_;
    sizes.largest = largest_;
  }

 private:
  [[noreturn]] void fail(const CsvField& cell, const std::string& problem, const std::string& why,
                         const std::string& suggestion) const {
    throw InputError(cell.in(file_), problem, why, suggestion);
  }

  /// A diameter in SI.
  double size(const CsvField& cell) const {
    const double diameter = number_in(cell, file_, "a diameter") * factor_;
    if (limits::diameter.contains(diameter)) return diameter;
    fail(cell, fmt::format("a diameter of {}", printable(cell.text)), limits::diameter.sentence(),
         "state its unit with --unit um, mm or m");
  }

  void read_header(const CsvRow& row) {
    const std::map<std::string, std::optional<std::size_t>*> columns = {
        {"diameter", &diameter_}, {"lower", &lower_},   {"upper", &upper_},
        {"count", &weight_},      {"weight", &weight_}, {"fraction", &weight_}};
    width_ = row.size();
    for (std::size_t i = 0; i < row.size(); ++i) {
      const auto column = columns.find(row[i].text);
      if (column == columns.end()) {
        fail(row[i], fmt::format("unknown column {}", quote(row[i].text)), "",
             "known: diameter, lower, upper, count, weight, fraction");
      }
      if (*column->second) {
        fail(row[i], fmt::format("{} is a second column with the same meaning", quote(row[i].text)),
             "", "remove one");
      }
      *column->second = i;
    }
    if (!diameter_ && !(lower_ && upper_)) {
      fail(row.front(), "neither 'diameter' nor 'lower' and 'upper' is there", "",
           "add it; its unit is um unless --unit says otherwise");
    }
  }

  std::string file_;
  double factor_;
  std::size_t width_ = 0;
  std::optional<std::size_t> diameter_, lower_, upper_, weight_;  ///< columns
  double smallest_ = INFINITY;
  double largest_ = 0.0;
  std::map<std::pair<double, double>, double> weights_;  ///< by (diameter, width)
};

std::string text_under(const JsonNode& node, const char* key) {
  const auto found = node.find(key);
  return found ? printable(found->string()) : std::string();
}

/// Reads the description of the file in the data package beside it.
/// @returns the unit of the diameters, empty if not stated
std::string read_resource_beside(const fs::path& file, MeasuredSizes& sizes) {
  const fs::path package = file.parent_path() / package_file_name;
  std::error_code failed;
  if (!fs::exists(package, failed)) return "";
  const std::string text = read_text_file(package);
  require_text(text, package.string());
  const JsonDocument document(text, package.string());
  const auto resource = find_resource(document.root(), file.filename().string());
  if (!resource) return "";
  sizes.provenance = text_under(*resource, "provenance");
  sizes.description = text_under(*resource, "description");
  if (const auto height = resource->find("probe_height")) {
    sizes.probe_height = height->number();
    if (!plane_height.contains(*sizes.probe_height)) {
      height->fail(fmt::format("probe_height = {:g} m", *sizes.probe_height),
                   plane_height.sentence(), std::string(plane_height.hint));
    }
  }
  const std::map<std::string, std::string> units = field_units(*resource);
  for (const char* column : {"lower", "diameter"}) {
    if (units.contains(column)) return units.at(column);
  }
  return "";
}

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

MeasuredSizes load_sizes(const fs::path& file, const std::string& unit) {
  const std::string text = read_text_file(file);
  require_text(text, file.string());
  MeasuredSizes sizes;
  sizes.file = file;
  sizes.sha256 = sha256_hex(text);
  const std::string beside = read_resource_beside(file, sizes);
  const std::string name = !unit.empty() ? unit : beside.empty() ? "um" : beside;
  SizesReader reader(file.string(),
                     known_scale(Dimension::length, name, "the diameter", {file.string()}).factor);
  read_csv(text, file.string(), ',', [&](const CsvRow& row) { reader.read_row(row); });
  reader.finish(sizes);
  return sizes;
}

std::optional<MeasuredSizes> sizes_of_dataset(const fs::path& folder) {
  const fs::path file = folder / "sizes.csv";
  std::error_code failed;
  if (!std::filesystem::exists(file, failed)) return std::nullopt;
  return load_sizes(file);
}

}  // namespace recoil
