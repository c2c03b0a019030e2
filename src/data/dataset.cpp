#include "data/dataset.hpp"

#include <algorithm>
#include <system_error>

#include "core/error.hpp"
#include "core/files.hpp"
#include "data/datapackage.hpp"
#include "data/dataset_without_points.hpp"
#include "data/folder_names.hpp"
#include "data/points.hpp"

namespace recoil {
namespace {

Dataset assemble(const Package& package, const std::string& package_text,
                 const std::string& csv_text, const std::filesystem::path& folder) {
  const std::string file = (folder / package.points_path).string();
  Dataset dataset = dataset_without_points(package, folder);
  read_points(csv_text, file, package, dataset);
  dataset.sha256 = sha256_hex(package_text + "\n" + csv_text);
  return dataset;
}

/// What `package` says every point averages over.
void read_mixed_sizes(const Package& package, const std::filesystem::path& folder,
                      Dataset& dataset) {
  const std::filesystem::path file = folder / package.mixed_sizes;
  std::error_code failed;
  if (!std::filesystem::exists(file, failed)) {
    throw InputError(package.mixed_sizes_where, "there is no file '" + package.mixed_sizes + "'",
                     "every point averages over its sizes", "correct the path or add the file");
  }
  dataset.mixed_sizes = load_sizes(file);
  dataset.sha256 = sha256_hex(dataset.sha256 + dataset.mixed_sizes->sha256);
}

void require_folder(const std::filesystem::path& folder) {
  std::error_code failed;
  const auto status = std::filesystem::status(folder, failed);
  if (!std::filesystem::exists(status)) {
    throw InputError({folder.string()}, "no such folder", "", "check the path");
  }
  if (!std::filesystem::is_directory(status)) {
    throw InputError({folder.string()}, "this is a file, not a folder",
                     "a dataset is a folder with datapackage.json and its points",
                     "name the folder");
  }
}

}  // namespace

Conditions conditions_of(const Dataset& dataset, std::size_t series) {
  if (series >= dataset.series_conditions.size()) return dataset.system.conditions;
  return dataset.series_conditions[series].or_else(dataset.system.conditions);
}

std::vector<double> distinct_diameters(const Dataset& dataset) {
  std::vector<double> diameters;
  for (const ImpactPoint& point : dataset.points) diameters.push_back(point.diameter);
  std::sort(diameters.begin(), diameters.end());
  diameters.erase(std::unique(diameters.begin(), diameters.end()), diameters.end());
  return diameters;
}

Dataset parse_dataset(const std::string& datapackage_text, const std::string& csv_text,
                      const std::filesystem::path& folder) {
  Package package =
      read_package(datapackage_text, (folder / package_file_name).string(), name_of_folder(folder));
  return assemble(package, datapackage_text, csv_text, folder);
}

Dataset load_dataset(const std::filesystem::path& folder) {
  require_folder(folder);
  const std::filesystem::path package_file = folder / package_file_name;
  std::error_code failed;
  if (!std::filesystem::exists(package_file, failed)) {
    throw InputError({package_file.string()}, "no such file", "it describes the dataset",
                     "add it, as in a shipped dataset");
  }
  const std::string package_text = read_text_file(package_file, largest_package);
  Package package = read_package(package_text, package_file.string(), name_of_folder(folder));
  const std::filesystem::path points_file = folder / package.points_path;
  if (!std::filesystem::exists(points_file, failed)) {
    throw InputError(package.points_where, "there is no file '" + package.points_path + "'", "",
                     "correct the path or add the file");
  }
  const std::string csv_text = read_text_file(points_file);
  Dataset dataset = assemble(package, package_text, csv_text, folder);
  if (!package.mixed_sizes.empty()) read_mixed_sizes(package, folder, dataset);
  return dataset;
}

std::vector<std::string> reconstruction_remarks(const std::vector<Dataset>& datasets) {
  std::vector<std::string> remarks;
  for (const Dataset& dataset : datasets) {
    if (dataset.provenance != Provenance::reconstruction) continue;
    remarks.push_back(dataset.id +
                      " is a reconstruction: a committed recipe (recipe.toml) made its points. "
                      "Whatever a diagnosis finds in them, the recipe put there: it shows that the "
                      "method works, and says nothing about the experiment.");
  }
  return remarks;
}

}  // namespace recoil
