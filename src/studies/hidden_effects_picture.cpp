#include <algorithm>
#include <limits>
#include <optional>

#include "plot/draw.hpp"
#include "study.hpp"

namespace hidden {
namespace {

namespace plot = recoil::plot;

struct Curve {
  const char* label;
  std::vector<Mark> marks;
  bool without;  ///< all but these
};

const std::vector<Curve>& curves() {
  static const std::vector<Curve> all = {
      {"misfit seen", {Mark::nothing, Mark::failed}, true},
      {"named or listed", {Mark::named, Mark::inside}, false},
      {"named outright", {Mark::named}, false},
      {"wrong cause named", {Mark::wrong}, false},
  };
  return all;
}

constexpr int width = 1240;
constexpr int height = 640;

/// The share of the data sets of one strength that a curve counts [%]; none where there are none.
std::optional<double> share_of(const std::vector<Answered>& answers, const Curve& curve,
                               double strength) {
  double n = 0.0;
  double hits = 0.0;
  for (const Answered& a : answers) {
    if (!a.reached || chapter_of(a.order) != Chapter::effect ||
        a.order.signal_to_noise != strength) {
      continue;
    }
    const bool in =
        std::find(curve.marks.begin(), curve.marks.end(), mark_of(a)) != curve.marks.end();
    n += 1.0;
    hits += in != curve.without ? 1.0 : 0.0;
  }
  return n > 0.0 ? std::optional(100.0 * hits / n) : std::nullopt;
}

plot::Plot power_panel(const std::vector<Answered>& answers) {
  plot::Plot panel;
  panel.frame = plot::Frame{0.07 * width, 0.33 * width, 0.30 * height, 0.86 * height};
  panel.heading = "One effect, several diameters";
  panel.x = {"signal-to-noise of the misfit left"};
  panel.x.logarithmic = true;
  panel.x.set_range({4.5, 45.0});
  panel.x.ticks = {{5.0, "5"}, {10.0, "10"}, {20.0, "20"}, {40.0, "40"}};
  panel.y = {"data sets", "%"};
  panel.y.set_range({0.0, 102.0});
  panel.y.about = 5;
  panel.key = {plot::KeyPlace::below, 4};
  for (std::size_t k = 0; k < curves().size(); ++k) {
    const plot::Marker& marker = plot::marker(k);
    plot::Line line{{}, {}, {marker.colour, 2.0}, marker.mark, 0.9};
    line.name = curves()[k].label;
    for (const double strength : study_strengths()) {
      const std::optional<double> share = share_of(answers, curves()[k], strength);
      line.x.push_back(strength);
      line.y.push_back(share.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    panel.layers.push_back(std::move(line));
  }
  return panel;
}

plot::Plot heat_panel(const std::vector<Answered>& answers) {
  const Confusion c = confusion_of(answers);
  plot::Plot panel;
  panel.frame = plot::Frame{0.50 * width, 0.93 * width, 0.30 * height, 0.92 * height};
  panel.heading = "Hidden (rows) and answered (columns), snr 10 and more";
  panel.x.set_range({-0.5, static_cast<double>(c.columns.size()) - 0.5});
  panel.y.set_range({static_cast<double>(c.rows.size()) - 0.5, -0.5});
  for (plot::Axis* axis : {&panel.x, &panel.y}) {
    axis->grid = false;
    axis->tick_size = 10.0;
  }
  panel.x.upright = true;
  for (const std::string& column : c.columns) {
    panel.x.ticks.push_back({static_cast<double>(panel.x.ticks.size()), column});
  }
  plot::Boxes cells;
  for (std::size_t r = 0; r < c.rows.size(); ++r) {
    const double row = static_cast<double>(r);
    panel.y.ticks.push_back({row, c.rows[r]});
    double sum = 0.0;
    for (const int n : c.counts[r]) sum += n;
    for (std::size_t k = 0; k < c.columns.size(); ++k) {
      const double column = static_cast<double>(k);
      cells.add(column - 0.5, column + 0.5, row - 0.5, row + 0.5);
      cells.values.push_back(sum > 0.0 ? 100.0 * c.counts[r][k] / sum : 0.0);
    }
  }
  panel.colours = plot::ColourScale{
      "", {0.0, 100.0}, {{0.0, "#ffffff"}, {0.01, "#e8f1f8"}, {1.0, plot::blue}}, "%g %%"};
  panel.layers = {std::move(cells)};
  return panel;
}

}  // namespace

Confusion confusion_of(const std::vector<Answered>& answers) {
  Confusion c;
  std::vector<std::string> ids;
  for (const HiddenEffect& effect : hidden_effects()) {
    if (effect.kind == EffectKind::careless) continue;
    c.rows.emplace_back(effect.id);
    if (effect.kind != EffectKind::outside) ids.emplace_back(effect.id);
  }
  c.rows.emplace_back("nothing");
  c.columns = ids;
  const std::vector<Mark> others = {Mark::inside, Mark::outside, Mark::unexplained, Mark::nothing,
                                    Mark::failed};
  for (const Mark mark : others) c.columns.push_back(to_string(mark));
  c.counts.assign(c.rows.size(), std::vector<int>(c.columns.size(), 0));
  const auto index = [](const std::vector<std::string>& list, const std::string& word) {
    return static_cast<std::size_t>(std::find(list.begin(), list.end(), word) - list.begin());
  };
  for (const Answered& a : answers) {
    const Arm arm = arm_of(a.order);
    if (!a.reached || arm == Arm::pair || arm == Arm::single) continue;
    if (arm != Arm::correct && a.order.signal_to_noise < visible) continue;
    const std::size_t row =
        index(c.rows, a.order.effects.empty() ? "nothing" : a.order.effects.front());
    const Mark mark = mark_of(a);
    if (std::find(others.begin(), others.end(), mark) != others.end()) {
      ++c.counts[row][index(c.columns, to_string(mark))];
      continue;
    }
    for (const std::string& name : a.named) {
      const std::size_t column = index(c.columns, name);
      if (column < c.columns.size()) ++c.counts[row][column];
    }
  }
  return c;
}

std::string study_picture(const std::vector<Answered>& answers) {
  plot::Picture picture;
  picture.name = "hidden-effects";
  picture.title = "Power of the diagnosis against strength, and what is taken for what";
  picture.width = width;
  picture.height = height;
  picture.plots = {power_panel(answers), heat_panel(answers)};
  return plot::draw_svg(picture) + "\n";
}

}  // namespace hidden
