#include "report/figures_pairs.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "report/format.hpp"
#include "report/pair_words.hpp"

namespace recoil {
namespace {

constexpr double picture_width = 860.0;
constexpr double row_height = 205.0;
constexpr double key_height = 58.0;
constexpr double foot_height = 62.0;
constexpr std::size_t most_pictures = 4;  // per page, so that it stays about 1 MB
constexpr std::size_t columns = 2;

// From dark to light, after viridis, without the yellow that fades on white.
constexpr std::array<plot::Marker, 5> shades = {{{"#440154", plot::Mark::dot},
                                                 {"#3b528b", plot::Mark::square},
                                                 {"#21908d", plot::Mark::triangle},
                                                 {"#5dc863", plot::Mark::diamond},
                                                 {"#b8c431", plot::Mark::triangle_down}}};

using Value = std::function<std::optional<double>(const PairQuality&)>;

/// One panel: a number of each pair against the lower velocity.
struct Quantity {
  std::string label;
  Value value;
  std::optional<double> full;  ///< the full fit's, a line
  bool log_scale = false;
  bool from_zero = false;
};

std::optional<double> in_percent(std::optional<double> value) {
  if (value) *value *= 100.0;
  return value;
}

std::vector<Quantity> quantities(const PairStudy& study) {
  const auto figure = [&study](std::optional<double> PairFigures::*member) {
    return [&study, member](const PairQuality& pair) { return figures_of(study, pair).*member; };
  };
  const auto percent_of = [](const Value& value) {
    return [value](const PairQuality& pair) { return in_percent(value(pair)); };
  };
  std::vector<Quantity> all;
  all.push_back({"bias of C_H  [%]", percent_of(figure(&PairFigures::bias_C_H)), 0.0});
  all.push_back({"bias of C_A  [%]", percent_of(figure(&PairFigures::bias_C_A)), 0.0});
  all.push_back(
      {"spread of C_H over that of the full fit", figure(&PairFigures::spread_C_H), 1.0, true});
  all.push_back(
      {"spread of C_A over that of the full fit", figure(&PairFigures::spread_C_A), 1.0, true});
  all.push_back({"data sets without an answer  [%]",
                 [](const PairQuality& pair) -> std::optional<double> {
                   return 100.0 * pair.without_answer();
                 },
                 0.0, false, true});
  all.push_back({"held-out error of e, same diameter",
                 [](const PairQuality& pair) { return pair.held_out.series; },
                 study.held_out.series, false, true});
  if (study.held_out.diameters) {
    all.push_back({"held-out error of e, other diameters",
                   [](const PairQuality& pair) { return pair.held_out.diameters; },
                   study.held_out.diameters, false, true});
  }
  return all;
}

/// Up to `shades.size()` of the upper velocities, evenly spaced, the highest among them.
std::vector<double> drawn_upper(const Analysis& a, const PairStudy& study) {
  std::set<double> all;
  for (const PairQuality& pair : study.pairs) {
    all.insert(a.fitted.data.points[pair.high_point].velocity);
  }
  const std::vector<double> sorted(all.begin(), all.end());
  if (sorted.size() <= shades.size()) return sorted;
  std::vector<double> drawn;
  for (std::size_t k = 1; k <= shades.size(); ++k) {
    drawn.push_back(sorted[k * (sorted.size() - 1) / shades.size()]);
  }
  return drawn;
}

/// All panels of one study.
struct Panels {
  const Analysis& analysis;
  const PairStudy& study;
  double unit;  // of velocity: V*, or 1 m/s
  std::vector<double> upper;
  plot::Range x;
  std::vector<Quantity> all;

  double low(const PairQuality& pair) const {
    return analysis.fitted.data.points[pair.low_point].velocity / unit;
  }
  double high(const PairQuality& pair) const {
    return analysis.fitted.data.points[pair.high_point].velocity;
  }

  std::size_t rows() const { return (all.size() + columns - 1) / columns; }

  double height() const {
    return key_height + row_height * static_cast<double>(rows()) + foot_height;
  }

  plot::Frame frame(std::size_t panel) const {
    const double step_x = (picture_width - 8.0) / columns;
    const double left = 56.0 + step_x * static_cast<double>(panel % columns);
    const std::size_t below = rows() - 1 - panel / columns;
    const double bottom = foot_height + row_height * static_cast<double>(below);
    return {left, left + step_x - 84.0, bottom, bottom + row_height - 44.0};
  }

  plot::Plot panel(std::size_t index) const {
    const Quantity& quantity = all[index];
    std::vector<double> values;
    plot::Points cloud;
    cloud.marker.colour = plot::pale;
    cloud.size = 0.35;
    cloud.name = "other choices";
    for (const PairQuality& pair : study.pairs) {
      const std::optional<double> value = quantity.value(pair);
      if (!value) continue;
      values.push_back(*value);
      cloud.x.push_back(low(pair));
      cloud.y.push_back(*value);
    }
    plot::Plot shown;
    shown.frame = frame(index);
    shown.heading = quantity.label;
    shown.x = unit == 1.0 ? plot::Axis{"lower velocity", "m/s"}
                          : plot::Axis{"lower velocity / capture velocity V*"};
    shown.x.logarithmic = true;
    shown.x.set_range(x);
    shown.x.shown = index + columns >= all.size();
    if (quantity.full) {
      values.push_back(*quantity.full);
      plot::Rule full{plot::Direction::horizontal, *quantity.full, {plot::vermillion, 2.0}};
      full.name = "fit to all points";
      shown.layers.push_back(std::move(full));
    }
    shown.y = y_axis(quantity, values);
    shown.layers.push_back(std::move(cloud));
    for (std::size_t k = 0; k < upper.size(); ++k) {
      const plot::Marker& shade = shades[shades.size() - upper.size() + k];
      plot::Line line{{}, {}, {shade.colour, 1.8}, shade.mark};
      line.name = fmt::format("upper {} m/s", number(upper[k], 3));
      for (const PairQuality& pair : study.pairs) {
        if (high(pair) != upper[k]) continue;
        line.x.push_back(low(pair));
        line.y.push_back(quantity.value(pair).value_or(NAN));
      }
      shown.layers.push_back(std::move(line));
    }
    const PairQuality& paper = study.pairs[study.paper];
    if (const std::optional<double> value = quantity.value(paper)) {
      plot::Points ring{{low(paper)}, {*value}};
      ring.marker.mark = plot::Mark::circle;
      ring.size = 2.0;
      ring.width = 2.0;
      ring.name = "the paper's choice";
      shown.layers.push_back(std::move(ring));
    }
    return shown;
  }

  static plot::Axis y_axis(const Quantity& quantity, const std::vector<double>& values) {
    plot::Axis axis;
    if (quantity.log_scale) {
      axis.logarithmic = true;
      axis.set_range(plot::log_range_of(values, 0.08));
      return axis;
    }
    plot::Range range = plot::range_of(values, 0.08);
    if (quantity.from_zero) range.lower = -0.04 * range.upper;
    axis.set_range(range);
    axis.about = 5;
    return axis;
  }
};

Figure pair_figure(const Analysis& analysis, const PairStudy& study) {
  Panels panels{analysis,
                study,
                capture_of(analysis, study).value_or(1.0),
                drawn_upper(analysis, study),
                {},
                quantities(study)};
  std::vector<double> lower;
  for (const PairQuality& pair : study.pairs) lower.push_back(panels.low(pair));
  panels.x = plot::log_range_of(lower, 0.06);

  plot::Picture picture;
  picture.name = fmt::format("pairs-{}", study.dataset + 1);
  picture.title = fmt::format("What two points cost, for every choice of the two, {}",
                              analysis.datasets[study.dataset].id);
  picture.width = static_cast<int>(picture_width);
  picture.height = static_cast<int>(panels.height());
  picture.key = {plot::KeyPlace::above, 2};
  for (std::size_t i = 0; i < panels.all.size(); ++i) picture.plots.push_back(panels.panel(i));

  Sentence caption =
      say("{}, d = {} {um}. Each mark is a choice of two points on which {C_H} and {C_A} are "
          "calibrated, in {} data sets simulated from the fit to all points. Bias: deviation of "
          "the median from the true value; spread: robust standard deviation relative to that of "
          "the full fit to the same data; both from the data sets that have an answer. Error: rms "
          "difference from a new measurement of the points that were not used, noise included.",
          analysis.datasets[study.dataset].id, diameter_text(study.diameter), study.simulations);
  if (study.taken < study.points) {
    caption += fmt::format(" {} of the {} points are tried.", study.taken, study.points);
  }
  return figure_of(std::move(picture), caption, true);
}

}  // namespace

std::vector<Figure> pair_figures(const Analysis& analysis) {
  std::vector<Figure> figures;
  for (const PairStudy& study : analysis.uncertainty.pairs) {
    if (figures.size() == most_pictures) break;
    if (!study.pairs.empty()) figures.push_back(pair_figure(analysis, study));
  }
  return figures;
}

}  // namespace recoil
