#pragma once

#include <filesystem>
#include <vector>

#include "estimate/fit.hpp"
#include "validation/truth/truth.hpp"

namespace recoil::bench {

/// Ammonium fluorescein on molybdenum, as nature has it in all synthetic data of the benchmark. The
/// points come from the simulator of the reconstructions, which shares no code with the fitter.
Truth truth();

/// The diameters of Wall et al. (1990) [m].
const std::vector<double>& diameters();

inline constexpr int velocities_per_diameter = 15;
inline constexpr double lowest_velocity = 1.1;    ///< in capture velocities of the diameter
inline constexpr double highest_velocity = 60.0;  ///< [m/s]
inline constexpr double relative_noise = 0.02;    ///< sd of e = 0.02 e, stated with every point
inline constexpr std::uint64_t noise_seed = 20260101;

/// Where the fits of recoil and of its peers start; f0 as the materials have it (eq. 12).
struct Start {
  double C_H = 1.5e-3;  ///< [s/m]
  double C_A = 0.06;    ///< [s/m]
  double f0 = 8.0;      ///< [N/m]
};

/// Writes the data set of the peer comparison into `folder`: 4 diameters x `velocities`, C_H, C_A
/// and f0 free. `datapackage.json`, `points.csv` and `fit.toml` for recoil; the same `points.csv`,
/// with `constants.json` and `constants.csv` (SI units), for the peers.
void write_peer_case(const std::filesystem::path& folder, int velocities = velocities_per_diameter,
                     bool state_sd = true);

/// Writes three diameters x `factors` times their capture velocities x `impacts`, whose capture
/// velocities scatter by 5 % and whose readings of e err by 0.02, neither stated; f0 as it is in
/// nature. Into `rows` one row for each impact, into `means` the same impacts as counted means.
void write_captures(const std::filesystem::path& rows, const std::filesystem::path& means,
                    const std::vector<double>& factors, int impacts);

/// A fit, ready to run.
struct Case {
  std::vector<Dataset> datasets;
  ImpactModel model;
  Observations data;
};

/// Reads a fit file and its datasets as the command line does.
Case load_case(const std::filesystem::path& fit_file);

/// `points` points spread evenly over the diameters, at velocities drawn evenly in their logarithm,
/// fitted with `free_parameters` of 1 to 10: C_H; C_A; f0; then C_A of one more dataset each, all
/// of them sharing C_H and f0. No point is captured.
Case large_case(std::size_t points, int free_parameters);

}  // namespace recoil::bench
