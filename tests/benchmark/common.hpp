#pragma once

#include <filesystem>

#include "measure.hpp"

namespace recoil::bench {

/// CPU time of `recoil fit --threads 1`, whole program, for fits that are common: captures with
/// estimated noise and the default number of replicates, the same impacts as single rows and as
/// means, and 1,000 points without replicates, beside lmfit.
/// @param recoil the program
/// @param folder where the cases are written
/// @param scripts the folder of peer_lmfit.py
/// @return [{"what": ..., "seconds": ..., "lmfit_seconds": ..., where lmfit was run}]
Json measure_common(const std::filesystem::path& recoil, const std::filesystem::path& folder,
                    const std::filesystem::path& scripts);

}  // namespace recoil::bench
