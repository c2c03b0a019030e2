#pragma once

#include <vector>

#include "report/report.hpp"

namespace recoil {

/// What two points cost, as a function of which two are taken, one per dataset.
std::vector<Figure> pair_figures(const Analysis& analysis);

}  // namespace recoil
