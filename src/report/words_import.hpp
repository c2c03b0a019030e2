#pragma once

#include <string>

#include "experiment/import.hpp"

namespace recoil {

/// A note of `recoil import` as a sentence.
std::string note_sentence(const ImportNote& note);

}  // namespace recoil
