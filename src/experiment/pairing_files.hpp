#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "data/dataset.hpp"
#include "experiment/averages.hpp"
#include "experiment/pairing.hpp"
#include "experiment/passages.hpp"

namespace recoil {

/// Counts in bins of equal width from the smallest to the largest value.
struct Histogram {
  double lower = 0.0;
  double width = 1.0;
  std::vector<std::size_t> counts;

  double edge(std::size_t bin) const { return lower + width * static_cast<double>(bin); }
  double middle(std::size_t bin) const { return lower + width * (static_cast<double>(bin) + 0.5); }
};

/// Sturges' rule, which the paper uses: 1 + log2(n) bins, rounded up (Sturges 1926, J. Am. Stat.
/// Assoc. 21, 65-66). It is too coarse for more than a few hundred values or several peaks.
Histogram sturges(const std::vector<double>& values);

/// The rule of Freedman & Diaconis (1981, Z. Wahrscheinlichkeitstheorie 57, 453-476): bins of width
/// 2 (q75 - q25) n^(-1/3), at most 2000 of them; Sturges' number if the quartiles coincide.
Histogram freedman_diaconis(const std::vector<double>& values);

/// The text of `points.csv`: series, diameter [um], incident_velocity [m/s], velocity_sd,
/// restitution, restitution_sd, events, captured. Unknown values are empty cells.
std::string points_csv(const Averages& averages);

/// One row per passage down, used or not: line numbers, velocities at plane and surface,
/// restitution, diameter, number of the impact, fate.
std::string impacts_csv(const PassageTable& table, const PairingResult& pairs);

/// The text of `datapackage.json` for points_csv.
/// @param system the object under the key `recoil`, without the provenance
/// @param id the dataset's name
/// @param description of the pairing
/// @param sizes_height height of the plane [m] for the resource sizes.csv; 0: no such file
std::string package_json(const Json& system, const std::string& id, Provenance provenance,
                         const std::string& events_file, const std::string& description,
                         double sizes_height = 0.0);

/// The distributions that the paper shows, in SI units.
struct Distributions {
  std::vector<double> raw_velocities;     ///< all passages, at the plane, towards the surface > 0
  std::vector<double> paired_velocities;  ///< of the used impacts only
  std::vector<double> incoming_sizes;     ///< of the first passages down, rebounded or not
  std::vector<double> paired_sizes;       ///< of the used impacts
};
Distributions distributions(const PassageTable& table, const PairingResult& pairs);

/// The text of sizes.csv: Sturges' bins of the incoming spheres with lower and upper end [um] and
/// count, as `recoil predict --sizes` and the reports read them.
std::string sizes_csv(const Distributions& distributions);

/// CSV files by name: velocities-raw, velocities-paired, sizes-incoming and sizes-paired contain
/// the bins of both rules (rule, lower, upper, middle, count, share); for sizes.csv see
/// `sizes_csv`.
std::map<std::string, std::string> histogram_files(const Distributions& distributions);

}  // namespace recoil
