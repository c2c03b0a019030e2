#pragma once

#include "core/random.hpp"

namespace hidden {

/// Streams of random numbers that no command of recoil draws from.
inline constexpr auto hidden_purpose = static_cast<recoil::RandomPurpose>(1000);

}  // namespace hidden
