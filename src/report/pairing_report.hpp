#pragma once

#include <string>

#include "document/document.hpp"
#include "experiment/averages.hpp"
#include "experiment/pairing.hpp"
#include "experiment/passages.hpp"

/// The result of `recoil pair`.
namespace recoil {

/// The first forty points.
Table averages_table(const Averages& averages);

/// The output of `recoil pair`.
std::string pairing_text(const PassageTable& table, const PairingResult& pairs,
                         const Averages& averages);

}  // namespace recoil
