#pragma once

#include <vector>

#include "report/report.hpp"

namespace recoil {

/// Capture velocity against diameter by this fit and by the older models, one picture per dataset.
std::vector<Figure> capture_comparison_figures(const Analysis& analysis);

}  // namespace recoil
