#pragma once

#include <string>
#include <vector>

#include "document/document.hpp"
#include "report/report.hpp"

namespace recoil {

/// e against V (log axis) of each diameter: points with error bars, full fit with its band, the
/// two-point curve, the capture velocity with its interval.
std::vector<Figure> restitution_figures(const Analysis& analysis);

}  // namespace recoil
