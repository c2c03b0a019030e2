#pragma once

#include <string>

namespace recoil::plot {

/// What gnuplot prints when it is given `script`. No shell and no named file takes part, neither
/// the user's locale nor his settings.
/// @param program the gnuplot to run, searched in PATH.
/// @throws ComputationError with gnuplot's own message when it is missing or fails.
std::string run_gnuplot(const std::string& script, const std::string& program = "gnuplot");

}  // namespace recoil::plot
