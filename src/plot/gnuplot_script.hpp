#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "plot/plot.hpp"

/// The only place that speaks gnuplot's language.
namespace recoil::plot {

/// Commands that draw the pictures one after the other as SVG.
std::string gnuplot_script(const std::vector<const Picture*>& pictures);

/// `text` as a gnuplot string in which nothing is markup but the symbols of the model: C_H gets a
/// subscript where it stands alone. No substitution and no command can come from it.
std::string gnuplot_text(std::string_view text);

/// The round numbers between two ends of a logarithmic axis: 1-2-5 steps where they fit, decades
/// otherwise.
std::vector<double> log_ticks(Range range);

/// A round step that gives about `count` ticks over the range; 0 where there is none.
double round_step(Range range, int count);

}  // namespace recoil::plot
