#pragma once

#include <string>

#include "report/report.hpp"

namespace recoil {

/// `fit.json`. Indented, ends with a newline, no NaN: what has no number is null with a reason.
/// @pre analysis.fitted.usable
std::string json_report(const Analysis& analysis);

}  // namespace recoil
