#pragma once

#include <string>

#include "diagnosis/diagnosis_result.hpp"

namespace recoil {

/// The answer in one line, without a full stop.
std::string headline(const Diagnosis& diagnosis);

}  // namespace recoil
