#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// What a picture shows; plot/draw.hpp draws it. Numbers are those of the axes. Texts are plain;
/// the symbols of the model in them (C_H, f0) are set as such.
namespace recoil::plot {

// How marks and lines look.

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
};

/// From here to there, on an axis.
struct Range {
  double lower = 0.0;
  double upper = 1.0;

  bool holds(double value) const { return value >= lower && value <= upper; }
  double width() const { return upper - lower; }
};

/// Holds all finite values, with a margin on both sides (a share of the width); [0, 1] when there
/// are none.
Range range_of(const std::vector<double>& values, double margin);

/// The same for a logarithmic axis: the margin is a share of the ratio. Values that are not
/// positive have no place there.
Range log_range_of(const std::vector<double>& values, double margin);

enum class Direction { horizontal, vertical };

// Layers, drawn in their order. A layer with a name has an entry in the key.

/// Marks, with error bars where there are any.
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

/// A line through points, interrupted where a value is not finite; with marks where it has any.
struct Line {
  std::vector<double> x, y;
  Stroke stroke = {};
  std::optional<Mark> mark = std::nullopt;
  double size = 0.6;  ///< of the marks
  std::string name = {};
};

/// What lies between two lines.
struct Band {
  std::vector<double> x, lower, upper;
  Fill fill = {std::string(blue), 0.2};
  std::string name = {};
};

/// Rectangles: cells of a table.
struct Boxes {
  std::vector<double> left, right, bottom, top;
  Fill fill = {};
  std::vector<Colour> colours = {};  ///< one of each box instead of the fill's
  std::vector<double> values = {};   ///< told by the colour scale of the plot instead
  std::string name = {};

  void add(double from_x, double to_x, double from_y, double to_y);
  std::size_t size() const { return left.size(); }
};

/// Discs whose area grows with how far `values` are from nothing, coloured by the colour scale.
struct Discs {
  std::vector<double> x, y, values;
  std::string name = {};
};

/// A line across the whole plot.
struct Rule {
  Direction direction = Direction::vertical;
  double at = 0.0;
  Stroke stroke = {};
  std::string name = {};
};

/// A shaded part of the plot; without an end it reaches the rim.
struct Region {
  std::optional<double> left = {}, right = {}, bottom = {}, top = {};
  Fill fill = {std::string(green), 0.18};
  std::string name = {};
};

/// A place along one direction: a number of the axis or a share of the way from rim to rim.
struct Place {
  double at = 0.0;
  bool share = false;
};
inline Place on_axis(double at) { return {at, false}; }
inline Place share_of_plot(double at) { return {at, true}; }

enum class Align { left, centre, right };

/// Words in the plot.
struct Words {
  std::string text;
  Place x, y;
  Align align = Align::left;
  double size = 13.0;  ///< [px]
  Colour colour = std::string(ink);
};

using Layer = std::variant<Points, Line, Band, Boxes, Discs, Rule, Region, Words>;

/// The name of a layer in the key; empty where it has none.
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
  bool upright = false;     ///< tick labels turned, where they are long and many
  double tick_size = 13.0;  ///< of the tick labels [px]

  void set_range(Range range) {
    from = range.lower;
    to = range.upper;
  }
  /// "incident velocity V  [m/s]"
  std::string title() const;
};

/// The colours of values: white or light grey in the middle where it diverges.
struct ColourScale {
  std::string label = {};
  Range range = {-1.0, 1.0};
  std::vector<std::pair<double, std::string_view>> stops = {};  ///< along the range, from 0 to 1
  std::string unit = {};                                        ///< behind its numbers: " %"
};

/// Where the names of the layers stand.
enum class KeyPlace { none, above, below };

/// Where a plot's axes stand in a picture of several [px from the left and from the foot].
struct Frame {
  double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;
};

/// A pair of axes and what stands between them.
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
  std::string title;  ///< what a screen reader says
  int width = 480;    ///< [px] of the view box
  int height = 340;   ///< [px]
  std::vector<Plot> plots = {};
};

/// `text` made fit for `Picture::name`.
std::string plot_name(std::string_view text);

/// The numbers that a picture shows as one table of comma-separated values (RFC 4180), in five
/// digits: a column for every column of its layers, named "LAYER: QUANTITY [UNIT]", pure numbers
/// without a unit. Layers that begin with the same quantity share its column, "QUANTITY [UNIT]",
/// and its rows where it has the same values there; cells in which a layer has nothing are empty.
/// Two columns of one name are told apart by (2). Empty where the picture shows no data.
std::string csv_of(const Picture& picture);

}  // namespace recoil::plot
