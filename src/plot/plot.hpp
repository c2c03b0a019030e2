#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// The content of a picture, which plot/draw.hpp draws. Numbers are in units of the axes. Texts are
/// plain; symbols of the model in them (C_H, f0) are drawn with subscripts.
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

/// A colour and a mark for one series, so that colour is never the only difference.
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
/// The marker of the k-th series; they repeat after the last one.
inline const Marker& marker(std::size_t k) { return markers[k % markers.size()]; }

// Patterns of a stroke: lengths of dashes and gaps in turn [px].
inline constexpr std::string_view long_dashes = "10 4";
inline constexpr std::string_view dashes = "5 4";
inline constexpr std::string_view dots = "2.5 3";
inline constexpr std::string_view dash_dot = "10 4 3 4";

struct Stroke {
  std::string_view colour = ink;
  double width = 2.0;          ///< [px]
  std::string_view dash = {};  ///< the pattern; empty: solid
};

struct Fill {
  Colour colour = std::string(sky);
  double opacity = 1.0;
};

struct Range {
  double lower = 0.0;
  double upper = 1.0;

  bool holds(double value) const { return value >= lower && value <= upper; }
  double width() const { return upper - lower; }
};

/// The range of all finite values, with a margin on both sides (a share of the width); [0, 1] if
/// there are none.
Range range_of(const std::vector<double>& values, double margin);

/// The same for a logarithmic axis, with the margin as a share of the logarithmic width. Values
/// that are not positive are omitted.
Range log_range_of(const std::vector<double>& values, double margin);

// Layers, drawn in their order. A layer with a name has an entry in the key.

/// Marks with optional error bars.
struct Points {
  std::vector<double> x, y;
  std::vector<double> lower = {}, upper = {};  ///< ends of the error bars; empty: none
  Marker marker = {ink, Mark::dot};
  double size = 0.5;   ///< of the mark [the height of a letter]
  double width = 1.2;  ///< of the error bars and the rims of open marks [px]
  std::string name = {};

  /// Adds error bars of +- sd.
  Points& with_sd(const std::vector<double>& sd);
};

/// A line through points, with optional marks, interrupted at values that are not finite.
struct Line {
  std::vector<double> x, y;
  Stroke stroke = {};
  std::optional<Mark> mark = std::nullopt;
  double size = 0.6;  ///< of the marks
  std::string name = {};
};

/// The area between two lines.
struct Band {
  std::vector<double> x, lower, upper;
  Fill fill = {std::string(blue), 0.2};
  std::string name = {};
};

/// Rectangles: cells of a table.
struct Boxes {
  std::vector<double> left, right, bottom, top;
  Fill fill = {};
  std::vector<Colour> colours = {};  ///< of each box, instead of the fill's; may be empty
  std::vector<double> values = {};   ///< of each box, for the colour scale; may be empty
  std::string name = {};

  void add(double from_x, double to_x, double from_y, double to_y);
  std::size_t size() const { return left.size(); }
};

/// Discs whose radius increases with |values|, coloured by the colour scale.
struct Discs {
  std::vector<double> x, y, values;
  std::string name = {};
};

/// A line across the whole plot, vertical at an x or horizontal at a y.
struct Rule {
  bool vertical = true;
  double at = 0.0;
  Stroke stroke = {};
  std::string name = {};
};

/// A shaded part of the plot, up to the rim on sides without a value.
struct Region {
  std::optional<double> left = {}, right = {}, bottom = {}, top = {};
  Fill fill = {std::string(green), 0.18};
  std::string name = {};
};

/// A coordinate: a number of the axis, or a share of the plot's width or height.
struct Place {
  double at = 0.0;
  bool share = false;
};
inline Place on_axis(double at) { return {at, false}; }
inline Place share_of_plot(double at) { return {at, true}; }

enum class Align { left, centre, right };

/// Text in the plot.
struct Words {
  std::string text;
  Place x, y;
  Align align = Align::left;
  double size = 13.0;  ///< [px]
  Colour colour = std::string(ink);
};

using Layer = std::variant<Points, Line, Band, Boxes, Discs, Rule, Region, Words>;

/// The name of a layer in the key; empty if it has none.
const std::string& name_of(const Layer& layer);

struct Tick {
  double at = 0.0;
  std::string label = {};
};

struct Axis {
  std::string label = {};
  std::string unit = {};        ///< "m/s"; empty: a pure number
  double from = 0.0, to = 1.0;  ///< ends; the first may be the larger
  bool logarithmic = false;
  std::vector<Tick> ticks = {};  ///< empty: about five round numbers
  bool grid = true;
  bool upright = false;     ///< tick labels are rotated, for many or long ones
  double tick_size = 13.0;  ///< of the tick labels [px]

  void set_range(Range range) {
    from = range.lower;
    to = range.upper;
  }
  /// "incident velocity V  [m/s]"
  std::string title() const;
};

/// The colours of values. A diverging scale is white or light grey in the middle.
struct ColourScale {
  std::string label = {};
  Range range = {-1.0, 1.0};
  std::vector<std::pair<double, std::string_view>> stops = {};  ///< along the range, from 0 to 1
  std::string unit = {};                                        ///< behind its numbers: " %"
};

/// The place of the key, the names of the layers.
enum class KeyPlace { none, above, below };

/// The place of a plot's axes in a picture of several [px from the left and from the bottom].
struct Frame {
  double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;
};

/// A pair of axes and the layers between them.
struct Plot {
  std::string heading = {};
  std::string remark = {};  ///< under the heading, smaller
  Colour remark_colour = std::string(grey);
  Axis x, y;
  KeyPlace key = KeyPlace::none;
  std::optional<ColourScale> colours = {};
  std::vector<Layer> layers = {};
  std::optional<Frame> frame = {};  ///< none: the whole picture
};

/// One or several plots in one frame.
struct Picture {
  std::string name;   ///< letters, digits, '-'; the prefix of every id in the SVG
  std::string title;  ///< for screen readers
  int width = 480;    ///< [px] of the view box
  int height = 340;   ///< [px]
  std::vector<Plot> plots = {};
};

/// `text` converted to a `Picture::name`.
std::string plot_name(std::string_view text);

/// The numbers of a picture as one table of comma-separated values (RFC 4180) with five digits. It
/// has a column for every column of the layers, named "LAYER: QUANTITY [UNIT]", without a unit for
/// pure numbers. Layers whose first quantity is the same share its column, "QUANTITY [UNIT]", and
/// also the rows if the values are the same. Other cells are empty. "(2)" is appended to the name
/// of a second column. The text is empty if the picture shows no data.
std::string csv_of(const Picture& picture);

}  // namespace recoil::plot
