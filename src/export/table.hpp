#pragma once

#include "export/exported_impact.hpp"

namespace recoil {

/// The range of a table of e(V, d), and the bootstrap for its bands.
struct TableRequest {
  std::size_t dataset = 0;
  std::vector<double> sizes;  ///< diameters [m]
  double slowest = 0.0;       ///< [m/s]
  double fastest = 0.0;
  std::vector<std::vector<double>> replicates;  ///< theta of each, for the bands; may be empty
  double level = 0.95;
  int threads = 0;
};

struct BandedNumber {
  double value = 0.0;
  bool banded = false;  ///< `lower` and `upper` are known
  double lower = 0.0, upper = 0.0;
};

/// e(V) of one size; below V* it is 0.
struct TabulatedSize {
  double diameter = 0.0;  ///< [m]
  bool captures = false;
  BandedNumber capture_velocity;  ///< [m/s], if `captures`
  std::vector<double> velocity;   ///< [m/s], log-spaced, with additional ones at and above V*
  std::vector<BandedNumber> restitution;
};

/// The table with pointwise percentile bands of the replicates.
std::vector<TabulatedSize> restitution_table(const ImpactModel& model,
                                             std::span<const double> theta,
                                             const TableRequest& request);

/// The columns `diameter_um,incident_velocity_m_s,restitution_1,lower_1,upper_1`; the last two are
/// empty without replicates.
std::string csv_restitution(const std::vector<TabulatedSize>& table);

/// The columns `diameter_um,capture_velocity_m_s,lower_m_s,upper_m_s` for the captured sizes.
std::string csv_captures(const std::vector<TabulatedSize>& table);

}  // namespace recoil
