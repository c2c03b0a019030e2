#pragma once

#include <filesystem>

#include "measure.hpp"

namespace recoil::bench {

/// One fit of `large_case(points, free_parameters)`: median seconds and the peak memory of this
/// process. Meant to be the only work of its process.
Json scaling_case(std::size_t points, int free_parameters);

/// Cost against size: 10^2 to `most_points` points with three free parameters, and 1 to 10 free
/// parameters with 10^4 points, each in a process of its own (`program --scaling-case ...`).
/// @return {"scaling": [...], "scaling_exponents": {...}}
Json measure_scaling(const std::filesystem::path& program, std::size_t most_points);

}  // namespace recoil::bench
