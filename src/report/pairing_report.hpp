#pragma once

#include <string>

#include "document/document.hpp"
#include "experiment/averages.hpp"
#include "experiment/pairing.hpp"
#include "experiment/passages.hpp"

/// Impacts found in passages: text and JSON.
namespace recoil {

/// The means that a fit will see, the first forty.
Table averages_table(const Averages& averages);

/// What `recoil pair` prints.
std::string pairing_text(const PassageTable& table, const PairingResult& pairs,
                         const Averages& averages);

}  // namespace recoil
