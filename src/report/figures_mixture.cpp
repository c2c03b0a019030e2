#include "report/figures_mixture.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>

#include "report/format.hpp"
#include "report/panels.hpp"

namespace recoil {
namespace {

/// One look per convention, and per size, told apart by colour and dashes.
constexpr std::array<plot::Stroke, 3> class_strokes = {{{plot::blue, 2.0},
                                                        {plot::green, 2.0, plot::Dash::long_dashes},
                                                        {plot::vermillion, 2.0, plot::Dash::dots}}};
constexpr std::array<const char*, 3> average_names = {"captured as e = 0", "captured left out",
                                                      "unseen left out"};

plot::Band band_of(const std::vector<double>& velocity, const std::vector<BandedValue>& values,
                   std::string_view colour) {
  plot::Band band{velocity, {}, {}, {std::string(colour), 0.2}};
  for (const BandedValue& value : values) {
    band.lower.push_back(value.lower.value_or(NAN));
    band.upper.push_back(value.upper.value_or(NAN));
  }
  return band;
}

plot::Line line_of(const std::vector<double>& velocity, const std::vector<BandedValue>& values,
                   const plot::Stroke& stroke, const std::string& name) {
  plot::Line line{velocity, {}, stroke};
  line.name = name;
  for (const BandedValue& value : values) line.y.push_back(value.value.value_or(NAN));
  return line;
}

plot::Plot plot_of(const Analysis& analysis, const PolydispersePrediction& mixture,
                   const std::string& title, int key_rows) {
  plot::Plot shown;
  shown.heading = title;
  if (analysis.datasets.size() > 1) shown.remark = analysis.datasets[mixture.dataset].id;
  shown.x = velocity_axis({mixture.velocity.front(), mixture.velocity.back()});
  shown.y = restitution_axis(1.05);
  shown.key = {plot::KeyPlace::below, key_rows};
  return shown;
}

plot::Picture picture_of(const Analysis& analysis, const PolydispersePrediction& mixture,
                         const char* name, plot::Plot shown) {
  plot::Picture picture;
  picture.name = fmt::format("mixture-{}-{}", name, mixture.dataset + 1);
  picture.title = fmt::format("{}, {}", shown.heading, analysis.datasets[mixture.dataset].id);
  picture.height = 390;
  picture.plots = {std::move(shown)};
  return picture;
}

/// The points of the dataset.
void add_points(const Analysis& analysis, std::size_t dataset, plot::Plot& shown) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < analysis.fitted.data.points.size(); ++i) {
    if (analysis.fitted.data.points[i].dataset == dataset) indices.push_back(i);
  }
  const auto points = rebound_layer(analysis, point_columns(analysis, indices),
                                    to_string(analysis.datasets[dataset].provenance));
  if (points) shown.layers.push_back(*points);
}

Figure sizes_figure(const Analysis& analysis, const PolydispersePrediction& mixture) {
  plot::Plot shown =
      plot_of(analysis, mixture, "The smallest sphere, the mean one, the largest", 2);
  std::vector<std::string> captures;
  for (std::size_t i = 0; i < mixture.size_curves.size(); ++i) {
    const SizeCurve& size = mixture.size_curves[i];
    plot::Line line{mixture.velocity, size.restitution, class_strokes[i]};
    line.name = diameter_text(size.diameter) + " µm";
    shown.layers.push_back(std::move(line));
    captures.push_back(size.capture_velocity > 0.0
                           ? fmt::format("{} m/s ({} µm)", number(size.capture_velocity, 3),
                                         diameter_text(size.diameter))
                           : fmt::format("none found ({} µm)", diameter_text(size.diameter)));
  }
  add_points(analysis, mixture.dataset, shown);
  const Sentence caption = say(
      "{}. One curve for each of three sizes with the same {C_H} and {C_A}, {f0} by eq. 12, as in "
      "Fig. 10 of Li, Dunn & Brach (1999). Capture velocities: {}.",
      analysis.datasets[mixture.dataset].id, fmt::format("{}", fmt::join(captures, ", ")));
  return figure_of(picture_of(analysis, mixture, "sizes", std::move(shown)), caption);
}

Figure averages_figure(const Analysis& analysis, const PolydispersePrediction& mixture) {
  plot::Plot shown = plot_of(analysis, mixture, "Weighted averages over the sizes", 3);
  for (std::size_t k = 0; k < all_conventions.size(); ++k) {
    shown.layers.push_back(band_of(mixture.velocity, mixture.average[k], class_strokes[k].colour));
  }
  for (std::size_t k = 0; k < all_conventions.size(); ++k) {
    shown.layers.push_back(
        line_of(mixture.velocity, mixture.average[k], class_strokes[k], average_names[k]));
  }
  const SizeCurve& mean = mixture.size_curves[1];
  plot::Line single{mixture.velocity, mean.restitution, {plot::grey, 1.4}};
  single.name = fmt::format("d10 = {} µm alone", diameter_text(mean.diameter));
  shown.layers.push_back(std::move(single));
  add_points(analysis, mixture.dataset, shown);
  const std::string caption = fmt::format(
      "{}. The average over {} sizes under three conventions, with pointwise {} bands{}, beside "
      "the simulation of d10 alone (Figs. 11 and 12 of Li, Dunn & Brach 1999). Too slow to be "
      "seen: rebounds below {} m/s, which do not climb {} mm.",
      analysis.datasets[mixture.dataset].id, mixture.simulated, percent(mixture.level),
      mixture.replicates == 0 ? " (none: no bootstrap)" : "", number(mixture.slowest_seen, 3),
      number(1e3 * mixture.probe_height, 3));
  return figure_of(picture_of(analysis, mixture, "average", std::move(shown)), caption);
}

Figure captured_figure(const Analysis& analysis, const PolydispersePrediction& mixture) {
  plot::Plot shown = plot_of(analysis, mixture, "How many spheres stay, or are not seen again", 1);
  shown.y.label = "part of the spheres";
  const plot::Stroke unseen{plot::vermillion, 2.0, plot::Dash::dots};
  shown.layers = {band_of(mixture.velocity, mixture.captured, plot::blue),
                  band_of(mixture.velocity, mixture.unseen, plot::vermillion),
                  line_of(mixture.velocity, mixture.captured, {plot::blue, 2.0}, "captured"),
                  line_of(mixture.velocity, mixture.unseen, unseen, "captured or too slow")};
  const std::string caption = fmt::format(
      "{}. Part of the spheres by number, with pointwise {} bands. Steps are those of the {} "
      "sizes.",
      analysis.datasets[mixture.dataset].id, percent(mixture.level), mixture.simulated);
  return figure_of(picture_of(analysis, mixture, "captured", std::move(shown)), caption);
}

}  // namespace

std::vector<Figure> mixture_figures(const Analysis& analysis,
                                    const PolydispersePrediction& mixture) {
  return {averages_figure(analysis, mixture), sizes_figure(analysis, mixture),
          captured_figure(analysis, mixture)};
}

std::vector<Figure> mixture_figures(const Analysis& analysis) {
  std::vector<Figure> all;
  for (const PolydispersePrediction& mixture : analysis.mixtures) {
    for (Figure& figure : mixture_figures(analysis, mixture)) all.push_back(std::move(figure));
  }
  return all;
}

}  // namespace recoil
