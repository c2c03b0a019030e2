#pragma once

#include <vector>

#include "diagnosis/search.hpp"

namespace recoil {

/// Every two of `singles` that could be causes, within their plausible ranges, fitted from the fit
/// of either; the best first. Two spreads at once are not tried: one looks like the other.
std::vector<CandidateResult> try_pairs(const SearchBase& base,
                                       const std::vector<CandidateResult>& singles);

}  // namespace recoil
