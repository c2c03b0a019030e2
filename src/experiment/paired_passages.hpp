#pragma once

#include <string>

#include "experiment/averages.hpp"
#include "experiment/pairing.hpp"
#include "experiment/passages.hpp"

namespace recoil {

/// What `recoil pair` is asked.
struct PairRequest {
  std::string file;
  PairingOptions pairing;
  AverageOptions averaging;
};

/// What it finds.
struct PairedPassages {
  PassageTable table;
  PairingResult pairs;
  Averages averages;
};

/// Pairs the passages of `table` and averages them.
PairedPassages pair_and_average(PassageTable table, const PairRequest& request);

/// @param dashes what stands before the name of an option where it is given: "--" or nothing
/// @throws ComputationError when there are no impacts, with what may be wrong.
void require_impacts(const PairedPassages& paired, const PairRequest& request,
                     const char* dashes = "--");

}  // namespace recoil
