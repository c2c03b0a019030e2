#pragma once

#include <vector>

#include "report/report.hpp"

namespace recoil {

/// C_H against C_A of every replicate, calibrated by two points and by all, one per dataset.
std::vector<Figure> two_point_figures(const Analysis& analysis);

}  // namespace recoil
