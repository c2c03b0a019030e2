#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "plot/plot.hpp"

namespace recoil::plot {

/// Each picture as an `<svg>` element ready to stand in an HTML page: no prolog, ids that begin
/// with the picture's name, a view box without a fixed size, role and label. The same picture gives
/// the same bytes, alone or among others. One gnuplot draws them all.
/// @param program the gnuplot to run, searched in PATH.
/// @throws ComputationError with gnuplot's own message when it is missing or fails.
std::vector<std::string> draw_svg(const std::vector<const Picture*>& pictures,
                                  const std::string& program = "gnuplot");

std::string draw_svg(const Picture& picture, const std::string& program = "gnuplot");

/// What gnuplot prints when it is given `script`. No shell and no named file takes part, neither
/// the user's locale nor his settings.
/// @param program the gnuplot to run, searched in PATH.
/// @throws ComputationError with gnuplot's own message when it is missing or fails, or when it has
/// not ended after `limit`.
std::string run_gnuplot(const std::string& script, const std::string& program = "gnuplot",
                        std::chrono::milliseconds limit = std::chrono::minutes(2));

/// Commands that draw at their end ask at their beginning.
/// @throws InputError when gnuplot is not installed
void require_gnuplot();

}  // namespace recoil::plot
