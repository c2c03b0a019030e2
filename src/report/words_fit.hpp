#pragma once

#include <string>
#include <vector>

#include "estimate/fit.hpp"

namespace recoil {

/// What a reader of a fit should beware of, a sentence each.
std::vector<std::string> fit_warnings(const FitResult& fitted);

}  // namespace recoil
