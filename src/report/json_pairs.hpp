#pragma once

#include <cstddef>

#include "core/json.hpp"
#include "report/report.hpp"

namespace recoil {

/// `out["pairs"]` and `out["pairs_study"]`: two points against all for every pair of `dataset`.
void put_pairs(Json& out, const Analysis& analysis, std::size_t dataset);

}  // namespace recoil
