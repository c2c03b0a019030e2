#include "plot/inline_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "plot/xml.hpp"

namespace recoil::plot {
namespace {

/// What elements inherit, with the values of the root: those that gnuplot repeats in every group,
/// and SVG's own initial values.
const std::map<std::string, std::string>& inherited_at_the_root() {
  static const std::map<std::string, std::string> values = {{"fill", "none"},
                                                            {"color", "black"},
                                                            {"stroke", "currentColor"},
                                                            {"stroke-width", "1"},
                                                            {"stroke-linecap", "butt"},
                                                            {"stroke-linejoin", "miter"},
                                                            {"font-family", "DejaVu Sans"},
                                                            {"font-size", "13"},
                                                            {"text-anchor", "start"},
                                                            {"font-style", "normal"},
                                                            {"font-weight", "normal"},
                                                            {"fill-opacity", "1"}};
  return values;
}

void for_each(XmlNode& node, const std::function<void(XmlNode&)>& act) {
  act(node);
  for (XmlNode& child : node.children) for_each(child, act);
}

/// The id that an attribute points to: xlink:href="#id" or any "url(#id)"; empty where it points to
/// none.
std::string target_of(const std::string& key, const std::string& value) {
  if ((key == "href" || key == "xlink:href") && value.starts_with("#")) return value.substr(1);
  if (value.starts_with("url(#") && value.ends_with(")")) return value.substr(5, value.size() - 6);
  return "";
}

/// Drops definitions that nothing points to, until all are used.
void drop_unused_definitions(XmlNode& root) {
  for (bool changed = true; std::exchange(changed, false);) {
    std::set<std::string> used;
    for_each(root, [&](XmlNode& node) {
      for (const auto& [key, value] : node.attributes) used.insert(target_of(key, value));
    });
    for_each(root, [&](XmlNode& node) {
      if (node.name != "defs") return;
      changed |= std::erase_if(node.children, [&](const XmlNode& child) {
                   const std::string* id = child.attribute("id");
                   return id != nullptr && !used.contains(*id);
                 }) > 0;
    });
  }
}

/// The number that `text` is but for blanks around it, whatever the locale; nullopt for others.
std::optional<double> number_in(std::string_view text) {
  const auto blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Numbers with one decimal, without a zero at the end. What follows a move in a path is a line
/// without saying so.
std::string rounded_numbers(std::string_view text) {
  std::string out;
  char last = ' ';  // command
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    if (!digit && c != '-' && c != '.') {
      if (c == 'L' && (last == 'M' || last == 'L')) {
        ++i;  // a vertex after a vertex
        continue;
      }
      if (std::isalpha(static_cast<unsigned char>(c)) != 0) last = c;
      const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
      if (!blank) {
        while (!out.empty() && out.back() == ' ') out.pop_back();
        out += c;
      } else if (!out.empty() && out.back() != ' ') {
        out += ' ';
      }
      ++i;
      continue;
    }
    std::size_t end = i + 1;
    while (end < text.size() &&
           (std::isdigit(static_cast<unsigned char>(text[end])) != 0 || text[end] == '.')) {
      ++end;
    }
    const std::string_view token = text.substr(i, end - i);
    const std::optional<double> value = number_in(token);
    std::string number = value ? fmt::format("{:.1f}", *value) : std::string(token);
    if (number.ends_with(".0")) number.resize(number.size() - 2);
    out += number == "-0" ? "0" : number;
    i = end;
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

/// The numbers in "translate(53.94,258.40) scale(4.88)", where its words are `words`:
/// {"translate(", ",", ") scale(", ")"}. nullopt where it has another form.
template <std::size_t count>
std::optional<std::array<double, count - 1>> numbers_between(
    std::string_view text, const std::array<std::string_view, count>& words) {
  std::array<double, count - 1> numbers{};
  for (std::size_t k = 0; k < count; ++k) {
    if (!text.starts_with(words[k])) return std::nullopt;
    text.remove_prefix(words[k].size());
    if (k + 1 == count) break;
    const std::size_t end = text.find(words[k + 1]);
    const std::optional<double> number = number_in(text.substr(0, end));
    if (end == std::string_view::npos || !number) return std::nullopt;
    numbers[k] = *number;
    text.remove_prefix(end);
  }
  return text.empty() ? std::optional(numbers) : std::nullopt;
}

/// "rgb( 34,  34,  34)" as "#222222".
std::string short_colour(const std::string& value) {
  const auto parts = numbers_between<4>(value, {"rgb(", ",", ",", ")"});
  if (!parts) return value;
  std::string colour = "#";
  for (const double part : *parts) colour += fmt::format("{:02x}", static_cast<int>(part));
  return colour;
}

/// "translate(53.94,258.40) scale(4.88)" with a short place.
std::string short_transform(const std::string& value) {
  const std::size_t open = value.find("translate(");
  const std::size_t close = value.find(')', open);
  if (open == std::string::npos || close == std::string::npos) return value;
  const std::size_t begin = open + std::string_view("translate(").size();
  return value.substr(0, begin) + rounded_numbers(value.substr(begin, close - begin)) +
         value.substr(close);
}

void shorten_values(XmlNode& node) {
  if (node.name == "defs") return;  // marks are drawn on a scale of their own
  for (auto& [key, value] : node.attributes) {
    value = short_colour(value);
    if (key == "d" || key == "points") value = rounded_numbers(value);
    if (key == "transform") value = short_transform(value);
    if (key == "font-size" || key == "stroke-width") {
      if (const auto number = number_in(value)) value = fmt::format("{:g}", *number);
    }
  }
  for (XmlNode& child : node.children) shorten_values(child);
}

/// Removes what says nothing: tooltips, groups without content, text without words.
void drop_empty(XmlNode& node) {
  for (XmlNode& child : node.children) drop_empty(child);
  std::erase_if(node.children, [](const XmlNode& child) {
    const bool holder =
        child.name == "g" || child.name == "text" || child.name == "tspan" || child.name == "defs";
    return child.name == "title" || child.name == "desc" || (holder && child.children.empty());
  });
}

/// Says what a shape without colours looks like, since the new root says it otherwise.
void state_initial_colours(XmlNode& node, bool filled, bool stroked) {
  if (node.name == "defs") return;
  filled = filled || node.attribute("fill") != nullptr;
  stroked = stroked || node.attribute("stroke") != nullptr;
  if (node.name == "g" || node.name == "svg") {
    for (XmlNode& child : node.children) state_initial_colours(child, filled, stroked);
  } else if (!node.is_text()) {
    if (!filled) node.attributes.emplace_back("fill", "black");
    if (!stroked) node.attributes.emplace_back("stroke", "none");
  }
}

/// Removes attributes that repeat what is inherited. A definition inherits from where it is used.
void drop_repeated(XmlNode& node, std::map<std::string, std::string> inherited) {
  if (node.name == "defs") return;
  node.erase_attribute("class");
  std::erase_if(node.attributes, [&](const auto& pair) {
    const auto found = inherited.find(pair.first);
    return found != inherited.end() && found->second == pair.second;
  });
  for (const auto& [key, value] : node.attributes) {
    const auto found = inherited.find(key);
    if (found != inherited.end()) found->second = value;
  }
  for (XmlNode& child : node.children) drop_repeated(child, inherited);
}

/// A group around one element hands its attributes on; one without attributes dissolves.
void flatten(XmlNode& node) {
  std::vector<XmlNode> flat;
  for (XmlNode& child : node.children) {
    flatten(child);
    const bool group = (child.name == "g" || child.name == "tspan") && !child.attribute("id");
    if (group && child.name == "g" && child.children.size() == 1) {
      XmlNode& only = child.children.front();
      const bool clash = only.is_text() || only.attribute("transform") ||
                         std::any_of(child.attributes.begin(), child.attributes.end(),
                                     [&](const auto& pair) { return only.attribute(pair.first); });
      if (!clash) {
        only.attributes.insert(only.attributes.begin(), child.attributes.begin(),
                               child.attributes.end());
        XmlNode inner = std::move(only);
        flat.push_back(std::move(inner));
        continue;
      }
    }
    if (group && child.attributes.empty()) {
      std::move(child.children.begin(), child.children.end(), std::back_inserter(flat));
    } else {
      flat.push_back(std::move(child));
    }
  }
  node.children = std::move(flat);
}

struct Dot {
  double x = 0.0, y = 0.0, scale = 0.0;
};

/// Reads "translate(X,Y) scale(S)". @return whether `transform` has this form
bool read_dot(std::string_view transform, Dot& dot) {
  const auto read = numbers_between<4>(transform, {"translate(", ",", ") scale(", ")"});
  if (read) dot = {(*read)[0], (*read)[1], (*read)[2]};
  return read.has_value();
}

/// A filled circle of radius 1, or what points to one.
bool is_disc(const std::map<std::string, const XmlNode*>& definitions, const std::string& id) {
  const auto found = definitions.find(id);
  if (found == definitions.end()) return false;
  const XmlNode& node = *found->second;
  const std::string* fill = node.attribute("fill");
  const std::string* href = node.attribute("xlink:href");
  const XmlNode* shape = &node;
  if (node.name == "use" && href != nullptr) {
    const auto drawn = definitions.find(target_of("href", *href));
    if (drawn == definitions.end()) return false;
    shape = drawn->second;
  }
  const std::string* radius = shape->attribute("r");
  return fill != nullptr && *fill == "currentColor" && shape->name == "circle" &&
         radius != nullptr && *radius == "1";
}

/// Runs of equal discs as one path: strokes without length and with round ends, a sixth of the
/// text.
void pack_dots(XmlNode& node, const std::map<std::string, const XmlNode*>& definitions) {
  constexpr std::size_t fewest = 3;
  std::vector<XmlNode> packed;
  std::vector<XmlNode> run;
  std::vector<Dot> dots;
  const auto flush = [&] {
    if (run.size() >= fewest) {
      std::string path;
      for (const Dot& dot : dots) path += fmt::format("M{} {}h0", dot.x, dot.y);
      const std::string* colour = run.front().attribute("color");
      XmlNode one{"path", "", {}, {}};
      one.attributes = {{"stroke", colour != nullptr ? *colour : "currentColor"},
                        {"stroke-width", fmt::format("{:.4g}", 2.0 * dots.front().scale)},
                        {"stroke-linecap", "round"},
                        {"d", rounded_numbers(path)}};
      packed.push_back(std::move(one));
    } else {
      std::move(run.begin(), run.end(), std::back_inserter(packed));
    }
    run.clear();
    dots.clear();
  };
  for (XmlNode& child : node.children) {
    pack_dots(child, definitions);
    Dot dot;
    const std::string* href = child.attribute("xlink:href");
    const std::string* transform = child.attribute("transform");
    const bool disc = child.name == "use" && href != nullptr && transform != nullptr &&
                      child.children.empty() && is_disc(definitions, target_of("href", *href)) &&
                      read_dot(*transform, dot);
    const auto same_but_place = [&](const XmlNode& other) {
      if (other.attributes.size() != child.attributes.size()) return false;
      for (const auto& [key, value] : child.attributes) {
        const std::string* its = other.attribute(key);
        if (key != "transform" && (its == nullptr || *its != value)) return false;
      }
      return true;
    };
    if (!run.empty() &&
        (!disc || dots.front().scale != dot.scale || !same_but_place(run.front()))) {
      flush();
    }
    if (disc) {
      run.push_back(std::move(child));
      dots.push_back(dot);
    } else {
      packed.push_back(std::move(child));
    }
  }
  flush();
  node.children = std::move(packed);
}

/// Neighbouring lines that look the same as one path.
void join_lines(XmlNode& node) {
  for (XmlNode& child : node.children) join_lines(child);
  if (node.name == "defs") return;
  const auto line = [](const XmlNode& one) {
    const std::string* d = one.attribute("d");
    return one.name == "path" && d != nullptr && d->starts_with("M") && !one.attribute("id") &&
           !one.attribute("fill") && !one.attribute("transform");
  };
  const auto look = [](const XmlNode& one) {
    std::map<std::string, std::string> all(one.attributes.begin(), one.attributes.end());
    all.erase("d");
    return all;
  };
  std::vector<XmlNode> joined;
  for (XmlNode& child : node.children) {
    if (!joined.empty() && line(joined.back()) && line(child) &&
        look(joined.back()) == look(child)) {
      *joined.back().attribute("d") += *child.attribute("d");
    } else {
      joined.push_back(std::move(child));
    }
  }
  node.children = std::move(joined);
}

void prefix_ids(XmlNode& root, const std::string& name) {
  for_each(root, [&](XmlNode& node) {
    for (auto& [key, value] : node.attributes) {
      const std::string target = target_of(key, value);
      if (key == "id") {
        value = name + "-" + value;
      } else if (!target.empty()) {
        value.replace(value.find('#') + 1, target.size(), name + "-" + target);
      }
    }
  });
}

}  // namespace

std::string inline_svg(std::string_view document, const Picture& picture) {
  XmlNode root = parse_xml(document);
  if (root.name != "svg") throw ComputationError("gnuplot did not draw SVG");
  shorten_values(root);
  drop_empty(root);
  state_initial_colours(root, false, false);
  drop_repeated(root, inherited_at_the_root());
  std::map<std::string, const XmlNode*> definitions;
  for_each(root, [&](XmlNode& node) {
    if (const std::string* id = node.attribute("id")) definitions[*id] = &node;
  });
  // Dots are packed before anything moves: the definitions are looked up where they stand.
  XmlNode drawn = root;
  pack_dots(drawn, definitions);
  flatten(drawn);
  drop_repeated(drawn, inherited_at_the_root());
  join_lines(drawn);
  drop_unused_definitions(drawn);
  drop_empty(drawn);
  prefix_ids(drawn, picture.name);

  const std::string title = escape_xml(picture.title);
  XmlNode out{"svg", "", {}, {}};
  out.attributes = {{"id", picture.name},
                    {"viewBox", fmt::format("0 0 {} {}", picture.width, picture.height)},
                    {"width", "100%"},
                    {"role", "img"},
                    {"aria-label", title},
                    {"xmlns", "http://www.w3.org/2000/svg"},
                    {"xmlns:xlink", "http://www.w3.org/1999/xlink"}};
  for (const auto& [key, value] : inherited_at_the_root()) {
    if (key == "font-family") {
      out.attributes.emplace_back(key, value + ", Verdana, Helvetica, Arial, sans-serif");
    } else if (key == "fill" || key == "color" || key == "stroke" || key == "font-size") {
      out.attributes.emplace_back(key, value);
    }
  }
  out.children.push_back({"title", "", {}, {{"", title, {}, {}}}});
  std::move(drawn.children.begin(), drawn.children.end(), std::back_inserter(out.children));
  return write_xml(out);
}

}  // namespace recoil::plot
