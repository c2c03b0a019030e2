#pragma once

#include <string>

#include "estimate/fit.hpp"
#include "estimate/two_point.hpp"

namespace recoil {

/// How the two-point iteration on `dataset` ended, with numbers.
std::string two_point_words(const FitResult& fitted, std::size_t dataset,
                            const TwoPointResult& result);

}  // namespace recoil
