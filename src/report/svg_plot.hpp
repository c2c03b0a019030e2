#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace recoil {

/// One drawing for gnuplot.
struct PlotScript {
  std::string name;      ///< letters, digits, '-'; the prefix of every id in the SVG
  std::string title;     ///< what a screen reader says
  int width = 480;       ///< [px] of the view box
  int height = 340;      ///< [px]
  std::string commands;  ///< everything after `set terminal`; data inline, see `data_block`
};

/// Runs gnuplot on `script` and returns an `<svg>` element ready to stand in an HTML page: no
/// prolog, ids that begin with `script.name`, a view box without a fixed size, role and label.
/// The same script gives the same bytes. No shell and no named file takes part.
/// @param program the gnuplot to run, searched in PATH.
/// @throws ComputationError with gnuplot's own message when it is missing or fails.
std::string draw_svg(const PlotScript& script, const std::string& program = "gnuplot");

/// `text` as a single-quoted gnuplot string in which nothing is markup: no sub- or superscripts, no
/// substitution, one line.
std::string gnuplot_text(std::string_view text);

/// `$name << EOD ... EOD` with one line per row; anything not finite becomes NaN, which gnuplot
/// leaves out.
std::string data_block(const std::string& name, const std::vector<std::vector<double>>& rows);

/// `set xtics (...)` for a logarithmic axis: 1-2-5 steps where they fit, decades otherwise.
std::string log_ticks(char axis, double lower, double upper);

/// `text` made fit for `PlotScript::name`.
std::string plot_name(std::string_view text);

}  // namespace recoil
