#pragma once

#include <vector>

#include "report/report.hpp"

namespace recoil {

/// All intervals of one free parameter side by side, with its estimate and its bounds.
std::vector<Figure> interval_figures(const Analysis& analysis);

}  // namespace recoil
