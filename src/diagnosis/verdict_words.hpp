#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnose.hpp"

namespace recoil {

/// The answer of a diagnosis in one paragraph for someone who was not there.
std::string verdict_text(const Diagnosis& diagnosis);

/// Where the base model misses most, in one sentence; empty where it misses nowhere.
std::string where_text(const Diagnosis& diagnosis);

/// Errors that nobody stated and that would do as well as the answer, or without one; beside two
/// causes at once also those that fit less well, as they need one number.
std::vector<UnstatedErrors> rival_errors(const Diagnosis& diagnosis);

}  // namespace recoil
