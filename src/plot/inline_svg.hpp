#pragma once

#include <string>
#include <string_view>

#include "plot/plot.hpp"

namespace recoil::plot {

/// One SVG document as gnuplot writes it, made fit to stand in a page beside others: every id
/// begins with the picture's name, nothing is said that is inherited or unused, coordinates have a
/// tenth of a pixel, clouds of dots are one path. It looks the same. Rests on the meaning of SVG
/// alone, not on how gnuplot sets it; what it does not know it leaves as it is.
std::string inline_svg(std::string_view document, const Picture& picture);

}  // namespace recoil::plot
