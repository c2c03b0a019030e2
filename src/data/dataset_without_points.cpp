#include "data/dataset_without_points.hpp"

#include <system_error>

#include "core/files.hpp"
#include "data/folder_names.hpp"

namespace recoil {
namespace {

/// Has `text` no line but a header?
bool has_no_point(const std::string& text) {
  constexpr const char* blank = " \t\r\n";
  const std::size_t header = text.find_first_not_of(blank);
  const std::size_t end = header == std::string::npos ? header : text.find('\n', header);
  return end == std::string::npos || text.find_first_not_of(blank, end) == std::string::npos;
}

}  // namespace

std::string name_of_folder(const std::filesystem::path& folder) {
  const std::filesystem::path plain = folder.lexically_normal();
  const std::filesystem::path name =
      plain.has_filename() ? plain.filename() : plain.parent_path().filename();
  return name.empty() || name == "." || name == ".." ? "dataset" : name.string();
}

Dataset dataset_without_points(const Package& package, const std::filesystem::path& folder) {
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
  return dataset;
}

Dataset load_dataset_to_be_measured(const std::filesystem::path& folder) {
  const std::filesystem::path package_file = folder / package_file_name;
  std::error_code failed;
  if (!std::filesystem::is_regular_file(package_file, failed)) return load_dataset(folder);
  const std::string text = read_text_file(package_file, largest_package);
  const Package package = read_package(text, package_file.string(), name_of_folder(folder));
  const std::filesystem::path points = folder / package.points_path;
  if (std::filesystem::exists(points, failed) && !has_no_point(read_text_file(points))) {
    return load_dataset(folder);
  }
  Dataset dataset = dataset_without_points(package, folder);
  dataset.sha256 = sha256_hex(text + "\n");
  return dataset;
}

}  // namespace recoil
