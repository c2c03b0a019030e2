#include "python/picture_json.hpp"

#include <cmath>

#include "core/json.hpp"

namespace recoil {
namespace {

std::string mark_name(plot::Mark mark) {
  switch (mark) {
    case plot::Mark::dot:
      return "dot";
    case plot::Mark::circle:
      return "circle";
    case plot::Mark::square:
      return "square";
    case plot::Mark::open_square:
      return "open_square";
    case plot::Mark::triangle:
      return "triangle";
    case plot::Mark::triangle_down:
      return "triangle_down";
    case plot::Mark::open_triangle_down:
      return "open_triangle_down";
    case plot::Mark::diamond:
      return "diamond";
    case plot::Mark::cross:
      return "cross";
  }
  return "dot";
}

Json optional_mark(const std::optional<plot::Mark>& mark) {
  return mark ? Json(mark_name(*mark)) : Json(nullptr);
}

Json optional_end(const std::optional<double>& end) {
  return end ? number_or_null(*end) : Json(nullptr);
}

Json stroke_json(const plot::Stroke& stroke) {
  const char* dash = "solid";
  if (stroke.dash == plot::Dash::long_dashes) dash = "long_dashes";
  if (stroke.dash == plot::Dash::dashes) dash = "dashes";
  if (stroke.dash == plot::Dash::dots) dash = "dots";
  if (stroke.dash == plot::Dash::dash_dot) dash = "dash_dot";
  return {{"colour", std::string(stroke.colour)}, {"width", stroke.width}, {"dash", dash}};
}

Json fill_json(const plot::Fill& fill) {
  return {{"colour", fill.colour}, {"opacity", fill.opacity}, {"rim", fill.rim}};
}

Json place_json(const plot::Place& place) {
  return {{"at", number_or_null(place.at)}, {"share", place.share}};
}

/// One kind of layer after the other.
struct LayerJson {
  Json operator()(const plot::Points& p) const {
    return {{"kind", "points"},
            {"x", as_json(p.x)},
            {"y", as_json(p.y)},
            {"lower", as_json(p.lower)},
            {"upper", as_json(p.upper)},
            {"colour", std::string(p.marker.colour)},
            {"mark", mark_name(p.marker.mark)},
            {"size", p.size},
            {"width", p.width}};
  }
  Json operator()(const plot::Line& l) const {
    return {{"kind", "line"},
            {"x", as_json(l.x)},
            {"y", as_json(l.y)},
            {"stroke", stroke_json(l.stroke)},
            {"mark", optional_mark(l.mark)},
            {"size", l.size}};
  }
  Json operator()(const plot::Band& b) const {
    return {{"kind", "band"},
            {"x", as_json(b.x)},
            {"lower", as_json(b.lower)},
            {"upper", as_json(b.upper)},
            {"fill", fill_json(b.fill)}};
  }
  Json operator()(const plot::Boxes& b) const {
    return {{"kind", "boxes"},           {"left", as_json(b.left)},
            {"right", as_json(b.right)}, {"bottom", as_json(b.bottom)},
            {"top", as_json(b.top)},     {"fill", fill_json(b.fill)},
            {"colours", b.colours},      {"values", as_json(b.values)}};
  }
  Json operator()(const plot::Spans& s) const {
    return {{"kind", "spans"},
            {"y", as_json(s.y)},
            {"lower", as_json(s.lower)},
            {"upper", as_json(s.upper)},
            {"stroke", stroke_json(s.stroke)},
            {"stops", s.stops}};
  }
  Json operator()(const plot::Discs& d) const {
    return {
        {"kind", "discs"}, {"x", as_json(d.x)}, {"y", as_json(d.y)}, {"values", as_json(d.values)}};
  }
  Json operator()(const plot::Rule& r) const {
    return {{"kind", "rule"},
            {"vertical", r.direction == plot::Direction::vertical},
            {"at", number_or_null(r.at)},
            {"stroke", stroke_json(r.stroke)},
            {"in_front", r.in_front}};
  }
  Json operator()(const plot::Region& r) const {
    return {{"kind", "region"},
            {"left", optional_end(r.left)},
            {"right", optional_end(r.right)},
            {"bottom", optional_end(r.bottom)},
            {"top", optional_end(r.top)},
            {"fill", fill_json(r.fill)}};
  }
  Json operator()(const plot::Contour& c) const {
    Json rows = Json::array();
    for (const std::vector<double>& row : c.rows) rows.push_back(as_json(row));
    return {{"kind", "contour"},
            {"x", as_json(std::vector<double>{c.x.lower, c.x.upper})},
            {"y", as_json(std::vector<double>{c.y.lower, c.y.upper})},
            {"rows", rows},
            {"level", c.level},
            {"stroke", stroke_json(c.stroke)}};
  }
  Json operator()(const plot::Words& w) const {
    const char* align = "left";
    if (w.align == plot::Align::centre) align = "center";
    if (w.align == plot::Align::right) align = "right";
    return {{"kind", "words"},      {"text", w.text},
            {"x", place_json(w.x)}, {"y", place_json(w.y)},
            {"align", align},       {"size", w.size},
            {"colour", w.colour},   {"shift", {w.shift_x, w.shift_y}},
            {"turned", w.turned},   {"bold", w.bold}};
  }
};

Json axis_json(const plot::Axis& axis) {
  Json ticks = Json::array();
  for (const plot::Tick& tick : axis.ticks) {
    ticks.push_back({{"at", number_or_null(tick.at)}, {"label", tick.label}, {"bold", tick.bold}});
  }
  return {{"title", axis.title()},
          {"from", optional_end(axis.from)},
          {"to", optional_end(axis.to)},
          {"logarithmic", axis.logarithmic},
          {"ticks", ticks},
          {"grid", axis.grid},
          {"shown", axis.shown},
          {"upright", axis.upright}};
}

std::string key_place(const plot::Key& key) {
  switch (key.place) {
    case plot::KeyPlace::none:
      return "none";
    case plot::KeyPlace::above:
      return "above";
    case plot::KeyPlace::below:
      return "below";
    case plot::KeyPlace::lower_right:
      return "lower right";
    case plot::KeyPlace::upper_right:
      return "upper right";
  }
  return "none";
}

Json colours_json(const plot::ColourScale& scale) {
  Json stops = Json::array();
  for (const auto& [at, colour] : scale.stops) stops.push_back({at, std::string(colour)});
  return {
      {"label", scale.label}, {"range", {scale.range.lower, scale.range.upper}}, {"stops", stops}};
}

Json plot_json(const plot::Plot& plot) {
  Json layers = Json::array();
  for (const plot::Layer& layer : plot.layers) {
    Json entry = std::visit(LayerJson{}, layer);
    entry["name"] = plot::name_of(layer);
    layers.push_back(std::move(entry));
  }
  Json frame = nullptr;
  if (plot.frame) {
    frame = {plot.frame->left, plot.frame->bottom, plot.frame->right, plot.frame->top};
  }
  return {{"heading", plot.heading},
          {"remark", plot.remark},
          {"x", axis_json(plot.x)},
          {"y", axis_json(plot.y)},
          {"key", key_place(plot.key)},
          {"colours", plot.colours ? colours_json(*plot.colours) : Json(nullptr)},
          {"layers", layers},
          {"frame", frame},
          {"bare", plot.bare}};
}

Json figure_json(const Figure& figure) {
  const plot::Picture& picture = figure.picture;
  Json plots = Json::array();
  for (const plot::Plot& plot : picture.plots) plots.push_back(plot_json(plot));
  return {
      {"name", picture.name},   {"title", picture.title},   {"caption", plain_text(figure.caption)},
      {"width", picture.width}, {"height", picture.height}, {"key", key_place(picture.key)},
      {"plots", plots}};
}

}  // namespace

Json pictures_json(const std::vector<Figure>& figures) {
  Json out = Json::array();
  for (const Figure& figure : figures) out.push_back(figure_json(figure));
  return out;
}

Json pictures_json(const Document& document) {
  Json out = Json::array();
  for (const Section& section : document.sections) {
    for (const Figure* figure : figures_of(section)) out.push_back(figure_json(*figure));
  }
  return out;
}

}  // namespace recoil
