#pragma once

#include <vector>

#include "validation/recipe/facts.hpp"

namespace recoil {

/// Facts about series of one size each, and facts about mixed sizes.
const std::vector<FactKind>& monodisperse_facts();

}  // namespace recoil
