#pragma once

#include <string>
#include <vector>

#include "data/dataset.hpp"

namespace recoil {

/// For every reconstruction among `datasets`, what its recipe put into the points and what a
/// diagnosis of them therefore means, in one or two sentences.
std::vector<std::string> recipe_remarks(const std::vector<Dataset>& datasets);

}  // namespace recoil
