#pragma once

#include <string>

#include "experiment/averages.hpp"
#include "experiment/pairing.hpp"
#include "experiment/passages.hpp"

namespace recoil {

/// The text that `recoil pair` prints.
std::string describe(const PassageTable& table, const PairingResult& pairs,
                     const Averages& averages);

}  // namespace recoil
