#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "plot/plot.hpp"

namespace recoil::plot {

/// The picture as an `<svg>` element ready to stand in an HTML page: ids that begin with the
/// picture's name, a view box without a fixed size, role and label. The same picture gives the same
/// bytes.
std::string draw_svg(const Picture& picture);

/// The colour of a value on a scale [#rrggbb], that of the nearer end beyond it.
std::string colour_of(const ColourScale& scale, double value);

/// `text` as the content of an element or of an attribute, in XML as in HTML; control characters,
/// which have no place there, become blanks.
std::string escape_xml(std::string_view text);

/// The round numbers between two ends of a logarithmic axis: 1-2-5 steps where they fit, decades
/// otherwise.
std::vector<double> log_ticks(Range range);

/// A round step that gives about `count` ticks over the range; 0 where there is none.
double round_step(Range range, int count);

}  // namespace recoil::plot
