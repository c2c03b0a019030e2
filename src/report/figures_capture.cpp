#include "report/figures_capture.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>

#include "core/units.hpp"
#include "report/format.hpp"
#include "report/words_predict.hpp"

namespace recoil {
namespace {

/// One look per model, told apart by colour and dashes.
constexpr std::array<plot::Stroke, 5> strokes = {{{plot::blue, 2.0},
                                                  {plot::ink, 2.0, plot::Dash::long_dashes},
                                                  {plot::vermillion, 2.0, plot::Dash::dots},
                                                  {plot::green, 2.0, plot::Dash::dash_dot},
                                                  {plot::purple, 2.0, plot::Dash::dashes}}};

/// d ln V* / d ln d of a curve, from its ends; nothing where it is not positive.
std::optional<double> slope(const std::vector<double>& diameter, const CaptureCurve& curve) {
  if (diameter.size() < 2 || !(curve.velocity.front() > 0.0) || !(curve.velocity.back() > 0.0)) {
    return std::nullopt;
  }
  return std::log(curve.velocity.back() / curve.velocity.front()) /
         std::log(diameter.back() / diameter.front());
}

/// Everything that is shown, with room at both ends.
plot::Range velocities_of(const CaptureComparison& comparison) {
  std::vector<double> all;
  for (const CaptureCurve& curve : comparison.curves) {
    for (const auto* values : {&curve.velocity, &curve.lower, &curve.upper}) {
      all.insert(all.end(), values->begin(), values->end());
    }
  }
  for (const PublishedCapture& one : comparison.published) all.push_back(one.velocity);
  const plot::Range range = plot::log_range_of(all, 0.0);
  return {range.lower / 1.3, range.upper * 1.3};
}

void add_published(const CaptureComparison& comparison, bool measured, plot::Plot& shown) {
  plot::Points points;
  for (const PublishedCapture& one : comparison.published) {
    if (one.measured != measured) continue;
    points.x.push_back(one.diameter / units::um);
    points.y.push_back(one.velocity);
  }
  if (points.x.empty()) return;
  points.marker.mark = measured ? plot::Mark::dot : plot::Mark::circle;
  points.size = 1.1;
  points.width = 1.6;
  points.name = measured ? "published, measured" : "published, of a model";
  shown.layers.push_back(std::move(points));
}

Figure comparison_figure(const Analysis& analysis, const CaptureComparison& comparison) {
  const Dataset& dataset = analysis.datasets[comparison.dataset];
  std::vector<double> diameters = comparison.diameter;
  for (double& diameter : diameters) diameter /= units::um;

  plot::Plot shown;
  shown.heading =
      fmt::format("{} on {}", dataset.system.particle.name, dataset.system.surface.name);
  shown.x = {"diameter d", "µm"};
  shown.x.logarithmic = true;
  shown.x.set_range({diameters.front(), diameters.back()});
  shown.y = {"capture velocity V*", "m/s"};
  shown.y.logarithmic = true;
  shown.y.set_range(velocities_of(comparison));
  shown.key = {plot::KeyPlace::below, 4};
  std::vector<Sentence> words;
  for (std::size_t i = 0; i < comparison.curves.size(); ++i) {
    const CaptureCurve& curve = comparison.curves[i];
    const plot::Stroke& stroke = strokes[i % strokes.size()];
    if (!curve.lower.empty()) {
      shown.layers.push_back(
          plot::Band{diameters, curve.lower, curve.upper, {std::string(stroke.colour), 0.2}});
    }
    plot::Line line{diameters, curve.velocity, stroke};
    line.name = words_of(curve.model);
    shown.layers.push_back(std::move(line));
    const auto falls = slope(comparison.diameter, curve);
    words.push_back(
        say("{}: {}{}", words_of(curve.model), rests_on_words(comparison, curve.model),
            falls ? say(", {V*} ~ {d}{}", exponent(fmt::format("{:.2f}", *falls))) : Sentence()));
  }
  for (const PublishedCapture& one : comparison.published) {
    words.push_back(say("published, {} at {} µm: {} m/s, {}", one.what, diameter_text(one.diameter),
                        number(one.velocity, 3), one.source));
  }
  add_published(comparison, true, shown);
  add_published(comparison, false, shown);
  for (const std::string& note : capture_notes(comparison, dataset)) words.emplace_back(note);

  plot::Picture picture;
  picture.name = fmt::format("capture-models-{}", comparison.dataset + 1);
  picture.title = fmt::format("Capture velocity against diameter, {}", dataset.id);
  picture.height = 430;
  picture.plots = {std::move(shown)};
  return figure_of(std::move(picture),
                   say("{}, with the {} band of the fit. {}.", dataset.id,
                       percent(analysis.uncertainty.options.level), join(words, "; ")));
}

}  // namespace

std::vector<Figure> capture_comparison_figures(const Analysis& analysis) {
  std::vector<Figure> figures;
  for (const CaptureComparison& comparison : analysis.captures) {
    if (comparison.diameter.size() < 2 || comparison.curves.empty()) continue;
    figures.push_back(comparison_figure(analysis, comparison));
  }
  return figures;
}

}  // namespace recoil
