#pragma once

#include <array>
#include <string>
#include <vector>

namespace recoil::style {

// The palette of Okabe & Ito (2008), "Color Universal Design": distinct for colour-blind readers.
inline constexpr const char* blue = "#0072B2";
inline constexpr const char* vermillion = "#D55E00";
inline constexpr const char* green = "#009E73";
inline constexpr const char* orange = "#E69F00";
inline constexpr const char* purple = "#CC79A7";
inline constexpr const char* sky = "#56B4E9";
inline constexpr const char* ink = "#222222";
inline constexpr const char* grey = "#777777";

/// A colour and a gnuplot point type that belong together, so that colour is never the only key.
struct Marker {
  const char* colour;
  int point;
};
inline constexpr std::array<Marker, 7> markers = {
    {{blue, 7}, {orange, 5}, {green, 9}, {purple, 13}, {vermillion, 11}, {sky, 6}, {ink, 4}}};

/// Axes at the left and below, a light grid, and nothing else.
std::string preamble();

/// A title at the upper left of the picture, and under it a remark in its own colour.
std::string title(const std::string& text, const std::string& remark = "",
                  const char* remark_colour = grey);

/// The key in its own rows above or below the axes, where it hides nothing.
std::string key_above();
std::string key_below(int rows);

/// A range that holds all finite values, with a margin; [0, 1] when there are none.
struct Range {
  double lower = 0.0;
  double upper = 1.0;
};
Range range_of(const std::vector<double>& values, double margin);

/// The range between two quantiles of `values`.
Range quantile_range(std::vector<double> values, double lower, double upper);

/// `set xtics step` (or y) with a round step that gives about `count` ticks over the range.
std::string few_ticks(char axis, Range range, int count);

/// A factor 10^3n that brings numbers of size `magnitude` between 1 and 1000, and its unit text.
struct Scale {
  double factor = 1.0;
  std::string unit;  ///< for an axis label, in gnuplot markup
};
Scale scale_for(double magnitude, const std::string& unit);

/// A parameter's name in gnuplot markup: "C_{H}".
std::string symbol(const std::string& parameter);

}  // namespace recoil::style
