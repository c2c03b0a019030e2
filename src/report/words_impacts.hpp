#pragma once

#include <string>

#include "experiment/averages.hpp"
#include "experiment/events.hpp"
#include "experiment/pairing.hpp"

namespace recoil {

/// The text that `recoil pair` prints.
std::string describe(const EventTable& table, const PairResult& pairs, const Averages& averages);

}  // namespace recoil
