#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "data/dataset.hpp"
#include "experiment/averages.hpp"
#include "experiment/histogram.hpp"
#include "experiment/pairing.hpp"
#include "experiment/passages.hpp"

namespace recoil {

/// `points.csv`: series, diameter [um], incident_velocity [m/s], velocity_sd, restitution,
/// restitution_sd, passages, captured. A cell is empty where nothing is known.
std::string points_csv(const Averages& averages);

/// One row per passage down that is used or not: line numbers, velocities at plane and surface,
/// restitution, diameter, number of the impact, what became of it.
std::string impacts_csv(const PassageTable& table, const PairingResult& pairs);

/// `datapackage.json` for points_csv.
/// @param system what stands under the key `recoil` beside the provenance
/// @param id its name
/// @param description what was done.
/// @param sizes_height of the plane [m]: lists sizes.csv beside the points; 0 for no such file.
std::string package_json(const Json& system, const std::string& id, Provenance provenance,
                         const std::string& events_file, const std::string& description,
                         double sizes_height = 0.0);

/// The distributions that the paper shows, SI units.
struct Distributions {
  std::vector<double> raw_velocities;     ///< all passages, at the plane, towards the surface > 0
  std::vector<double> paired_velocities;  ///< of the used impacts only
  std::vector<double> incoming_sizes;     ///< of the first passages down, rebounded or not
  std::vector<double> paired_sizes;       ///< of the used impacts
};
Distributions distributions(const PassageTable& table, const PairingResult& pairs);

/// Sturges' bins of the incoming spheres: lower and upper end [um] and count, as `recoil predict
/// --sizes` and the reports read them.
std::string sizes_csv(const Distributions& distributions);

/// CSV files by name: velocities-raw, velocities-paired, sizes-incoming and sizes-paired hold the
/// bins of both rules (rule, lower, upper, middle, count, share), and sizes.csv see `sizes_csv`.
std::map<std::string, std::string> histogram_files(const Distributions& distributions);

}  // namespace recoil
