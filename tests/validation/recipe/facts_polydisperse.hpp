#pragma once

#include <vector>

#include "validation/recipe/facts.hpp"

namespace recoil {

const std::vector<FactKind>& polydisperse_facts();

}  // namespace recoil
