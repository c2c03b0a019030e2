#pragma once

#include <string>
#include <vector>

#include "experiment/imported_points.hpp"

namespace recoil {

/// Any table: quantities as a dataset has them.
/// @param package_map entries for columns that the dataset to be replaced already knows
ImportedPoints read_columns(const ImportRequest& request,
                            const std::vector<std::string>& package_map);

}  // namespace recoil
