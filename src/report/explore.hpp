#pragma once

#include <string>
#include <string_view>

#include "report/panels.hpp"

namespace recoil {

/// The JavaScript that explores the pictures of e(V): controls of C_H, C_A, f0 or W and the
/// diameter, the curve for them, its capture velocity and misfit. explore.js, embedded when the
/// program is built; it integrates the four laws itself.
std::string_view explore_script();

/// What it needs to explore `panel`, as JSON: law, materials and fitted values in SI units, where
/// the axes of `picture` stand, and the points drawn with their weights. Empty where it cannot
/// follow the model: where mechanisms act, or `picture` leaves the place of its axes to gnuplot.
std::string explored_panel(const Analysis& analysis, const Panel& panel,
                           const plot::Picture& picture);

}  // namespace recoil
