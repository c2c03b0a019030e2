#pragma once

#include <string>

#include "data/dataset.hpp"

namespace recoil {

/// One sentence on what the provenance means for whoever reads a result; for a reconstruction it
/// says that no point of it was measured.
std::string provenance_sentence(Provenance provenance);

/// "2 points with a restitution above 1 (first in line 5): ..."
std::string warning_sentence(const DatasetWarning& warning);

}  // namespace recoil
