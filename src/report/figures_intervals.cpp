#include "report/figures_intervals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/format.hpp"
#include "report/parameter_axis.hpp"
#include "report/words_intervals.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_figures = 16;

/// A bound inside the picture: a thick line, and the forbidden side shaded.
void add_bound(double bound, bool lower, plot::Range range, plot::Plot& shown) {
  if (!range.holds(bound)) return;
  plot::Region forbidden;
  (lower ? forbidden.right : forbidden.left) = bound;
  forbidden.fill = {"#cccccc", 0.55};
  shown.layers.push_back(std::move(forbidden));
  shown.layers.push_back(plot::Rule{plot::Direction::vertical, bound, {plot::ink, 3.0}, true});
  plot::Words name{"bound", plot::on_axis(bound), plot::share_of_plot(1.0)};
  name.align = lower ? plot::Align::left : plot::Align::right;
  name.size = 11.0;
  name.shift_y = 0.5;
  shown.layers.push_back(std::move(name));
}

Figure interval_figure(const Analysis& analysis, std::size_t slot) {
  const ParameterSlot& parameter = analysis.fitted.model.slots[slot];
  const IntervalSet set = intervals_of(analysis, slot);
  const double estimate = analysis.fitted.theta[slot];
  const auto [factor, axis] = parameter_axis(parameter, estimate);
  std::vector<double> ends = {estimate * factor};
  for (const IntervalKind kind : values_of<IntervalKind>()) {
    if (!set[kind].available()) continue;
    ends.push_back(*set[kind].lower * factor);
    ends.push_back(*set[kind].upper * factor);
  }
  plot::Range range = plot::range_of(ends, 0.08);
  const double lower = parameter.lower * factor;
  const double upper = parameter.upper * factor;
  // A bound that is near belongs into the picture: that none of the intervals reaches it is news.
  const double width = range.width();
  if (lower > range.lower - 0.35 * width) range.lower = lower - 0.06 * width;
  if (upper < range.upper + 0.35 * width) range.upper = upper + 0.06 * width;

  plot::Plot shown;
  shown.x = axis;
  shown.x.set_range(range);
  shown.x.about = 7;
  shown.y.set_range({-4.6, 0.6});
  shown.y.grid = false;
  shown.key.place = plot::KeyPlace::above;
  add_bound(lower, true, range, shown);
  add_bound(upper, false, range, shown);
  plot::Rule middle{plot::Direction::vertical, estimate * factor, {plot::vermillion, 2.0}};
  middle.name = "estimate";
  plot::Spans usual;
  usual.stroke = {plot::blue, 2.5};
  plot::Spans chosen;
  chosen.stroke = {plot::green, 5.0};
  chosen.name = "recommended";
  double row = 0.0;
  for (const IntervalKind kind : values_of<IntervalKind>()) {
    const bool is_recommended = set.recommended == kind;
    shown.y.ticks.push_back({row, words_of(kind), is_recommended});
    if (set[kind].available()) {
      plot::Spans& spans = is_recommended ? chosen : usual;
      spans.y.push_back(row);
      spans.lower.push_back(*set[kind].lower * factor);
      spans.upper.push_back(*set[kind].upper * factor);
    } else {
      plot::Words none{"none", plot::share_of_plot(0.02), plot::on_axis(row)};
      none.size = 11.0;
      none.colour = plot::grey;
      shown.layers.push_back(std::move(none));
    }
    row -= 1.0;
  }
  shown.layers.push_back(std::move(usual));
  shown.layers.push_back(std::move(middle));
  shown.layers.push_back(std::move(chosen));
  plot::Picture picture;
  picture.name = fmt::format("intervals-{}", slot + 1);
  picture.title = fmt::format("Intervals of {}", parameter.label());
  picture.height = 250;
  picture.plots = {std::move(shown)};

  Sentence caption = say("{} intervals of {}", percent(analysis.uncertainty.options.level),
                         symbol(parameter.label()));
  const Interval recommended = recommended_interval(set);
  caption += recommended.available()
                 ? fmt::format("; the {} one is recommended.", words_of(set.recommended))
                 : fmt::format(". None is recommended: {}.", missing_words(recommended));
  if (set.disagreement) {
    caption += " " + as_sentence(disagreement_words(analysis.fitted, slot, set));
  }
  return figure_of(std::move(picture), caption);
}

}  // namespace

std::vector<Figure> interval_figures(const Analysis& analysis) {
  std::vector<Figure> figures;
  if (analysis.uncertainty.intervals.empty()) return figures;
  const auto& slots = analysis.fitted.model.slots;
  for (std::size_t slot = 0; slot < slots.size() && figures.size() < most_figures; ++slot) {
    if (slots[slot].free) figures.push_back(interval_figure(analysis, slot));
  }
  return figures;
}

}  // namespace recoil
