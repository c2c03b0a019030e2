#pragma once

#include <vector>

#include "reconstruction/facts.hpp"

namespace recoil {

/// Facts about series of one size each, and facts about mixed sizes.
const std::vector<FactKind>& monodisperse_facts();

}  // namespace recoil
