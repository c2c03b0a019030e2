#pragma once

#include <vector>

#include "diagnosis/search.hpp"

namespace recoil {

/// Says of every candidate why it is not a cause, or nothing. Held-out gains are computed for those
/// that pass everything else and are no more than `reach` (of the criterion) behind the best
/// explanation; what is further behind explains without that test.
void judge(const SearchBase& base, std::vector<CandidateResult>& candidates, double reach,
           const std::vector<Fold>& folds);

}  // namespace recoil
