#pragma once

#include <vector>

#include "diagnosis/diagnose.hpp"

namespace recoil {

/// Every diameter of every dataset in four bands of equal width in ln V; empty bands are left out.
std::vector<MisfitCell> misfit_map(const FitResult& fitted);

}  // namespace recoil
