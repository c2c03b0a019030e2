#include "report/svg_tidy.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string_view>
#include <vector>

namespace recoil {
namespace {

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
}

/// Removes every `open`...`close`, both included.
void remove_between(std::string& text, std::string_view open, std::string_view close) {
  for (std::size_t at = 0; (at = text.find(open, at)) != std::string::npos;) {
    const std::size_t end = text.find(close, at);
    if (end == std::string::npos) return;
    text.erase(at, end + close.size() - at);
  }
}

/// Removes the groups that gnuplot opens and closes without drawing.
void remove_empty_groups(std::string& text) {
  constexpr std::string_view close = "</g>\n";
  for (std::size_t at = 0; (at = text.find("<g fill", at)) != std::string::npos;) {
    const std::size_t end = text.find(">\n", at);
    if (end != std::string::npos && text.compare(end + 2, close.size(), close) == 0) {
      text.erase(at, end + 2 + close.size() - at);
    } else {
      ++at;
    }
  }
}

/// Markers and filters that are defined but not used.
void remove_unused_definitions(std::string& text) {
  remove_between(text, "\t<filter", "</filter>\n");
  if (text.find("href='#gpDot'") == std::string::npos) {
    remove_between(text, "\t<circle id='gpDot'", "/>\n");
  }
  for (int marker = 14; marker >= 0; --marker) {  // downwards: a marker may use a lower one
    if (text.find(fmt::format("href='#gpPt{}'", marker)) != std::string::npos) continue;
    const std::size_t id = text.find(fmt::format("id='gpPt{}'", marker));
    if (id == std::string::npos) continue;
    const std::size_t begin = text.rfind('\n', id) + 1;
    text.erase(begin, text.find('\n', id) + 1 - begin);
  }
}

/// "rgb( 34,  34,  34)" as "#222222".
void shorten_colours(std::string& text) {
  for (std::size_t at = 0; (at = text.find("rgb(", at)) != std::string::npos; ++at) {
    int red = 0;
    int green = 0;
    int blue = 0;
    int length = 0;
    if (std::sscanf(text.c_str() + at, "rgb(%d,%d,%d)%n", &red, &green, &blue, &length) == 3 &&
        length > 0) {
      text.replace(at, static_cast<std::size_t>(length),
                   fmt::format("#{:02x}{:02x}{:02x}", red, green, blue));
    }
  }
}

/// One filled circle as gnuplot draws it.
struct Dot {
  double x = 0.0, y = 0.0, radius = 0.0;
  std::string colour;
};

std::optional<Dot> dot_in(const std::string& line) {
  Dot dot;
  char colour[16] = {};
  int length = 0;
  constexpr const char* form =
      " <use xlink:href='#gpPt6' transform='translate(%lf,%lf) scale(%lf)' "
      "color='%15[#0-9a-f]'/>%n";
  if (std::sscanf(line.c_str(), form, &dot.x, &dot.y, &dot.radius, colour, &length) != 4 ||
      length != static_cast<int>(line.size())) {
    return std::nullopt;
  }
  dot.colour = colour;
  return dot;
}

/// Clouds of equal dots as one path each: strokes without length and with round ends, a sixth of
/// the text.
void pack_dots(std::string& text) {
  constexpr std::size_t fewest = 3;
  std::string out;
  std::string pending;  // the lines of a run, should it stay short
  std::string path;
  std::size_t count = 0;
  Dot first;
  const auto flush = [&] {
    if (count >= fewest) {
      out +=
          fmt::format("<path stroke='{}' stroke-width='{:.2f}' stroke-linecap='round' d='{}'/>\n",
                      first.colour, 2.0 * first.radius, path);
    } else {
      out += pending;
    }
    pending.clear();
    path.clear();
    count = 0;
  };
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    const std::string line = text.substr(at, end - at);
    at = end;
    const std::optional<Dot> dot = dot_in(line.substr(0, line.find('\n')));
    const bool joins =
        dot && count > 0 && dot->colour == first.colour && dot->radius == first.radius;
    if (!joins) flush();
    if (!dot) {
      out += line;
      continue;
    }
    if (count == 0) first = *dot;
    pending += line;
    path += fmt::format("M{:.1f},{:.1f}h0", dot->x, dot->y);
    ++count;
  }
  flush();
  text = std::move(out);
}

/// Coordinate pairs "76.00,198.18" with one decimal, which is a tenth of a pixel.
void shorten_coordinates(std::string& text) {
  const auto digit = [&](std::size_t i) {
    return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) != 0;
  };
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool before = text[i] == ',' && i >= 4 && digit(i - 1) && digit(i - 2) &&
                        text[i - 3] == '.' && digit(i - 4);
    std::size_t end = i + 1;
    while (before && digit(end)) ++end;
    const bool after = before && end > i + 1 && end < text.size() && text[end] == '.' &&
                       digit(end + 1) && digit(end + 2) && !digit(end + 3);
    if (!after) {
      out += text[i];
      continue;
    }
    out.pop_back();
    out += text.substr(i, end + 2 - i);
    i = end + 2;
  }
  text = std::move(out);
}

/// x and y of "L76.0,198.2", as text.
struct Vertex {
  std::string_view x, y;
};

std::optional<Vertex> vertex_in(std::string_view token) {
  const std::size_t comma = token.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const Vertex vertex{token.substr(1, comma - 1), token.substr(comma + 1)};
  const bool plain = !vertex.x.empty() && !vertex.y.empty() &&
                     token.substr(1).find_first_not_of("0123456789.,-") == std::string_view::npos;
  return plain ? std::optional(vertex) : std::nullopt;
}

/// Does `middle` lie on the way from `a` to `b` along a horizontal?
bool on_the_level(const Vertex& a, const Vertex& middle, const Vertex& b) {
  if (a.y != middle.y || middle.y != b.y) return false;
  const auto value = [](std::string_view text) { return std::atof(std::string(text).c_str()); };
  return (value(middle.x) - value(a.x)) * (value(b.x) - value(middle.x)) >= 0.0;
}

/// "M1,2 L3,2 L5,2 L5,6" as "M1,2 5,2 5,6": what follows a move is a line without saying so, and a
/// horizontal needs no points between its ends.
std::string shortened_path(std::string_view path) {
  std::vector<std::string> out;
  std::vector<Vertex> line;  // of the polyline under way
  constexpr std::string_view blank = " \t\n";
  for (std::size_t at = path.find_first_not_of(blank); at != std::string_view::npos;) {
    const std::size_t end = std::min(path.find_first_of(blank, at), path.size());
    const std::string_view token = path.substr(at, end - at);
    at = path.find_first_not_of(blank, end);
    const std::optional<Vertex> vertex = vertex_in(token);
    const bool goes_on = vertex && token.front() == 'L' && !line.empty();
    if (!goes_on) line.clear();
    if (goes_on && line.size() > 1 && on_the_level(line[line.size() - 2], line.back(), *vertex)) {
      line.pop_back();
      out.pop_back();
    }
    out.emplace_back(goes_on ? token.substr(1) : token);
    if (goes_on || (vertex && token.front() == 'M')) line.push_back(*vertex);
  }
  return fmt::format("{}", fmt::join(out, " "));
}

void shorten_paths(std::string& text) {
  constexpr std::string_view open = " d='";
  std::string out;
  out.reserve(text.size());
  std::size_t done = 0;
  for (std::size_t tag = 0; (tag = text.find("<path", tag)) != std::string::npos; ++tag) {
    const std::size_t at = text.find(open, tag);
    if (at == std::string::npos || at > text.find('>', tag)) continue;
    const std::size_t begin = at + open.size();
    const std::size_t end = text.find('\'', begin);
    if (end == std::string::npos) break;
    out += text.substr(done, begin - done);
    out += shortened_path(std::string_view(text).substr(begin, end - begin));
    done = end;
  }
  text = out + text.substr(done);
}

/// A text in one piece as "<text>words</text>".
void unwrap_texts(std::string& text) {
  const auto unwrap = [&](const std::string& open, const std::string& short_open) {
    constexpr std::string_view close = "</tspan></text>";
    for (std::size_t at = 0; (at = text.find(open, at)) != std::string::npos; ++at) {
      const std::size_t end = text.find('<', at + open.size());
      if (end == std::string::npos || text.compare(end, close.size(), close) != 0) continue;
      text.erase(end, std::strlen("</tspan>"));
      text.replace(at, open.size(), short_open);
    }
  };
  unwrap("<text><tspan>", "<text>");
  unwrap("<text xml:space=\"preserve\"><tspan  xml:space=\"preserve\">",
         "<text xml:space=\"preserve\">");
}

/// A group that places one text as a text that says itself where it stands; without words, as
/// nothing.
void place_texts(std::string& text) {
  constexpr std::string_view open = "<g transform=";
  constexpr std::string_view inner = ">\n<text";
  constexpr std::string_view close = "</text>\n</g>";
  for (std::size_t at = 0; (at = text.find(open, at)) != std::string::npos; ++at) {
    const std::size_t end = text.find('>', at);
    if (end == std::string::npos || text.compare(end, inner.size(), inner) != 0) continue;
    const std::size_t words = end + inner.size();
    const std::size_t last = text.find("</text>", words);
    if (last == std::string::npos || text.compare(last, close.size(), close) != 0) continue;
    const std::string attributes = text.substr(at + 2, end - at - 2);
    const std::string content = text.substr(words, last - words);
    text.replace(at, last + close.size() - at,
                 content == ">" ? "" : fmt::format("<text{}{}</text>", attributes, content));
  }
}

}  // namespace

void tidy_svg(std::string& svg, const std::string& name) {
  remove_between(svg, "<title>", "</title>");
  remove_empty_groups(svg);
  // What every group repeats is said once, on the canvas.
  constexpr std::string_view common = " fill=\"none\" color=\"black\" stroke=\"currentColor\"";
  constexpr std::string_view size = " font-size=\"13.00\" ";
  replace_all(svg, fmt::format("<g{} stroke-width", common), "<g stroke-width");
  replace_all(svg, " font-family=\"DejaVu Sans\" ", " ");
  replace_all(svg, size, "");
  replace_all(svg, " text-anchor=\"start\"", "");
  replace_all(svg, "<g id=\"gnuplot_canvas\"",
              fmt::format("<g id=\"gnuplot_canvas\"{} font-size=\"13\"", common));
  replace_all(svg, "<rect x=", "<rect stroke=\"none\" x=");  // the background has no rim
  replace_all(svg, " class=\"gridline\" ", "");
  shorten_colours(svg);
  pack_dots(svg);
  shorten_coordinates(svg);
  remove_unused_definitions(svg);
  replace_all(svg, "<tspan >", "<tspan>");
  unwrap_texts(svg);
  shorten_paths(svg);
  for (const char* key : {"fill", "fill-opacity", "points"}) {
    replace_all(svg, fmt::format(" {} = '", key), fmt::format(" {}='", key));
  }
  replace_all(svg, "\t", "\n");
  while (svg.find("\n\n") != std::string::npos) replace_all(svg, "\n\n", "\n");
  replace_all(svg, "'  d='", "' d='");
  place_texts(svg);
  replace_all(svg, " stroke-linecap=\"butt\" stroke-linejoin=\"miter\"", "");  // the defaults
  replace_all(svg, "<g stroke-width=\"1.00\">", "<g>");
  replace_all(svg, "\"gnuplot_canvas\"", fmt::format("\"{}-canvas\"", name));
  replace_all(svg, "'gp", fmt::format("'{}-gp", name));
  replace_all(svg, "'#gp", fmt::format("'#{}-gp", name));
}

}  // namespace recoil
