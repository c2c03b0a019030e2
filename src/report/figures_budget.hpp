#pragma once

#include <vector>

#include "report/report.hpp"

namespace recoil {

/// What the errors come from: one bar for each quantity, from source to source; none where all
/// constants of the materials are exact.
std::vector<Figure> budget_figures(const Analysis& analysis);

}  // namespace recoil
