#pragma once

#include "document/sentence.hpp"
#include "estimate/fit.hpp"
#include "estimate/two_point.hpp"

namespace recoil {

/// How the two-point iteration on `dataset` ended, with numbers.
Sentence two_point_words(const FitResult& fitted, std::size_t dataset,
                         const TwoPointResult& result);

}  // namespace recoil
