#include "plot/draw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <type_traits>

namespace recoil::plot {
namespace {

constexpr double letter = 13.0;        // font size [px]
constexpr double mark_radius = 4.875;  // of a mark of size 1 [px]
constexpr double tick_length = 5.0;    // [px]
constexpr double key_row = 20.0;       // height [px]
constexpr double sample_width = 22.0;  // of a layer in the key [px]
constexpr double mark_width = 12.0;    // of a layer of marks in the key [px]
constexpr double colour_bar = 14.0;    // width [px]
constexpr int usual_ticks = 5;

// ---- text --------------------------------------------------------------------------------------

/// A symbol of the model that is drawn with a subscript.
struct Symbol {
  std::string_view name, stem, subscript;
};
constexpr std::array<Symbol, 7> symbols = {{{"C_H", "C", "H"},
                                            {"C_A", "C", "A"},
                                            {"W_A", "W", "A"},
                                            {"V_a", "V", "a"},
                                            {"a_eq", "a", "eq"},
                                            {"e_model", "e", "model"},
                                            {"f0", "f", "0"}}};

bool word_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '/';
}

/// The symbol that begins at `at`, if one does.
const Symbol* symbol_at(std::string_view text, std::size_t at) {
  if (at > 0 && (word_character(text[at - 1]) || text[at - 1] == '.')) return nullptr;
  for (const Symbol& symbol : symbols) {
    if (text.substr(at, symbol.name.size()) != symbol.name) continue;
    const std::size_t end = at + symbol.name.size();
    if (end == text.size() || !word_character(text[end])) return &symbol;
  }
  return nullptr;
}

/// The content of a text element for plain text, with subscripts of symbols.
std::string with_symbols(std::string_view text) {
  std::string out;
  std::size_t plain = 0;  // begin of the text that is not written yet
  bool lowered = false;
  const auto write_plain = [&](std::size_t end) {
    if (end == plain) return;
    const std::string escaped = escape_xml(text.substr(plain, end - plain));
    out += lowered ? fmt::format("<tspan dy=\"-.25em\">{}</tspan>", escaped) : escaped;
    lowered = false;
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const Symbol* const symbol = symbol_at(text, i);
    if (symbol == nullptr) continue;
    write_plain(i);
    plain = i;
    out += fmt::format("<tspan{}>{}</tspan><tspan dy=\".25em\" font-size=\".8em\">{}</tspan>",
                       lowered ? " dy=\"-.25em\"" : "", symbol->stem, symbol->subscript);
    lowered = true;
    i += symbol->name.size() - 1;
    plain = i + 1;
  }
  write_plain(text.size());
  return out;
}

/// Approximate width of a text in DejaVu Sans [px].
double width_of(std::string_view text, double size) {
  double letters = 0.0;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xC0U) == 0x80U) continue;  // within a code point
    const bool narrow = std::string_view(" .,:;'|!iljtfrI()[]").find(c) != std::string_view::npos;
    const bool wide = std::string_view("mwMW%@").find(c) != std::string_view::npos;
    letters += narrow ? 0.4 : wide ? 0.98 : 0.65;
  }
  return letters * size;
}

/// A coordinate with at most one decimal.
std::string px(double value) {
  std::string text = fmt::format("{:.1f}", value);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

const char* anchor(Align align) {
  return align == Align::left ? "start" : align == Align::centre ? "middle" : "end";
}

std::string text_svg(double x, double y, std::string_view text, Align align = Align::left,
                     std::string_view colour = ink, double size = letter,
                     const std::string& more = "") {
  if (text.empty()) return "";
  return fmt::format("<text x=\"{}\" y=\"{}\" fill=\"{}\"{}{}{}>{}</text>\n", px(x), px(y), colour,
                     align == Align::left ? "" : fmt::format(" text-anchor=\"{}\"", anchor(align)),
                     size == letter ? "" : fmt::format(" font-size=\"{:g}\"", size), more,
                     with_symbols(text));
}

/// The attribute that rotates a text about its place [degrees, counter-clockwise].
std::string rotation(double x, double y, double degrees) {
  return degrees == 0.0 ? ""
                        : fmt::format(" transform=\"rotate({:g} {} {})\"", -degrees, px(x), px(y));
}

// ---- strokes, fills, marks ---------------------------------------------------------------------

std::string pen(std::string_view colour, double width) {
  return fmt::format(" stroke=\"{}\"{}", colour,
                     width == 1.0 ? "" : fmt::format(" stroke-width=\"{:g}\"", width));
}

std::string pen(const Stroke& stroke) {
  return pen(stroke.colour, stroke.width) +
         (stroke.dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", stroke.dash));
}

std::string paint(const Fill& fill) {
  return fmt::format(
      " fill=\"{}\"{}", fill.colour,
      fill.opacity == 1.0 ? "" : fmt::format(" fill-opacity=\"{:g}\"", fill.opacity));
}

std::string path_svg(const std::string& d, const std::string& look) {
  return d.empty() ? "" : fmt::format("<path d=\"{}\"{}/>\n", d, look);
}

std::string rect_path(double left, double top, double right, double bottom) {
  return fmt::format("M{} {}H{}V{}H{}z", px(left), px(top), px(right), px(bottom), px(left));
}

bool is_filled(Mark mark) {
  return mark != Mark::circle && mark != Mark::open_square && mark != Mark::open_triangle_down &&
         mark != Mark::cross;
}

/// The outline of a mark of radius `r` about a place.
std::string mark_path(Mark mark, double x, double y, double r) {
  const auto polygon = [&](double across, double up) {
    return fmt::format("M{} {}L{} {} {} {}z", px(x), px(y - up), px(x + across), px(y + up / 2.0),
                       px(x - across), px(y + up / 2.0));
  };
  switch (mark) {
    case Mark::dot:
      return fmt::format("M{} {}h0", px(x), px(y));
    case Mark::circle:
      return fmt::format("M{0} {1}a{2} {2} 0 1 0 {3} 0a{2} {2} 0 1 0 -{3} 0", px(x - r), px(y),
                         px(r), px(2.0 * r));
    case Mark::square:
    case Mark::open_square:
      return rect_path(x - r, y - r, x + r, y + r);
    case Mark::triangle:
      return polygon(1.2 * r, 1.3 * r);
    case Mark::triangle_down:
    case Mark::open_triangle_down:
      return polygon(1.2 * r, -1.3 * r);
    case Mark::diamond:
      return fmt::format("M{} {}L{} {} {} {} {} {}z", px(x), px(y - 1.3 * r), px(x + 1.3 * r),
                         px(y), px(x), px(y + 1.3 * r), px(x - 1.3 * r), px(y));
    case Mark::cross:
      return fmt::format("M{} {}h{}M{} {}v{}", px(x - r), px(y), px(2.0 * r), px(x), px(y - r),
                         px(2.0 * r));
  }
  return "";
}

/// The attributes of a mark. A dot is a stroke of length 0 with round ends, which takes few bytes.
std::string mark_look(const Marker& marker, double r, double width) {
  if (marker.mark == Mark::dot) return pen(marker.colour, 2.0 * r) + " stroke-linecap=\"round\"";
  return is_filled(marker.mark) ? fmt::format(" fill=\"{}\"", marker.colour)
                                : pen(marker.colour, width);
}

// ---- axes --------------------------------------------------------------------------------------

std::vector<Tick> ticks_of(const Axis& axis) {
  if (!axis.ticks.empty()) return axis.ticks;
  const Range range{std::min(axis.from, axis.to), std::max(axis.from, axis.to)};
  std::vector<Tick> ticks;
  if (axis.logarithmic) {
    for (const double at : log_ticks(range)) ticks.push_back({at, fmt::format("{:g}", at)});
    return ticks;
  }
  const double step = round_step(range, usual_ticks);
  if (!(step > 0.0)) return ticks;
  int decimals = 0;
  for (double unit = step; decimals < 6 && std::abs(unit - std::round(unit)) > 1e-6; unit *= 10.0) {
    ++decimals;
  }
  for (double k = std::ceil(range.lower / step - 1e-9); k * step <= range.upper + 1e-9 * step;
       k += 1.0) {
    const bool plain = step >= 1e-4 && std::abs(k * step) < 1e6;  // the same decimals
    ticks.push_back({k * step, k == 0.0 ? "0"
                               : plain  ? fmt::format("{:.{}f}", k * step, decimals)
                                        : fmt::format("{:.6g}", k * step)});
  }
  return ticks;
}

double widest(const std::vector<Tick>& ticks, double size) {
  double width = 0.0;
  for (const Tick& tick : ticks) width = std::max(width, width_of(tick.label, size));
  return width;
}

/// Converts numbers of an axis to pixels.
struct Scale {
  Axis axis;
  double first = 0.0, last = 0.0;  // ends of the axis [px]

  double operator()(double value) const {
    const auto along = [&](double v) { return axis.logarithmic ? std::log(v) : v; };
    return first +
           (last - first) * (along(value) - along(axis.from)) / (along(axis.to) - along(axis.from));
  }
  double operator()(const Place& place) const {
    return place.share ? first + (last - first) * place.at : (*this)(place.at);
  }
  bool holds(double value) const {
    const double at = (*this)(value);
    return at >= std::min(first, last) - 0.5 && at <= std::max(first, last) + 0.5;
  }
};

// ---- one plot ----------------------------------------------------------------------------------

struct KeyEntry {
  const Layer* layer;
  double width;

  double sample() const {
    return std::holds_alternative<Points>(*layer) ? mark_width : sample_width;
  }
};

class PlotWriter {
 public:
  PlotWriter(const Plot& plot, const Picture& picture, std::size_t number)
      : plot_(plot), id_(fmt::format("{}_plot_{}", picture.name, number)) {
    for (const Layer& layer : plot.layers) {
      const std::string& name = name_of(layer);
      const bool again = std::ranges::any_of(
          entries_, [&](const KeyEntry& one) { return name_of(*one.layer) == name; });
      if (name.empty() || again || plot.key == KeyPlace::none) continue;
      entries_.push_back({&layer, 0.0});
      entries_.back().width = entries_.back().sample() + 8.0 + width_of(name, letter);
    }
    lay_out(picture);
  }

  std::string svg() {
    std::string out = fmt::format(
        "<clipPath id=\"{}-clip\"><path d=\"{}\"/></clipPath>\n", id_,
        rect_path(x_.first, std::min(y_.first, y_.last), x_.last, std::max(y_.first, y_.last)));
    out += axis_svg() + fmt::format("<g id=\"{}\">\n", id_);
    for (const Layer& layer : plot_.layers) {
      out += std::visit([&](const auto& shown) { return layer_svg(shown); }, layer);
    }
    out += "</g>\n";
    if (plot_.colours) out += scale_svg(*plot_.colours);
    return out + heading_svg() + key_svg();
  }

 private:
  /// The rows of the key, with as many entries in each as fit.
  std::vector<std::vector<KeyEntry>> key_rows() const {
    constexpr double gap = 18.0;
    std::vector<std::vector<KeyEntry>> rows;
    double used = 0.0;
    for (const KeyEntry& entry : entries_) {
      if (rows.empty() || used + gap + entry.width > keys_.width()) {
        rows.emplace_back();
        used = 0.0;
      }
      rows.back().push_back(entry);
      used += (used > 0.0 ? gap : 0.0) + entry.width;
    }
    return rows;
  }

  void lay_out(const Picture& picture) {
    const double height = picture.height;
    if (plot_.frame) {
      x_ = {plot_.x, plot_.frame->left, plot_.frame->right};
      y_ = {plot_.y, height - plot_.frame->bottom, height - plot_.frame->top};
      keys_ = {x_.first, x_.last};
      rows_ = key_rows();
      return;
    }
    constexpr double rim = 12.0;
    const bool labelled = !plot_.y.label.empty();
    const double left = rim + (labelled ? 20.0 : 0.0) +
                        widest(ticks_of(plot_.y), plot_.y.tick_size) + tick_length + 4.0;
    const double right = rim + 6.0 + (plot_.colours ? colour_bar + 62.0 : 0.0);
    keys_ = {rim, picture.width - rim};
    rows_ = key_rows();
    const double keys = key_row * static_cast<double>(rows_.size());
    const double heading =
        (plot_.heading.empty() ? 0.0 : 24.0) + (plot_.remark.empty() ? 0.0 : 18.0);
    const double top = rim + heading + (plot_.key == KeyPlace::above ? keys : 0.0);
    const double foot = rim + 18.0 + (plot_.x.label.empty() ? 0.0 : 22.0) +
                        (plot_.key == KeyPlace::below ? keys + 4.0 : 0.0);
    x_ = {plot_.x, left, picture.width - right};
    y_ = {plot_.y, height - foot, top};
  }

  double upper() const { return std::min(y_.first, y_.last); }
  double lower() const { return std::max(y_.first, y_.last); }

  std::string axis_svg() const {
    std::string grid, marks, labels;
    for (const Tick& tick : ticks_of(plot_.x)) {
      const double x = x_(tick.at);
      grid += plot_.x.grid ? fmt::format("M{} {}V{}", px(x), px(lower()), px(upper())) : "";
      marks += plot_.x.grid ? fmt::format("M{} {}v{}", px(x), px(lower()), tick_length) : "";
      const double y = lower() + (plot_.x.upright ? 8.0 : 19.0);
      labels += text_svg(plot_.x.upright ? x + 4.0 : x, y, tick.label,
                         plot_.x.upright ? Align::right : Align::centre, "#333333",
                         plot_.x.tick_size, rotation(x + 4.0, y, plot_.x.upright ? 90.0 : 0.0));
    }
    for (const Tick& tick : ticks_of(plot_.y)) {
      const double y = y_(tick.at);
      grid += plot_.y.grid ? fmt::format("M{} {}H{}", px(x_.first), px(y), px(x_.last)) : "";
      marks += plot_.y.grid ? fmt::format("M{} {}h-{}", px(x_.first), px(y), tick_length) : "";
      labels += text_svg(x_.first - tick_length - 4.0, y + 0.35 * plot_.y.tick_size, tick.label,
                         Align::right, "#333333", plot_.y.tick_size);
    }
    const double middle = (upper() + lower()) / 2.0;
    const double left =
        x_.first - tick_length - 12.0 - widest(ticks_of(plot_.y), plot_.y.tick_size);
    return path_svg(grid, pen("#e4e4e4", 0.8)) +
           path_svg(fmt::format("M{} {}V{}H{}{}", px(x_.first), px(upper()), px(lower()),
                                px(x_.last), marks),
                    pen("#555555", 1.0)) +
           labels +
           text_svg((x_.first + x_.last) / 2.0, lower() + 40.0, plot_.x.title(), Align::centre) +
           text_svg(left, middle, plot_.y.title(), Align::centre, ink, letter,
                    rotation(left, middle, 90.0));
  }

  std::string heading_svg() const {
    const double above =
        plot_.key == KeyPlace::above ? key_row * static_cast<double>(rows_.size()) : 0.0;
    const double y = upper() - 10.0 - above;
    const double size = plot_.frame ? letter : letter + 1.0;
    return text_svg(x_.first, plot_.remark.empty() ? y : y - 18.0, plot_.heading, Align::left, ink,
                    size) +
           text_svg(x_.first, y, plot_.remark, Align::left, plot_.remark_colour, letter - 1.0);
  }

  std::string key_svg() const {
    std::string out;
    double y = plot_.key == KeyPlace::above
                   ? upper() - key_row * static_cast<double>(rows_.size()) + 6.0
                   : lower() + (plot_.x.label.empty() ? 40.0 : 62.0);
    for (const std::vector<KeyEntry>& row : rows_) {
      double width = 18.0 * static_cast<double>(row.size() - 1);
      for (const KeyEntry& entry : row) width += entry.width;
      double x = (keys_.lower + keys_.upper - width) / 2.0;
      for (const KeyEntry& entry : row) {
        out += std::visit([&](const auto& shown) { return sample_svg(shown, x, y - 4.5); },
                          *entry.layer) +
               text_svg(x + entry.sample() + 8.0, y, name_of(*entry.layer));
        x += entry.width + 18.0;
      }
      y += key_row;
    }
    return out;
  }

  /// The sample of a layer in the key, to the right of `x`.
  template <class Kind>
  static std::string sample_svg(const Kind& shown, double x, double y) {
    const double middle = x + sample_width / 2.0;
    const std::string line = fmt::format("M{} {}h{}", px(x), px(y), sample_width);
    if constexpr (std::is_same_v<Kind, Points>) {
      const double r = mark_radius * shown.size;
      return path_svg(mark_path(shown.marker.mark, x + mark_width / 2.0, y, r),
                      mark_look(shown.marker, r, shown.width));
    } else if constexpr (std::is_same_v<Kind, Line>) {
      const double r = mark_radius * shown.size;
      return path_svg(line, pen(shown.stroke)) +
             (shown.mark ? path_svg(mark_path(*shown.mark, middle, y, r),
                                    mark_look({shown.stroke.colour, *shown.mark}, r, 1.2))
                         : "");
    } else if constexpr (std::is_same_v<Kind, Rule>) {
      return path_svg(line, pen(shown.stroke));
    } else if constexpr (std::is_same_v<Kind, Band> || std::is_same_v<Kind, Region> ||
                         std::is_same_v<Kind, Boxes>) {
      return path_svg(rect_path(x, y - 5.0, x + sample_width, y + 5.0), paint(shown.fill));
    } else {
      return "";
    }
  }

  std::string clip() const { return fmt::format(" clip-path=\"url(#{}-clip)\"", id_); }

  // One function for each kind of layer.

  std::string layer_svg(const Points& points) const {
    const double r = mark_radius * points.size;
    std::string bars, marks;
    for (std::size_t i = 0; i < points.x.size(); ++i) {
      if (!std::isfinite(points.y[i]) || !x_.holds(points.x[i])) continue;
      const double x = x_(points.x[i]);
      if (!points.lower.empty()) {
        bars += fmt::format("M{} {}V{}", px(x), px(y_(points.lower[i])), px(y_(points.upper[i])));
      }
      if (y_.holds(points.y[i])) marks += mark_path(points.marker.mark, x, y_(points.y[i]), r);
    }
    return path_svg(bars, pen(points.marker.colour, points.width) + clip()) +
           path_svg(marks, mark_look(points.marker, r, points.width));
  }

  std::string layer_svg(const Line& line) const {
    std::string path, marks;
    bool drawing = false;
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      const double x = x_(line.x[i]);
      const double y = y_(line.y[i]);
      const bool known = std::isfinite(x) && std::isfinite(y);
      if (known) path += fmt::format("{}{} {}", drawing ? " " : "M", px(x), px(y));
      drawing = known;
      if (known && line.mark) marks += mark_path(*line.mark, x, y, mark_radius * line.size);
    }
    return path_svg(path, pen(line.stroke) + clip()) +
           (line.mark ? path_svg(marks, mark_look({line.stroke.colour, *line.mark},
                                                  mark_radius * line.size, 1.2))
                      : "");
  }

  std::string layer_svg(const Band& band) const {
    std::string path;
    for (std::size_t i = 0; i < band.x.size();) {
      const auto known = [&](std::size_t k) {
        return k < band.x.size() && std::isfinite(band.lower[k]) && std::isfinite(band.upper[k]);
      };
      const std::size_t begin = i;
      std::string back;
      for (; known(i); ++i) {
        path += fmt::format("{}{} {}", i == begin ? "M" : " ", px(x_(band.x[i])),
                            px(y_(band.upper[i])));
        back = fmt::format(" {} {}{}", px(x_(band.x[i])), px(y_(band.lower[i])), back);
      }
      if (i > begin) path += back + "z";
      if (i == begin) ++i;
    }
    return path_svg(path, paint(band.fill) + clip());
  }

  std::string layer_svg(const Boxes& boxes) const {
    std::string out, path;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const std::string one =
          rect_path(x_(boxes.left[i]), y_(boxes.top[i]), x_(boxes.right[i]), y_(boxes.bottom[i]));
      Fill own = boxes.fill;
      if (!boxes.colours.empty()) own.colour = boxes.colours[i];
      if (!boxes.values.empty()) own.colour = colour_of(*plot_.colours, boxes.values[i]);
      if (own.colour == boxes.fill.colour) {
        path += one;
      } else {
        out += path_svg(one, paint(own));
      }
    }
    return out + path_svg(path, paint(boxes.fill) + clip());
  }

  std::string layer_svg(const Discs& discs) const {
    std::string out;
    for (std::size_t i = 0; i < discs.x.size(); ++i) {
      if (!x_.holds(discs.x[i]) || !y_.holds(discs.y[i])) continue;
      const double r = mark_radius * (0.5 + 0.35 * std::sqrt(std::abs(discs.values[i])));
      out += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"{}/>\n",
                         px(x_(discs.x[i])), px(y_(discs.y[i])), px(r),
                         colour_of(*plot_.colours, discs.values[i]), pen(grey, 0.5));
    }
    return out;
  }

  std::string layer_svg(const Rule& rule) const {
    return path_svg(rule.vertical
                        ? fmt::format("M{} {}V{}", px(x_(rule.at)), px(lower()), px(upper()))
                        : fmt::format("M{} {}H{}", px(x_.first), px(y_(rule.at)), px(x_.last)),
                    pen(rule.stroke));
  }

  std::string layer_svg(const Region& region) const {
    const auto end = [](const Scale& scale, const std::optional<double>& at, double rim) {
      return at ? scale(*at) : rim;
    };
    return path_svg(rect_path(end(x_, region.left, x_.first), end(y_, region.top, y_.last),
                              end(x_, region.right, x_.last), end(y_, region.bottom, y_.first)),
                    paint(region.fill));
  }

  std::string layer_svg(const Words& words) const {
    return text_svg(x_(words.x), y_(words.y) + 0.35 * words.size, words.text, words.align,
                    words.colour, words.size);
  }

  /// The colour bar to the right of the plot.
  std::string scale_svg(const ColourScale& scale) const {
    const double left = x_.last + 14.0;
    Scale along{Axis{}, lower(), upper()};
    along.axis.set_range(scale.range);
    std::string stops, labels;
    const double first = scale.stops.front().first;
    const double last = scale.stops.back().first;
    for (const auto& [at, colour] : scale.stops) {
      stops += fmt::format("<stop offset=\"{:.4g}\" stop-color=\"{}\"/>",
                           (at - first) / (last - first), colour);
    }
    for (const Tick& tick : ticks_of(along.axis)) {
      labels += text_svg(left + colour_bar + 6.0, along(tick.at) + 4.5, tick.label + scale.unit,
                         Align::left, "#333333");
    }
    const double x = left + colour_bar + 50.0;
    const double y = (upper() + lower()) / 2.0;
    return fmt::format(
               "<linearGradient id=\"{}-colours\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">{}"
               "</linearGradient>\n",
               id_, stops) +
           path_svg(rect_path(left, upper(), left + colour_bar, lower()),
                    fmt::format(" fill=\"url(#{}-colours)\"", id_) + pen("#555555", 1.0)) +
           labels + text_svg(x, y, scale.label, Align::centre, ink, letter, rotation(x, y, 90.0));
  }

  const Plot& plot_;
  std::string id_;
  Scale x_, y_;
  Range keys_;  ///< room for the key, from left to right [px]
  std::vector<KeyEntry> entries_;
  std::vector<std::vector<KeyEntry>> rows_;  ///< of the key
};

}  // namespace

std::string colour_of(const ColourScale& scale, double value) {
  const double first = scale.stops.front().first;
  const double last = scale.stops.back().first;
  const double at = std::clamp((value - scale.range.lower) / scale.range.width(), 0.0, 1.0);
  const double place = first + (last - first) * at;
  std::size_t k = 1;
  while (k + 1 < scale.stops.size() && scale.stops[k].first < place) ++k;
  const auto& [from, low] = scale.stops[k - 1];
  const auto& [to, high] = scale.stops[k];
  const double part = std::clamp((place - from) / (to - from), 0.0, 1.0);
  std::string colour = "#";
  for (std::size_t i = 1; i < 7; i += 2) {
    const auto channel = [&](std::string_view one) {
      return static_cast<double>(std::stoi(std::string(one.substr(i, 2)), nullptr, 16));
    };
    colour += fmt::format("{:02x}", static_cast<int>(std::lround((1.0 - part) * channel(low) +
                                                                 part * channel(high))));
  }
  return colour;
}

std::string draw_svg(const Picture& picture, double width) {
  const std::string title = escape_xml(picture.title);
  std::string out = fmt::format(
      "<svg id=\"{0}\" viewBox=\"0 0 {1} {2}\" {5} role=\"img\" aria-label=\"{3}\" "
      "xmlns=\"http://www.w3.org/2000/svg\" fill=\"none\" font-size=\"{4:g}\" "
      "font-family=\"DejaVu Sans, Verdana, Helvetica, Arial, sans-serif\">\n<title>{3}</title>\n"
      "<path d=\"M0 0H{1}V{2}H0z\" fill=\"#ffffff\"/>\n",
      picture.name, picture.width, picture.height, title, letter,
      width > 0.0 ? fmt::format("width=\"{:g}mm\" height=\"{:g}mm\"", width,
                                width * picture.height / picture.width)
                  : "width=\"100%\"");
  for (std::size_t k = 0; k < picture.plots.size(); ++k) {
    out += PlotWriter(picture.plots[k], picture, k + 1).svg();
  }
  return out + "</svg>";
}

std::string escape_xml(std::string_view text) {
  constexpr std::string_view special = "&<>\"'";
  constexpr std::array<const char*, 5> escaped = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (const std::size_t k = special.find(c); k != std::string_view::npos) {
      out += escaped[k];
    } else {
      out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
    }
  }
  return out;
}

std::vector<double> log_ticks(Range range) {
  const double decades = std::log10(range.upper / range.lower);
  std::vector<double> steps = {1.0};
  if (decades <= 2.6) steps = {1.0, 2.0, 5.0};
  if (decades <= 0.8) steps = {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0};
  std::vector<double> ticks;
  const int last = static_cast<int>(std::ceil(std::log10(range.upper)));
  for (int power = static_cast<int>(std::floor(std::log10(range.lower))); power <= last; ++power) {
    for (const double step : steps) {
      const double value = step * std::pow(10.0, power);
      if (value >= range.lower * 0.999 && value <= range.upper * 1.001) ticks.push_back(value);
    }
  }
  return ticks;
}

double round_step(Range range, int count) {
  const double wanted = range.width() / count;
  if (!(wanted > 0.0) || !std::isfinite(wanted)) return 0.0;
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  double step = power;
  for (const double part : {2.0, 5.0, 10.0}) {
    if (std::abs(std::log(part * power / wanted)) < std::abs(std::log(step / wanted))) {
      step = part * power;
    }
  }
  return step;
}

}  // namespace recoil::plot
