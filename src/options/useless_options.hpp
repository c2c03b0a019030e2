#pragma once

#include "options/given_options.hpp"

namespace recoil {

/// Refuses an option that would do nothing beside the others that were given.
/// @throws InputError
void refuse_useless_options(const GivenOptions& given);

}  // namespace recoil
