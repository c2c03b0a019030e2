#pragma once

#include <string>
#include <vector>

#include "document/document.hpp"
#include "validation/recipe/reconstruction.hpp"

namespace recoil {

/// Every published fact of the recipe, and whether its points meet it.
Table facts_table(const ReconstructionResult& result);

std::vector<Section> reconstruction_sections(const ReconstructionResult& result);

/// What `./run study reconstruct` prints.
std::string reconstruction_text(const ReconstructionResult& result);

}  // namespace recoil
