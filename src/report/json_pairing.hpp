#pragma once

#include <string>

#include "experiment/averages.hpp"
#include "experiment/pairing.hpp"
#include "experiment/passages.hpp"

namespace recoil {

/// What `recoil pair` found, as JSON: the passages that were read, the plane, the impacts, what
/// became of passages without a rebound, the points.
std::string pairing_json(const PassageTable& table, const PairingResult& pairs,
                         const Averages& averages);

}  // namespace recoil
