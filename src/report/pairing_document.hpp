#pragma once

#include <string>
#include <vector>

#include "document/document.hpp"
#include "experiment/averages.hpp"
#include "experiment/pairing.hpp"
#include "experiment/passages.hpp"

namespace recoil {

/// What became of the passages towards the surface that have no rebound.
Table unpaired_table(const PairingResult& pairs, const Averages& averages);

/// The means that a fit will see, the first forty.
Table averages_table(const Averages& averages);

std::vector<Section> pairing_sections(const PassageTable& table, const PairingResult& pairs,
                                      const Averages& averages);

/// What `recoil pair` prints.
std::string pairing_text(const PassageTable& table, const PairingResult& pairs,
                         const Averages& averages);

}  // namespace recoil
