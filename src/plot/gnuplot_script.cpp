#include "plot/gnuplot_script.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <set>

namespace recoil::plot {
namespace {

/// What stands with a subscript when it stands alone: name, stem, subscript.
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

std::string line_of_text(std::string_view text) {
  std::string out = "'";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (const Symbol* symbol = symbol_at(text, i)) {
      out += fmt::format("{}_{{{}}}", symbol->stem, symbol->subscript);
      i += symbol->name.size() - 1;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += ' ';
    } else if (c == '\'') {
      out += "’";  // gnuplot takes '' for a quote, but not at the start and not two of them
    } else {
      if (std::strchr("\\{}^_@&~", c) != nullptr) out += '\\';
      out += c;
    }
  }
  return out + "'";
}

std::string bold_text(std::string_view text) {
  std::string out = gnuplot_text(text);
  out.insert(1, "{/:Bold ");
  out.insert(out.size() - 1, "}");
  return out;
}

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.7g}", value) : std::string("NaN");
}

int point_type(Mark mark) {
  switch (mark) {
    case Mark::cross:
      return 1;
    case Mark::open_square:
      return 4;
    case Mark::square:
      return 5;
    case Mark::circle:
      return 6;
    case Mark::dot:
      return 7;
    case Mark::triangle:
      return 9;
    case Mark::open_triangle_down:
      return 10;
    case Mark::triangle_down:
      return 11;
    case Mark::diamond:
      return 13;
  }
  return 7;
}

std::string pen(const Stroke& stroke) {
  const char* dashes = "";
  switch (stroke.dash) {
    case Dash::solid:
      break;
    case Dash::long_dashes:
      dashes = " dt (10,4)";
      break;
    case Dash::dashes:
      dashes = " dt (5,4)";
      break;
    case Dash::dots:
      dashes = " dt (2.5,3)";
      break;
    case Dash::dash_dot:
      dashes = " dt (10,4,3,4)";
      break;
  }
  return fmt::format("lc rgb '{}' lw {:g}{}", stroke.colour, stroke.width, dashes);
}

/// A fill that lets what lies beneath it through.
std::string glass(const Fill& fill) {
  return fmt::format("fc rgb '{}' fs transparent solid {:g} noborder", fill.colour, fill.opacity);
}

/// A fill that does not: its opacity is against the white of the page.
std::string paint(const Fill& fill) {
  return fmt::format("fs solid {:g} {}", fill.opacity,
                     fill.rim ? "border rgb '#ffffff'" : "noborder");
}

std::string point_style(Mark mark, double size) {
  return fmt::format("pt {} ps {:g}", point_type(mark), size);
}

/// How a layer looks in the key: `with ...`; empty where it cannot stand there.
std::string sample(const Layer& layer) {
  return std::visit(
      [](const auto& shown) -> std::string {
        using Kind = std::decay_t<decltype(shown)>;
        if constexpr (std::is_same_v<Kind, Points>) {
          return fmt::format("with points lc rgb '{}' lw {:g} {}", shown.marker.colour, shown.width,
                             point_style(shown.marker.mark, shown.size));
        } else if constexpr (std::is_same_v<Kind, Line>) {
          return shown.mark ? fmt::format("with linespoints {} {}", pen(shown.stroke),
                                          point_style(*shown.mark, shown.size))
                            : fmt::format("with lines {}", pen(shown.stroke));
        } else if constexpr (std::is_same_v<Kind, Band> || std::is_same_v<Kind, Region>) {
          return fmt::format("with filledcurves {}", glass(shown.fill));
        } else if constexpr (std::is_same_v<Kind, Boxes>) {
          return fmt::format("with boxes fc rgb '{}' {}", shown.fill.colour, paint(shown.fill));
        } else if constexpr (std::is_same_v<Kind, Spans> || std::is_same_v<Kind, Rule> ||
                             std::is_same_v<Kind, Contour>) {
          return fmt::format("with lines {}", pen(shown.stroke));
        } else if constexpr (std::is_same_v<Kind, Discs>) {
          return "with points pt 6 ps 1";
        } else {
          return "";
        }
      },
      layer);
}

std::string title(const std::string& name) {
  return name.empty() ? std::string("notitle") : "title " + gnuplot_text(name);
}

/// On a level stretch of a line only the ends are needed.
std::vector<std::size_t> needed_points(const Line& line) {
  std::vector<std::size_t> kept;
  const auto& [x, y] = std::tie(line.x, line.y);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const bool between = !line.mark && !kept.empty() && i + 1 < x.size() &&
                         y[kept.back()] == y[i] && y[i] == y[i + 1] &&
                         (x[i] - x[kept.back()]) * (x[i + 1] - x[i]) >= 0.0;
    if (!between) kept.push_back(i);
  }
  return kept;
}

std::string place(const Place& place) {
  return fmt::format("{} {:.7g}", place.share ? "graph" : "first", place.at);
}

std::string place(const std::optional<double>& at, double rim) {
  return place(at ? on_axis(*at) : share_of_plot(rim));
}

const char* word(Align align) {
  return align == Align::left ? "left" : align == Align::centre ? "center" : "right";
}

class ScriptWriter {
 public:
  void add(const Picture& picture) {
    // Ids and terminal options hold for one picture; data keep their names for the whole script.
    script_ += fmt::format(
        "set terminal svg size {},{} dynamic enhanced font 'DejaVu Sans,13' name 'gnuplot' "
        "background '#ffffff'\nset encoding utf8\nreset\n",
        picture.width, picture.height);
    std::vector<std::string> commands;
    for (const Plot& plot : picture.plots) commands.push_back(plot_commands(plot, picture));
    // Data and contours stand before the pictures that show them.
    const bool several = picture.plots.size() > 1 || picture.key.place != KeyPlace::none;
    if (several) script_ += "set multiplot\n";
    for (const std::string& one : commands) script_ += "reset\n" + one;
    if (picture.key.place != KeyPlace::none) script_ += common_key(picture);
    if (several) script_ += "unset multiplot\n";
  }

  std::string script() && { return std::move(script_); }

 private:
  std::string block_name() { return fmt::format("$d{}", ++blocks_); }

  /// Writes the columns as a data block and returns its name.
  std::string data(const std::vector<const std::vector<double>*>& columns,
                   const std::vector<std::size_t>* rows = nullptr) {
    const std::string name = block_name();
    script_ += name + " << EOD\n";
    const std::size_t count = rows != nullptr ? rows->size() : columns.front()->size();
    for (std::size_t i = 0; i < count; ++i) {
      const char* separator = "";
      for (const auto* column : columns) {
        script_ += separator + number(column->at(rows != nullptr ? (*rows)[i] : i));
        separator = " ";
      }
      script_ += '\n';
    }
    if (count == 0) script_ += "NaN NaN NaN NaN NaN NaN NaN\n";
    script_ += "EOD\n";
    return name;
  }

  // Each returns its part of the plot command and may add to `commands` what stands before it.

  std::string element(const Points& points, std::string&) {
    std::string out;
    if (!points.lower.empty()) {
      const std::string bars = data({&points.x, &points.lower, &points.upper});
      out =
          fmt::format("{} using 1:2:(0):($3-$2) with vectors nohead lc rgb '{}' lw {:g} notitle, ",
                      bars, points.marker.colour, points.width);
    }
    return out + fmt::format("{} using 1:2 {} {}", data({&points.x, &points.y}), sample(points),
                             title(points.name));
  }

  std::string element(const Line& line, std::string&) {
    const std::vector<std::size_t> rows = needed_points(line);
    return fmt::format("{} using 1:2 {} {}", data({&line.x, &line.y}, &rows), sample(line),
                       title(line.name));
  }

  std::string element(const Band& band, std::string&) {
    return fmt::format("{} using 1:2:3 {} {}", data({&band.x, &band.lower, &band.upper}),
                       sample(band), title(band.name));
  }

  std::string element(const Boxes& boxes, std::string&) {
    std::vector<const std::vector<double>*> columns = {&boxes.left,  &boxes.bottom, &boxes.left,
                                                       &boxes.right, &boxes.bottom, &boxes.top};
    std::vector<double> own;
    std::string colour = fmt::format("lc rgb '{}'", boxes.fill.colour);
    std::string more;
    if (!boxes.values.empty()) {
      columns.push_back(&boxes.values);
      colour = "lc palette";
      more = ":7";
    } else if (!boxes.colours.empty()) {
      for (const Colour& one : boxes.colours) {
        own.push_back(static_cast<double>(std::stoul(one.substr(1), nullptr, 16)));
      }
      columns.push_back(&own);
      colour = "lc rgb variable";
      more = ":7";
    }
    return fmt::format("{} using 1:2:3:4:5:6{} with boxxyerror {} {} {}", colour_exact(columns),
                       more, colour, paint(boxes.fill), title(boxes.name));
  }

  /// The data of boxes; a colour as a number needs eight digits.
  std::string colour_exact(const std::vector<const std::vector<double>*>& columns) {
    const std::string name = block_name();
    script_ += name + " << EOD\n";
    for (std::size_t i = 0; i < columns.front()->size(); ++i) {
      for (const auto* column : columns) script_ += fmt::format("{:.9g} ", column->at(i));
      script_ += '\n';
    }
    if (columns.front()->empty()) script_ += "NaN NaN NaN NaN NaN NaN NaN\n";
    script_ += "EOD\n";
    return name;
  }

  std::string element(const Spans& spans, std::string&) {
    const std::string ends = spans.stops ? fmt::format("heads size screen {:.4f},90",
                                                       0.0055 + 0.0013 * spans.stroke.width)
                                         : "nohead";
    return fmt::format("{} using 2:1:($3-$2):(0) with vectors {} {} {}",
                       data({&spans.y, &spans.lower, &spans.upper}), ends, pen(spans.stroke),
                       title(spans.name));
  }

  std::string element(const Discs& discs, std::string&) {
    const std::string name = data({&discs.x, &discs.y, &discs.values});
    return fmt::format(
        "{0} using 1:2:(0.5+0.35*sqrt(abs($3))):3 with points pt 7 ps variable lc palette notitle, "
        "{0} using 1:2:(0.5+0.35*sqrt(abs($3))) with points pt 6 ps variable lc rgb '{1}' lw 0.5 "
        "{2}",
        name, grey, title(discs.name));
  }

  std::string element(const Rule& rule, std::string& commands) {
    const bool upright = rule.direction == Direction::vertical;
    const Place at = on_axis(rule.at);
    const auto end = [&](double rim) {
      return upright ? place(at) + ", " + place(share_of_plot(rim))
                     : place(share_of_plot(rim)) + ", " + place(at);
    };
    commands += fmt::format("set arrow from {} to {} nohead {} {}\n", end(0.0), end(1.0),
                            pen(rule.stroke), rule.in_front ? "front" : "back");
    return key_entry(rule);
  }

  std::string element(const Region& region, std::string& commands) {
    commands += fmt::format("set object rect from {}, {} to {}, {} {} behind\n",
                            place(region.left, 0.0), place(region.bottom, 0.0),
                            place(region.right, 1.0), place(region.top, 1.0), glass(region.fill));
    return key_entry(region);
  }

  std::string element(const Contour& contour, std::string&) {
    if (contour.rows.empty()) return "";
    const std::string heights = block_name();
    script_ += heights + " << EOD\n";
    for (const std::vector<double>& row : contour.rows) {
      for (const double height : row) script_ += number(height) + " ";
      script_ += '\n';
    }
    const std::string line = block_name();
    script_ += fmt::format(
        "EOD\nset contour base\nunset surface\nset cntrparam levels discrete {:.6g}\nset table {}\n"
        "splot {} matrix using ({:.8g}+{:.8g}*$1):({:.8g}+{:.8g}*$2):3 with lines\n"
        "unset table\nreset\n",
        contour.level, line, heights, contour.x.lower,
        contour.x.width() / static_cast<double>(contour.rows.front().size() - 1), contour.y.lower,
        contour.y.width() / static_cast<double>(contour.rows.size() - 1));
    return fmt::format("{} using 1:2 {} {}", line, sample(contour), title(contour.name));
  }

  static std::string element(const Words& words, std::string& commands) {
    commands += fmt::format(
        "set label {} at {}, {} {} rotate by {:g} offset character {:g}, character {:g} font "
        "',{:g}' textcolor rgb '{}' front\n",
        words.bold ? bold_text(words.text) : gnuplot_text(words.text), place(words.x),
        place(words.y), word(words.align), words.turned, words.shift_x, words.shift_y, words.size,
        words.colour);
    return "";
  }

  static std::string key_entry(const Layer& layer) {
    const std::string& name = name_of(layer);
    return name.empty() ? std::string() : fmt::format("NaN {} {}", sample(layer), title(name));
  }

  static std::string axis_commands(char c, const Axis& axis) {
    std::string out;
    const auto end = [](const std::optional<double>& at) {
      return at ? fmt::format("{:.7g}", *at) : std::string("*");
    };
    if (axis.logarithmic) out += fmt::format("set logscale {}\n", c);
    out += fmt::format("set {}range [{}:{}]\n", c, end(axis.from), end(axis.to));
    std::vector<Tick> ticks = axis.ticks;
    const bool ends = axis.from && axis.to;
    if (ticks.empty() && axis.logarithmic && ends) {
      for (const double at : log_ticks({*axis.from, *axis.to})) {
        ticks.push_back({at, fmt::format("{:g}", at)});
      }
    }
    if (!ticks.empty()) {
      std::vector<std::string> places;
      for (const Tick& tick : ticks) {
        const std::string label = !axis.shown ? "''"
                                  : tick.bold ? bold_text(tick.label)
                                              : gnuplot_text(tick.label);
        places.push_back(fmt::format("{} {:.7g}", label, tick.at));
      }
      out += fmt::format("set {}tics ({}){}{} font ',{:g}'\n", c, fmt::join(places, ", "),
                         axis.grid ? "" : " scale 0", axis.upright ? " rotate by 90 right" : "",
                         axis.tick_size);
    } else if (axis.about > 0 && ends) {
      const double step = round_step({*axis.from, *axis.to}, axis.about);
      if (step > 0.0) out += fmt::format("set {}tics {:.6g}\n", c, step);
    }
    if (!axis.grid) out += fmt::format("set grid no{}tics\n", c);
    out += fmt::format("set format {} '{}'\n", c, axis.shown ? "%g" : "");
    if (!axis.shown || axis.label.empty()) return out;
    const bool two_lines = axis.label.find('\n') != std::string::npos;
    const std::string offset = c == 'x' ? "0,0.4" : two_lines ? "-0.7,0" : "1,0";
    return out + fmt::format("set {}label {} offset {}\n", c, gnuplot_text(axis.title()), offset);
  }

  static std::string key_commands(const Key& key) {
    switch (key.place) {
      case KeyPlace::none:
        return "unset key\n";
      case KeyPlace::above:
        return "set key outside top center horizontal Left reverse samplen 0.8\n";
      case KeyPlace::below:
        return fmt::format(
            "set key outside bottom center vertical Left reverse samplen 1.4 maxrows {}\n",
            key.rows);
      case KeyPlace::lower_right:
        return "set key bottom right Left reverse\n";
      case KeyPlace::upper_right:
        return "set key top right Left reverse\n";
    }
    return "";
  }

  static std::string colour_commands(const ColourScale& scale) {
    std::vector<std::string> stops;
    for (const auto& [at, colour] : scale.stops)
      stops.push_back(fmt::format("{:g} '{}'", at, colour));
    std::string out =
        fmt::format("set palette defined ({})\nset cbrange [{:.4g}:{:.4g}]\nset format cb '{}'\n",
                    fmt::join(stops, ", "), scale.range.lower, scale.range.upper, scale.format);
    if (!scale.label.empty()) {
      out += fmt::format("set cblabel {} offset 1,0\n", gnuplot_text(scale.label));
    }
    return out;
  }

  /// What the labels of the ticks and the title of a vertical axis take [letters].
  static double room_for_ticks(const Axis& axis) {
    std::size_t longest = 0;
    for (const Tick& tick : axis.ticks) longest = std::max(longest, tick.label.size());
    if (!axis.ticks.empty()) return 3.0 + 0.85 * static_cast<double>(longest);
    if (!axis.from || !axis.to || axis.logarithmic || axis.about == 0) return 0.0;
    const double step = round_step({*axis.from, *axis.to}, axis.about);
    if (!(step > 0.0)) return 0.0;
    for (double k = std::ceil(*axis.from / step); k * step <= *axis.to; k += 1.0) {
      longest = std::max(longest, fmt::format("{:.6g}", k * step).size());
    }
    return 3.6 + 1.1 * static_cast<double>(longest);
  }

  static std::string margins(const Plot& plot, const Picture& picture) {
    if (plot.frame) {
      const double w = picture.width;
      const double h = picture.height;
      return fmt::format(
          "set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n"
          "set bmargin at screen {:.5f}\nset tmargin at screen {:.5f}\n",
          plot.frame->left / w, plot.frame->right / w, plot.frame->bottom / h, plot.frame->top / h);
    }
    const double left = std::max(8.0, room_for_ticks(plot.y));
    // -1 leaves the room to gnuplot, which knows how large the key is.
    const double top = plot.key.place == KeyPlace::above ? -1.0
                       : !plot.remark.empty()            ? 3.4
                       : plot.heading.empty()            ? 1.5
                                                         : 2.2;
    const double foot = plot.key.place == KeyPlace::below ? -1.0 : 3.2;
    return fmt::format("set lmargin {:.1f}\nset rmargin {}\nset bmargin {}\nset tmargin {}\n", left,
                       plot.colours ? -1 : 2, foot, top);
  }

  static std::string heading(const Plot& plot) {
    std::string out;
    const bool two = !plot.remark.empty();
    if (!plot.heading.empty()) {
      out += fmt::format(
          "set label {} at graph 0, graph 1 left offset 0,{} font ',{}' textcolor rgb '{}'\n",
          gnuplot_text(plot.heading), two ? 1.9 : 0.8, plot.frame ? 13 : 14, ink);
    }
    if (two) {
      out += fmt::format(
          "set label {} at graph 0, graph 1 left offset 0,0.7 font ',12' textcolor rgb '{}'\n",
          gnuplot_text(plot.remark), plot.remark_colour);
    }
    return out;
  }

  std::string plot_commands(const Plot& plot, const Picture& picture) {
    // Axes at the left and below, a light grid, and nothing else.
    std::string commands =
        "set border 3 lc rgb '#555555' lw 1\n"
        "set tics nomirror out scale 0.6,0.3 textcolor rgb '#333333'\n"
        "set grid lc rgb '#e4e4e4' lt 1 lw 0.8\n"
        "set key textcolor rgb '#222222' samplen 1.8 spacing 1.05 height 0.3\n";
    if (plot.bare) commands += "unset border\nunset tics\nunset grid\n";
    commands += margins(plot, picture) + key_commands(plot.key) + heading(plot);
    if (plot.colours) commands += colour_commands(*plot.colours);
    if (plot.bare) {
      commands += fmt::format("set xrange [{:.7g}:{:.7g}]\nset yrange [{:.7g}:{:.7g}]\n",
                              plot.x.from.value_or(0.0), plot.x.to.value_or(1.0),
                              plot.y.from.value_or(0.0), plot.y.to.value_or(1.0));
    } else {
      commands += axis_commands('x', plot.x) + axis_commands('y', plot.y);
    }
    std::vector<std::string> elements;
    for (const Layer& layer : plot.layers) {
      std::string one =
          std::visit([&](const auto& shown) { return element(shown, commands); }, layer);
      if (!one.empty()) elements.push_back(std::move(one));
    }
    if (elements.empty()) elements.emplace_back("NaN notitle");
    return commands + fmt::format("plot {}\n", fmt::join(elements, ", \\\n  "));
  }

  /// One key for all plots of the picture, as a plot without axes.
  static std::string common_key(const Picture& picture) {
    std::string out =
        "reset\nset key textcolor rgb '#222222' spacing 1.05 height 0.3\n"
        "unset tics\nunset border\nset lmargin at screen 0\nset rmargin at screen 1\n"
        "set bmargin at screen 0\nset tmargin at screen 1\nset xrange [0:1]\nset yrange [0:1]\n";
    out += picture.key.place == KeyPlace::upper_right
               ? std::string(
                     "set key at screen 0.985, screen 0.975 right top vertical Left reverse "
                     "samplen 1.6\n")
               : fmt::format(
                     "set key at screen 0.5, screen 0.99 center top horizontal Left reverse "
                     "samplen 1.4 maxrows {} width 1\n",
                     picture.key.rows);
    std::vector<std::string> entries;
    std::set<std::string> named;
    for (const Plot& plot : picture.plots) {
      for (const Layer& layer : plot.layers) {
        const std::string& name = name_of(layer);
        if (!name.empty() && named.insert(name).second) entries.push_back(key_entry(layer));
      }
    }
    if (entries.empty()) entries.emplace_back("NaN notitle");
    return out + fmt::format("plot {}\n", fmt::join(entries, ", \\\n  "));
  }

  std::string script_;
  int blocks_ = 0;
};

}  // namespace

std::string gnuplot_script(const std::vector<const Picture*>& pictures) {
  ScriptWriter writer;
  for (const Picture* picture : pictures) writer.add(*picture);
  return std::move(writer).script();
}

std::string gnuplot_text(std::string_view text) {
  // In single quotes nothing is substituted; a line ends in a string of its own.
  std::string out;
  for (std::size_t at = 0;;) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    out += line_of_text(text.substr(at, end - at));
    if (end == text.size()) return out;
    out += ".\"\\n\".";
    at = end + 1;
  }
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
