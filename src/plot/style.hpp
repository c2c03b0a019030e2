#pragma once

#include <array>
#include <string>
#include <string_view>

/// How marks and lines look.
namespace recoil::plot {

/// "#0072B2"
using Colour = std::string;

// The palette of Okabe & Ito (2008), "Color Universal Design": distinct for colour-blind readers.
inline constexpr std::string_view blue = "#0072B2";
inline constexpr std::string_view vermillion = "#D55E00";
inline constexpr std::string_view green = "#009E73";
inline constexpr std::string_view orange = "#E69F00";
inline constexpr std::string_view purple = "#CC79A7";
inline constexpr std::string_view sky = "#56B4E9";
inline constexpr std::string_view ink = "#222222";
inline constexpr std::string_view grey = "#6b6b6b";
inline constexpr std::string_view pale = "#c4c4c4";

enum class Mark {
  dot,  ///< a filled circle
  circle,
  square,
  open_square,
  triangle,
  triangle_down,
  open_triangle_down,
  diamond,
  cross
};

/// A colour and a mark that belong together, so that colour is never the only key.
struct Marker {
  std::string_view colour;
  Mark mark;
};
inline constexpr std::array<Marker, 7> markers = {{{blue, Mark::dot},
                                                   {orange, Mark::square},
                                                   {green, Mark::triangle},
                                                   {purple, Mark::diamond},
                                                   {vermillion, Mark::triangle_down},
                                                   {sky, Mark::circle},
                                                   {ink, Mark::open_square}}};
/// The one for the k-th of several series, from the start again when they run out.
inline const Marker& marker(std::size_t k) { return markers[k % markers.size()]; }

enum class Dash { solid, long_dashes, dashes, dots, dash_dot };

struct Stroke {
  std::string_view colour = ink;
  double width = 2.0;  ///< [px]
  Dash dash = Dash::solid;
};

struct Fill {
  Colour colour = std::string(sky);
  double opacity = 1.0;
  bool rim = false;  ///< a thin white one, which keeps neighbours apart
};

}  // namespace recoil::plot
