#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace recoil {

struct SizeBin {
  double diameter = 0.0;  ///< mid-point of the bin [m]
  double weight = 0.0;    ///< number of particles, or proportional to it [1], > 0
  double width = 0.0;     ///< upper less lower end [m]; 0: not stated
};

/// A size distribution in SI units.
struct MeasuredSizes {
  std::filesystem::path file;
  std::vector<SizeBin> bins;           ///< by ascending diameter, all different
  std::string provenance;              ///< from the data package beside the file; may be empty
  std::string description;             ///< from the data package; may be empty
  std::optional<double> probe_height;  ///< of the measuring plane, from the data package [m]
  std::string sha256;                  ///< of the file's text
  double smallest = 0.0;               ///< lower end of the first bin [m]
  double largest = 0.0;                ///< upper end of the last one [m]

  double total() const;          ///< sum of the weights
  double mean_diameter() const;  ///< the arithmetic mean d10 [m]
};

/// Divides every bin with a width into `parts` equal bins that share its weight, so that spheres
/// are spread evenly over the bin instead of all at its mid-point. @pre parts >= 1
std::vector<SizeBin> spread_within_bins(const std::vector<SizeBin>& bins, int parts);

/// Reads a CSV file with a header: `diameter`, or `lower` and `upper` of a bin; and `count` (or
/// `weight`, or `fraction`), without which every row is one particle. Rows of equal diameter are
/// added, and rows of weight 0 are skipped.
///
/// If datapackage.json in the same folder has a resource with this path, its `description`,
/// `provenance` and `probe_height` [m] are read. The unit of the diameters is `unit`, or else that
/// of the resource's field `diameter` (or `lower`), or else um.
/// @throws InputError with file, line and column of the first mistake
MeasuredSizes load_sizes(const std::filesystem::path& file, const std::string& unit = "");

/// The size distribution `folder`/sizes.csv of a dataset, if there is one.
std::optional<MeasuredSizes> sizes_of_dataset(const std::filesystem::path& folder);

}  // namespace recoil
