#pragma once

#include <string>
#include <vector>

#include "report/comparison_document.hpp"

namespace recoil {

/// Fits side by side as JSON: `fits[]`, and under `quantities[]` what each says of one quantity, in
/// the order of the fits (null where a fit does not have it).
/// @throws InputError when they are not of the same data. @pre two or more
std::string comparison_json(const std::vector<ComparedFit>& fits);

}  // namespace recoil
