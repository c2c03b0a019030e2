#pragma once

#include <vector>

#include "report/report.hpp"

namespace recoil {

/// e - truth against V with each correction left out, and C_A with its error: two pictures of one
/// study. @param index makes the names of the pictures differ.
std::vector<Figure> correction_figures(const CorrectionStudy& study, std::size_t index);

}  // namespace recoil
