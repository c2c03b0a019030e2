#pragma once

#include <string>

#include "diagnosis/diagnose.hpp"

namespace recoil {

/// `diagnosis.json`. Indented, ends with a newline, no NaN: what has no number is null.
std::string diagnosis_json(const Diagnosis& diagnosis);

/// What `recoil diagnose` prints: the answer, the tests, the map, the ranking, the gain. At most
/// 100 columns.
std::string diagnosis_text(const Diagnosis& diagnosis);

}  // namespace recoil
