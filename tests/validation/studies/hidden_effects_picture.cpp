#include "validation/studies/hidden_effects_picture.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "validation/studies/hidden_effects_page.hpp"

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
std::optional<double> share_of(const std::vector<PowerRow>& powers, const Curve& curve,
                               double strength) {
  double n = 0.0;
  double hits = 0.0;
  for (const PowerRow& row : powers) {
    if (row.arm != Arm::effect || row.signal_to_noise != strength) continue;
    for (const auto& [mark, count] : row.marks) {
      const bool in = std::any_of(curve.marks.begin(), curve.marks.end(),
                                  [&](Mark one) { return recoil::name_of(one) == mark; });
      n += count;
      hits += in != curve.without ? count : 0;
    }
  }
  return n > 0.0 ? std::optional(100.0 * hits / n) : std::nullopt;
}

plot::Plot power_panel(const StudyTally& tally) {
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
      const std::optional<double> share = share_of(tally.powers, curves()[k], strength);
      line.x.push_back(strength);
      line.y.push_back(share.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    panel.layers.push_back(std::move(line));
  }
  return panel;
}

plot::Plot heat_panel(const Confusion& c) {
  plot::Plot panel;
  panel.frame = plot::Frame{0.50 * width, 0.91 * width, 0.30 * height, 0.92 * height};
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

recoil::plot::Picture hidden_effects_picture(const StudyTally& tally) {
  plot::Picture picture;
  picture.name = "hidden-effects";
  picture.title = "Power of the diagnosis against strength, and what is taken for what";
  picture.width = width;
  picture.height = height;
  picture.plots = {power_panel(tally), heat_panel(tally.confusion)};
  return picture;
}

}  // namespace hidden
