#pragma once

#include <vector>

#include "reconstruction/facts.hpp"

namespace recoil {

const std::vector<FactKind>& polydisperse_facts();

}  // namespace recoil
