#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "plot/plot.hpp"

namespace recoil::plot {

/// The picture as an `<svg>` element for an HTML page, with ids that begin with the picture's name,
/// a view box without a fixed size, role and label. The same picture gives the same bytes.
/// @param width of a file for print [mm]; 0: that of the page
std::string draw_svg(const Picture& picture, double width = 0.0);

/// The colour of a value on a scale [#rrggbb]; values outside have the colour of the nearer end.
std::string colour_of(const ColourScale& scale, double value);

/// `text` as the content of an element or attribute in XML or HTML. Control characters become
/// blanks.
std::string escape_xml(std::string_view text);

/// Ticks of a logarithmic axis: steps of 1-2-5 if they fit, otherwise decades.
std::vector<double> log_ticks(Range range);

/// A round step with about `count` ticks in the range; 0 if there is none.
double round_step(Range range, int count);

}  // namespace recoil::plot
