#include "experiment/paired_passages.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"

namespace recoil {

PairedPassages pair_and_average(PassageTable table, const PairRequest& request) {
  PairedPassages paired;
  paired.table = std::move(table);
  paired.pairs = pair_passages(paired.table.passages, request.pairing);
  paired.averages =
      average(paired.table.passages, paired.table.series, paired.pairs, request.averaging);
  return paired;
}

void require_impacts(const PairedPassages& paired, const PairRequest& request, const char* dashes) {
  if (!paired.pairs.impacts.empty()) return;
  throw ComputationError(fmt::format(
      "{0}: no impacts found (no passage up follows a passage down within the time that a plane "
      "{1:g} mm above the surface allows); check {2}height, the units and {2}positive",
      request.file, request.pairing.height / units::mm, dashes));
}

}  // namespace recoil
