#pragma once

#include "core/json.hpp"
#include "report/report.hpp"

namespace recoil {

/// `noise`: the variance function and how it was chosen, errors of the inputs, captures,
/// distribution.
Json noise_json(const Analysis& analysis);

}  // namespace recoil
