#include "experiment/paired_passages.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"

namespace recoil {

PairRequest PairArguments::request(const std::string& file) const {
  constexpr double degree = M_PI / 180.0;
  PairRequest out = {file,
                     {.height = height * recoil::units::mm,
                      .height_range = height_range,
                      .refine = !keep_height,
                      .diameter_tolerance = diameter_tolerance,
                      .velocity_tolerance = velocity_tolerance,
                      .threshold = threshold,
                      .angle = angle ? std::optional(*angle * degree) : std::nullopt,
                      .keep_later = keep_later,
                      .lost_share = lost_share},
                     {per_bin, size_classes, {}, mean_diameter}};
  for (const double edge : size_edges) out.averaging.size_edges.push_back(edge * recoil::units::um);
  return out;
}

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
