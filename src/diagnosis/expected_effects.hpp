#pragma once

#include <vector>

#include "diagnosis/expected_effect.hpp"
#include "diagnosis/search.hpp"

namespace recoil {

/// For every dataset and every mechanism whose strength its conditions state, what the mechanism
/// does to e under the parameters of the base fit; also where that is too little to be seen. The
/// largest change first.
std::vector<ExpectedEffect> expected_effects(const SearchBase& base);

}  // namespace recoil
