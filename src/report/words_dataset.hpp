#pragma once

#include <string>
#include <vector>

#include "data/datapackage.hpp"
#include "data/dataset.hpp"

namespace recoil {

/// One sentence on what the provenance means for whoever reads a result; for a reconstruction it
/// says that no point of it was measured.
std::string provenance_sentence(Provenance provenance);

/// "2 points with a restitution above 1 (first in line 5): ..."
std::string warning_sentence(const DatasetWarning& warning);

/// "every point averages over 20 to 110 um (mean 49 um, ...)".
std::string mixed_sizes_words(const MeasuredSizes& sizes);

/// "particle: Young's modulus 20 %; surface: Poisson's ratio 0.02"; empty where all are exact.
std::string stated_errors_words(const ImpactSystem& system);

/// What a dataset did not take over from the one whose materials it has, and what these give.
std::string left_out_sentence(const std::vector<LeftOverride>& left_out);

}  // namespace recoil
