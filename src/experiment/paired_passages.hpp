#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"
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

/// The options of `recoil pair` in the units in which they are given.
struct PairArguments {
  std::map<std::string, std::string> units, columns;  ///< by field
  bool positive_away = false;  ///< velocities are positive away from the surface
  double height = 1.0;         ///< [mm]
  double height_range = 1.5;
  bool keep_height = false;
  double diameter_tolerance = 0.2, velocity_tolerance = 0.15;
  bool keep_later = false;
  std::optional<double> threshold;  ///< [m/s]
  std::optional<double> angle;      ///< [degrees]
  std::optional<double> lost_share;
  std::size_t per_bin = 40, size_classes = 1;
  std::vector<double> size_edges;  ///< [um]
  bool mean_diameter = false;
  RECOIL_FIELDS(units, columns, positive_away, height, height_range, keep_height,
                diameter_tolerance, velocity_tolerance, keep_later, threshold, angle, lost_share,
                per_bin, size_classes, size_edges, mean_diameter)

  PairRequest request(const std::string& file) const;
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
