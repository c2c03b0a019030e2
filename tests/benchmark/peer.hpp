#pragma once

#include <filesystem>

#include "design.hpp"
#include "measure.hpp"

namespace recoil::bench {

/// The same data and the same fit by recoil, by Python (lmfit and scipy) and by R (minpack.lm and
/// deSolve), one process and one thread each. Peers that are not installed are left out and named.
///
/// Estimates are compared with those of recoil on CVODES at its default tolerance, in its standard
/// errors. Whoever is off by more than `agreement` is judged by chi2, computed with CVODES at its
/// estimate: a minimum that is higher is none.
/// @param folder where `write_peer_case` has written
/// @param scripts the folder of peer_lmfit.py and peer_r.R
Json measure_peers(const Case& the_case, const std::filesystem::path& folder,
                   const std::filesystem::path& scripts);

inline constexpr double agreement = 0.01;  ///< of a standard error

}  // namespace recoil::bench
