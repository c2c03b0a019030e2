#pragma once

#include <vector>

#include "document/sentence.hpp"
#include "estimate/fit.hpp"

namespace recoil {

/// What a reader of a fit should beware of, a sentence each.
std::vector<Sentence> fit_warnings(const FitResult& fitted);

}  // namespace recoil
