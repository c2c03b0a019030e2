#pragma once

#include <vector>

#include "report/report.hpp"

namespace recoil {

/// The replicates of every pair of free parameters, with the profile likelihood of each on the
/// diagonal: one picture, none without replicates. Of more than six, the first six.
std::vector<Figure> corner_figures(const Analysis& analysis);

}  // namespace recoil
