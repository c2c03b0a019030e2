#pragma once

#include <string>

#include "diagnosis/diagnose.hpp"

namespace recoil {

/// The answer of a diagnosis in one paragraph for someone who was not there.
std::string verdict_text(const Diagnosis& diagnosis);

/// Where the base model misses most, in one sentence; empty where it misses nowhere.
std::string where_text(const Diagnosis& diagnosis);

}  // namespace recoil
