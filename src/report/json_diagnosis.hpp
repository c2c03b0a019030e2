#pragma once

#include <string>

#include "diagnosis/diagnosis_result.hpp"

namespace recoil {

/// `diagnosis.json`. Indented, ends with a newline, no NaN: what has no number is null.
std::string diagnosis_json(const Diagnosis& diagnosis);

}  // namespace recoil
