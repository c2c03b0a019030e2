#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace recoil {

/// Every mechanism, in the order in which they act.
const std::vector<Mechanism>& mechanism_catalogue();

/// The mechanism `id`; null when there is none.
const Mechanism* find_mechanism(std::string_view id);

/// Those of `ids`, in the order in which they act. @pre all of them exist
std::vector<const Mechanism*> chain_of(const std::vector<std::string>& ids);

}  // namespace recoil
