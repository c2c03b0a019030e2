#include "report/figures_two_point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/density.hpp"
#include "report/format.hpp"
#include "report/parameter_axis.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_replicates = 600;  // drawn per cloud
constexpr double share_inside = 0.95;         // of the replicates within the line

/// (C_H, C_A) of every replicate, scaled for the axes.
struct Pairs {
  std::vector<double> C_H, C_A;
};

Pairs pairs_of(const std::vector<std::vector<double>>& theta, std::size_t slot_H,
               std::size_t slot_A, double scale_H, double scale_A) {
  Pairs pairs;
  for (const std::vector<double>& replicate : theta) {
    if (slot_H >= replicate.size() || slot_A >= replicate.size()) continue;
    pairs.C_H.push_back(replicate[slot_H] * scale_H);
    pairs.C_A.push_back(replicate[slot_A] * scale_A);
  }
  return pairs;
}

plot::Points cloud_of(const Pairs& pairs, plot::Range x, plot::Range y, std::string_view colour,
                      std::size_t& outside) {
  plot::Points cloud;
  cloud.marker.colour = colour;
  cloud.size = 0.25;
  const std::size_t stride = pairs.C_H.size() / most_replicates + 1;
  for (std::size_t i = 0; i < pairs.C_H.size(); ++i) {
    const bool inside = x.holds(pairs.C_H[i]) && y.holds(pairs.C_A[i]);
    if (!inside) ++outside;
    if (!inside || i % stride != 0) continue;
    cloud.x.push_back(pairs.C_H[i]);
    cloud.y.push_back(pairs.C_A[i]);
  }
  return cloud;
}

/// An axis that holds the bulk of both clouds and both estimates, zero at the least.
plot::Range common_range(const std::vector<double>& one, const std::vector<double>& other, double a,
                         double b) {
  std::vector<double> shown = {a, b};
  for (const std::vector<double>* values : {&one, &other}) {
    if (values->empty()) continue;
    const plot::Range bulk = plot::quantile_range(*values, 0.01, 0.99);
    shown.push_back(bulk.lower);
    shown.push_back(bulk.upper);
  }
  plot::Range range = plot::range_of(shown, 0.06);
  range.lower = std::max(0.0, range.lower);
  return range;
}

std::string status_words(const TwoPointComparison& comparison) {
  return comparison.result.status == TwoPointStatus::converged
             ? std::string()
             : fmt::format(" The two-point calibration itself ended without an answer: {}.",
                           words_of(to_string(comparison.result.status)));
}

Figure scatter(const Analysis& analysis, const TwoPointComparison& comparison) {
  const ImpactModel& model = analysis.fitted.model;
  const std::size_t H = model.slot_C_H[comparison.dataset];
  const std::size_t A = model.slot_C_A[comparison.dataset];
  const std::vector<double>& full = analysis.fitted.theta;
  const std::vector<double>& two = comparison.result.theta;
  const ParameterAxis scale_H = parameter_axis(model.slots[H], full[H]);
  const ParameterAxis scale_A = parameter_axis(model.slots[A], full[A]);
  const BootstrapResult& bootstrap = analysis.uncertainty.bootstrap;
  const Pairs all_points = pairs_of(bootstrap.theta, H, A, scale_H.factor, scale_A.factor);
  const Pairs two_points = comparison.dataset < bootstrap.two_point_theta.size()
                               ? pairs_of(bootstrap.two_point_theta[comparison.dataset], H, A,
                                          scale_H.factor, scale_A.factor)
                               : Pairs();
  const bool converged =
      comparison.result.status == TwoPointStatus::converged && H < two.size() && A < two.size();
  const double full_H = full[H] * scale_H.factor;
  const double full_A = full[A] * scale_A.factor;
  const double two_H = converged ? two[H] * scale_H.factor : full_H;
  const double two_A = converged ? two[A] * scale_A.factor : full_A;
  const plot::Range x = common_range(all_points.C_H, two_points.C_H, full_H, two_H);
  const plot::Range y = common_range(all_points.C_A, two_points.C_A, full_A, two_A);
  std::size_t outside = 0;

  plot::Plot shown;
  shown.x = {"C_H", scale_H.axis.unit};
  shown.x.set_range(x);
  shown.y = {"C_A", scale_A.axis.unit};
  shown.y.set_range(y);
  shown.key.place = plot::KeyPlace::above;
  shown.layers = {cloud_of(two_points, x, y, plot::orange, outside),
                  cloud_of(all_points, x, y, plot::sky, outside)};
  const auto outline = [&](const Pairs& pairs, std::string_view colour) {
    const auto contour = contour_around(pairs.C_H, pairs.C_A, x, y, share_inside, {colour, 1.8});
    if (contour) shown.layers.push_back(*contour);
  };
  outline(two_points, plot::vermillion);
  outline(all_points, plot::blue);
  plot::Points all{{full_H}, {full_A}};
  all.marker = {plot::blue, plot::Mark::dot};
  all.size = 1.1;
  all.name = "all points";
  shown.layers.push_back(std::move(all));
  plot::Points two_marks;
  if (converged) {
    two_marks.x = {two_H};
    two_marks.y = {two_A};
  }
  two_marks.marker = {plot::vermillion, plot::Mark::triangle};
  two_marks.size = 1.3;
  two_marks.name = "two points";
  shown.layers.push_back(std::move(two_marks));

  const std::size_t count = all_points.C_H.size() + two_points.C_H.size();
  std::string caption = analysis.datasets[comparison.dataset].id +
                        ". Small dots: each calibration repeated on resampled data; 95 % of them "
                        "lie within the line. "
                        "Large marks: the estimates.";
  if (count > 2 * most_replicates) {
    caption += fmt::format(" About {} replicates of each are drawn.", most_replicates);
  }
  if (outside > 0) caption += fmt::format(" {} lie outside the picture.", outside);
  if (comparison.failed > 0) {
    caption += fmt::format(" In {} replicates the two-point iteration found no answer.",
                           comparison.failed);
  }
  caption += status_words(comparison);
  plot::Picture picture;
  picture.name = fmt::format("two-point-{}", comparison.dataset + 1);
  picture.title = fmt::format("Two points against all under resampling, {}",
                              analysis.datasets[comparison.dataset].id);
  picture.height = 360;
  picture.plots = {std::move(shown)};
  return figure_of(std::move(picture), caption);
}

}  // namespace

std::vector<Figure> two_point_figures(const Analysis& analysis) {
  std::vector<Figure> figures;
  for (const TwoPointComparison& comparison : analysis.uncertainty.two_point) {
    figures.push_back(scatter(analysis, comparison));
  }
  return figures;
}

}  // namespace recoil
