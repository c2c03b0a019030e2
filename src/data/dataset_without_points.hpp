#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "data/datapackage.hpp"
#include "data/dataset.hpp"

namespace recoil {

inline constexpr std::uintmax_t largest_package = 16ULL * 1024 * 1024;  ///< [bytes]

/// The folder's own name, also for "datasets/mica/" and ".".
std::string name_of_folder(const std::filesystem::path& folder);

/// What `package` says, without the points: no series, no points, no warnings, no checksum.
Dataset dataset_without_points(const Package& package, const std::filesystem::path& folder);

/// A dataset folder whose points may still be to come: where the CSV resource is missing, or has no
/// line below its header, the dataset has no points; its checksum is that of the package alone.
/// @throws InputError as `load_dataset` does.
Dataset load_dataset_to_be_measured(const std::filesystem::path& folder);

}  // namespace recoil
