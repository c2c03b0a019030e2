#pragma once

#include <vector>

#include "diagnosis/search.hpp"

namespace recoil {

/// Every mechanism of the catalogue that `spec` does not have, refitted, with its structure and its
/// plausibility; the best first. Mechanisms that cannot be fitted are left out.
std::vector<CandidateResult> try_singles(const SearchBase& base);

}  // namespace recoil
