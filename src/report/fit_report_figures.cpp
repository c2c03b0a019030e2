#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <span>

#include "core/json.hpp"
#include "core/program.hpp"
#include "core/units.hpp"
#include "data/text.hpp"
#include "estimate/model_verdict.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"
#include "report/fit_report.hpp"
#include "report/format.hpp"
#include "report/panels.hpp"
#include "report/prediction_report.hpp"
#include "report/words_fit.hpp"
#include "uncertainty/intervals.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_residuals = 500;
constexpr std::string_view dark_green = "#00684c";

plot::Points captured_layer(plot::Points points) {
  points.marker.mark = plot::Mark::open_triangle_down;
  points.size = 0.9;
  points.name = "captured";
  return points;
}

/// Adds the capture velocity as a line and its interval as a shaded region.
void add_capture(const CaptureEstimate& capture, const Axes& axes, plot::Plot& shown) {
  const Interval& interval = capture.interval;
  const auto inside = [&](double v) {
    return std::clamp(v, axes.velocity.lower, axes.velocity.upper);
  };
  if (interval.available()) {
    shown.layers.push_back(plot::Region{inside(*interval.lower), inside(*interval.upper)});
  }
  if (capture.value > axes.velocity.lower && capture.value < axes.velocity.upper) {
    shown.layers.push_back(plot::Rule{.at = capture.value, .stroke = {plot::green, 1.4}});
  }
}

std::string capture_words(const CaptureEstimate& capture, const Axes& axes) {
  std::string words = fmt::format("capture below V* = {} m/s", digits(capture.value, 3));
  if (capture.interval.available()) {
    words += " " + NumberRange{*capture.interval.lower, *capture.interval.upper, padded(3)}.text();
  }
  if (capture.value <= axes.velocity.lower) words = "← " + words;
  return words;
}

std::string points_name(const Dataset& dataset, bool sd_stated) {
  const std::string name = to_string(dataset.provenance);
  return sd_stated ? name + " ± 1 sd" : name;
}

void add_curve(const Analysis& analysis, const RestitutionCurve& curve, plot::Plot& shown) {
  const CurveColumns columns = curve_columns(curve);
  if (!columns.lower.empty()) {
    plot::Band band{columns.velocity, columns.lower, columns.upper};
    band.name = percent(analysis.uncertainty.options.level) + " band";
    shown.layers.push_back(std::move(band));
  }
  plot::Line fit{columns.velocity, columns.restitution, {plot::blue, 2.0}};
  fit.name = "fit to all points";
  shown.layers.push_back(std::move(fit));
  if (!columns.two_point.empty()) {
    plot::Line two{columns.velocity, columns.two_point, {plot::vermillion, 2.0, plot::long_dashes}};
    two.name = "two points";
    shown.layers.push_back(std::move(two));
  }
}

plot::Picture restitution_picture(const Analysis& analysis, const Panel& panel, const Axes& axes) {
  const Dataset& dataset = analysis.datasets[panel.dataset];
  plot::Plot shown;
  shown.heading = "d = " + diameter_label(panel.diameter);
  if (analysis.datasets.size() > 1) shown.heading += ", " + dataset.id;
  shown.x = velocity_axis(axes.velocity);
  shown.y = restitution_axis(axes.restitution);
  shown.key = plot::KeyPlace::below;
  if (panel.capture != nullptr) {
    shown.remark = capture_words(*panel.capture, axes);
    shown.remark_colour = dark_green;
    add_capture(*panel.capture, axes, shown);
  }
  if (panel.curve != nullptr) add_curve(analysis, *panel.curve, shown);

  const PointColumns columns = point_columns(analysis, panel.points);
  const auto points =
      rebound_layer(analysis, columns, points_name(dataset, analysis.fitted.data.noise.sd_stated));
  if (points) shown.layers.push_back(*points);
  if (!columns.captured.empty()) {
    shown.layers.push_back(
        captured_layer({columns.captured, std::vector<double>(columns.captured.size(), 0.0)}));
  }
  const std::string title = "Restitution against incident velocity, " + shown.heading;
  return {.name = {}, .title = title, .height = 375, .plots = {std::move(shown)}};
}

/// The stride of the drawn points: one point in this many is drawn.
std::size_t drawn_every(const Panel& panel) { return panel.points.size() / most_panel_points + 1; }

Sentence restitution_caption(const Analysis& analysis, const Panel& panel) {
  Sentence text =
      say("{} on {}: {}.", diameter_sentence(panel.diameter),
          short_name(analysis.datasets, panel.dataset), counted(panel.points.size(), "point"));
  if (drawn_every(panel) > 1) text += fmt::format(" One point in {} is drawn.", drawn_every(panel));
  if (averages_over_sizes(analysis.fitted.model, panel.dataset)) {
    text += fmt::format(" {}", mean_curve_words);
    const double slowest = analysis.fitted.model.surroundings[panel.dataset].sizes.slowest_seen;
    if (slowest > 0.0) {
      text += say(" Rebounds below {} m/s are not seen, so {e} is at least {} m/s over {V}.",
                  number(slowest, 2), number(slowest, 2));
    }
  }
  return text;
}

// ---- data for the script of the page -----------------------------------------------------------

/// The values of a point that the script reads, by name.
using ExploredValue = double (*)(const Observation& point, const PointWeights& weights);
const std::vector<std::pair<const char*, ExploredValue>>& explored_values() {
  using Point = const Observation&;
  using Own = const PointWeights&;
  static const std::vector<std::pair<const char*, ExploredValue>> values = {
      {"velocity", [](Point p, Own) { return p.velocity; }},
      {"diameter", [](Point p, Own) { return p.diameter; }},
      {"restitution", [](Point p, Own) { return p.restitution; }},
      {"sd", [](Point, Own w) { return w.sd; }},
      {"censored", [](Point p, Own) { return p.censored ? 1.0 : 0.0; }},
      {"input_sd", [](Point, Own w) { return w.input_sd; }},
      {"scatter", [](Point, Own w) { return w.scatter; }},
      {"shift", [](Point, Own w) { return w.shift; }},
      {"mean_sd", [](Point, Own w) { return w.mean_sd; }},
      {"least", [](Point, Own w) { return w.scatter > 0.0 ? w.peak.deviance : 0.0; }},
      {"events", [](Point p, Own) { return double(p.events); }},
      {"captured", [](Point p, Own) { return double(p.captured); }},
      {"counted", [](Point p, Own) { return p.counted ? 1.0 : 0.0; }}};
  return values;
}

/// `value` rounded to nine significant digits, so that its shortest decimal text is short.
double rounded(double value) {
  if (value == 0.0 || !std::isfinite(value)) return value;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 8.0);
  return unit < 1.0 ? std::round(value / unit) / std::round(1.0 / unit)
                    : std::round(value / unit) * unit;
}

/// Adds the drawn points of a panel: their chi2, the names of the columns and one row for each
/// point. Columns that contain only zeros are omitted.
void add_explored_points(const Analysis& analysis, const Panel& panel, Json& out) {
  const FitResult& fit = analysis.fitted;
  std::vector<std::size_t> drawn;
  double chi2 = 0.0;
  for (std::size_t k = 0; k < panel.points.size(); k += drawn_every(panel)) {
    drawn.push_back(panel.points[k]);
    chi2 += std::pow(fit.residuals[panel.points[k]], 2);
  }
  out["chi2"] = number_or_null(chi2);
  out["columns"] = Json::array();
  out["points"] = Json(std::vector<Json>(drawn.size(), Json::array()));
  for (const auto& column : explored_values()) {
    const auto value = [&](std::size_t i) {
      return column.second(fit.data.points[i], fit.weights.points[i]);
    };
    if (std::ranges::all_of(drawn, [&](std::size_t i) { return value(i) == 0.0; })) continue;
    out["columns"].push_back(column.first);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      out["points"][i].push_back(number_or_null(rounded(value(drawn[i]))));
    }
  }
}

/// The JSON for `explore_script`: law, materials and fitted values in SI units, the ranges of the
/// axes, and the drawn points with their weights. Empty if the script cannot compute the model:
/// with mechanisms, for points that average over sizes or have no e, or for a spherical surface.
std::string explored_panel(const Analysis& analysis, const Panel& panel, const plot::Plot& shown) {
  const FitResult& fit = analysis.fitted;
  const ImpactModel& model = fit.model;
  const ContactProperties& contact = model.contacts[panel.dataset];
  const auto& points = fit.data.points;
  if (!model.chain.empty() || averages_over_sizes(model) || contact.surface_diameter > 0.0 ||
      std::ranges::any_of(points, [](const Observation& point) { return point.counts_only(); })) {
    return "";
  }
  const ImpactConditions at = conditions_at(model, fit.theta, panel.dataset, panel.diameter, 1.0);
  const ParameterSlot& adhesion = model.slots[model.slot_adhesion[panel.dataset]];
  Json out = {{"law", to_string(model.adhesion)},
              {"phase", to_string(model.phase)},
              {"C_H", at.hertz_damping},
              {"C_A", at.adhesion_damping},
              {"adhesion", adhesion_value_under(model, fit.theta, panel.dataset)},
              {"adhesion_name", adhesion.parameter->name},
              {"adhesion_unit", adhesion.parameter->unit},
              {"diameter", panel.diameter},
              {"reference_diameter", contact.reference_diameter},
              {"density", at.density},
              {"stiffness", at.stiffness},
              {"separation", at.separation},
              {"velocities", {shown.x.from, shown.x.to}},
              {"restitutions", {shown.y.from, shown.y.to}},
              {"student", nullptr}};
  if (const auto& student = fit.data.noise.student) {
    out["student"] = {{"nu", student->dof}, {"unit", std::sqrt(student->calibration())}};
  }
  add_explored_points(analysis, panel, out);
  return json_line(out);
}

// ---- residuals ---------------------------------------------------------------------------------

/// The unit of the displayed residuals: 1, or the estimated noise scale if no standard deviations
/// are stated.
double residual_unit(const Analysis& analysis) {
  const double scale = analysis.fitted.noise_scale;
  return !analysis.fitted.data.noise.sd_stated && std::isfinite(scale) && scale > 0.0 ? scale : 1.0;
}

struct ResidualRow {
  double velocity;
  double diameter;
  double residual;  ///< [sd]
  bool censored;
};

std::vector<ResidualRow> residual_rows(const Analysis& analysis, std::size_t dataset) {
  std::vector<ResidualRow> rows;
  const double unit = residual_unit(analysis);
  const auto& points = analysis.fitted.data.points;
  for (std::size_t i = 0; i < points.size() && i < analysis.fitted.residuals.size(); ++i) {
    if (points[i].dataset != dataset) continue;
    rows.push_back({points[i].velocity, points[i].diameter, analysis.fitted.residuals[i] / unit,
                    points[i].censored});
  }
  return rows;
}

/// Residuals of one dataset against velocity. Few diameters have different marks.
plot::Plot residual_plot(const std::vector<ResidualRow>& rows) {
  std::map<double, plot::Points> by_diameter;
  plot::Points captured;
  std::vector<double> velocities;
  double largest = 3.2;
  const std::size_t stride = rows.size() / most_residuals + 1;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (std::isfinite(rows[i].residual)) {
      largest = std::max(largest, 1.1 * std::abs(rows[i].residual));
    }
    if (i % stride != 0) continue;
    velocities.push_back(rows[i].velocity);
    plot::Points& points = rows[i].censored ? captured : by_diameter[rows[i].diameter];
    points.x.push_back(rows[i].velocity);
    points.y.push_back(rows[i].residual);
  }
  plot::Plot shown;
  shown.x = velocity_axis(plot::log_range_of(velocities, 0.05));
  shown.y = {"residual", "sd"};
  shown.y.set_range({-largest, largest});
  shown.key = plot::KeyPlace::above;
  for (const double at : {-2.0, 2.0}) {
    shown.layers.push_back(
        plot::Rule{.vertical = false, .at = at, .stroke = {plot::grey, 1.0, plot::dashes}});
  }
  shown.layers.push_back(plot::Rule{.vertical = false, .at = 0.0, .stroke = {plot::ink, 1.2}});
  const bool distinct = by_diameter.size() <= plot::markers.size();
  std::size_t index = 0;
  for (auto& [diameter, points] : by_diameter) {
    points.marker = plot::marker(distinct ? index++ : 0);
    points.size = 0.65;
    if (distinct) points.name = diameter_label(diameter);
    shown.layers.push_back(std::move(points));
  }
  if (!captured.x.empty()) shown.layers.push_back(captured_layer(std::move(captured)));
  return shown;
}

Sentence residual_caption(const Analysis& analysis, const std::vector<ResidualRow>& rows,
                          std::size_t dataset) {
  const auto outside = std::ranges::count_if(
      rows, [](const ResidualRow& row) { return std::abs(row.residual) > 2.0; });
  return say(
      "{}: data minus fit in {}. {} of {} are outside the dashed lines, {:.0f} expected.",
      short_name(analysis.datasets, dataset),
      analysis.fitted.data.noise.sd_stated ? "standard deviations" : "units of the estimated noise",
      outside, rows.size(), 0.0455 * static_cast<double>(rows.size()));
}

// ---- error of the laws -------------------------------------------------------------------------

/// Adds g along the velocities of the points of a panel, with its band [%].
void add_law_error(const Analysis& analysis, const Panel& panel, std::string_view colour,
                   plot::Plot& shown) {
  constexpr int steps = 60;
  const FitResult& f = analysis.fitted;
  const std::size_t first = f.model.first_law_slot(), slots = f.model.slots.size();
  const auto [slow, fast] = std::ranges::minmax(
      panel.points, {}, [&](std::size_t i) { return f.data.points[i].velocity; });
  PointConditions at = f.data.points[slow].conditions();
  at.diameter = panel.diameter;
  const double ratio = f.data.points[fast].velocity / at.velocity;
  plot::Line line{.x = {}, .y = {}, .stroke = {colour, 1.8}};
  plot::Band band{.x = {}, .lower = {}, .upper = {}, .fill = {std::string(colour), 0.14}};
  std::vector<double> gradient(slots, 0.0);
  const double slowest = at.velocity;
  for (int k = 0; k <= steps; ++k) {
    at.velocity = slowest * std::pow(ratio, double(k) / steps);
    f.model.law_error->functions(at, std::span(gradient).subspan(first));
    double g = 0.0, variance = 0.0;
    for (std::size_t i = first; i < slots; ++i) {
      g += gradient[i] * f.theta[i];
      for (std::size_t j = first; j < slots; ++j) {
        variance += gradient[i] * f.covariance[i * slots + j] * gradient[j];
      }
    }
    const double half = student_quantile(0.5 + 0.5 * analysis.uncertainty.options.level,
                                         degrees_of_freedom(f, gradient)) *
                        std::sqrt(variance);
    line.x.push_back(at.velocity);
    line.y.push_back(100.0 * g);
    band.lower.push_back(100.0 * (g - half));
    band.upper.push_back(100.0 * (g + half));
  }
  band.x = line.x;
  shown.layers.push_back(std::move(band));
  shown.layers.push_back(std::move(line));
}

/// The loss of the points of a panel relative to that of exact laws at the fitted constants, with
/// one standard deviation [%].
plot::Points lost_points(const Analysis& analysis, const Panel& panel) {
  const FitResult& f = analysis.fitted;
  const ImpactModel exact = with_exact_laws(f.model);
  const std::span constants = std::span(f.theta).first(exact.slots.size());
  plot::Points points;
  std::vector<double> sd;
  for (const std::size_t i : panel.points) {
    const Observation& point = f.data.points[i];
    const PointWeights& own = f.weights.points[i];
    if (point.censored || point.counts_only()) continue;
    const double squared =
        predict(exact, constants, {point.conditions()}, false).front().restitution_squared;
    const double expected = expected_restitution(point, own, squared);
    const double per_loss = 100.0 / (1.0 - squared);
    points.x.push_back(point.velocity);
    points.y.push_back(per_loss * (expected * expected - point.restitution * point.restitution));
    sd.push_back(per_loss * std::hypot(2.0 * point.restitution * own.sd, own.input_sd));
  }
  return points.with_sd(sd);
}

plot::Plot law_error_plot(const Analysis& analysis, const std::vector<Panel>& panels) {
  plot::Plot shown;
  std::vector<double> velocities, errors = {0.0};
  std::vector<plot::Layer> points;
  for (std::size_t k = 0; k < panels.size(); ++k) {
    add_law_error(analysis, panels[k], plot::marker(k).colour, shown);
    plot::Points own = lost_points(analysis, panels[k]);
    own.marker = plot::marker(k);
    own.size = 0.65;
    own.name = diameter_label(panels[k].diameter);
    velocities.insert(velocities.end(), own.x.begin(), own.x.end());
    errors.insert(errors.end(), own.y.begin(), own.y.end());
    points.emplace_back(std::move(own));
  }
  for (const plot::Layer& layer : shown.layers) {
    const auto* const band = std::get_if<plot::Band>(&layer);
    if (band == nullptr) continue;
    errors.insert(errors.end(), band->lower.begin(), band->lower.end());
    errors.insert(errors.end(), band->upper.begin(), band->upper.end());
  }
  shown.layers.push_back(
      plot::Rule{.vertical = false, .at = 0.0, .stroke = {plot::ink, 1.2, plot::dashes}});
  std::ranges::move(points, std::back_inserter(shown.layers));
  shown.x = velocity_axis(plot::log_range_of(velocities, 0.05));
  shown.y = {"loss beyond that of the laws", "%"};
  shown.y.set_range(plot::range_of(errors, 0.06));
  shown.key = plot::KeyPlace::above;
  return shown;
}

// ---- capture models ----------------------------------------------------------------------------

/// One stroke for each model. Colours and dashes differ.
constexpr std::array<plot::Stroke, 5> strokes = {{{plot::blue, 2.0},
                                                  {plot::ink, 2.0, plot::long_dashes},
                                                  {plot::vermillion, 2.0, plot::dots},
                                                  {plot::green, 2.0, plot::dash_dot},
                                                  {plot::purple, 2.0, plot::dashes}}};

/// The range of all shown velocities [m/s], with a margin.
plot::Range capture_range(const CaptureComparison& comparison) {
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

plot::Plot capture_plot(const CaptureComparison& comparison, const Dataset& dataset) {
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
  shown.y.set_range(capture_range(comparison));
  shown.key = plot::KeyPlace::below;
  for (std::size_t i = 0; i < comparison.curves.size(); ++i) {
    const CaptureCurve& curve = comparison.curves[i];
    const plot::Stroke& stroke = strokes[i % strokes.size()];
    if (!curve.lower.empty()) {
      shown.layers.push_back(
          plot::Band{diameters, curve.lower, curve.upper, {std::string(stroke.colour), 0.2}});
    }
    plot::Line line{diameters, curve.velocity, stroke};
    line.name = to_string(curve.model);
    shown.layers.push_back(std::move(line));
  }
  add_published(comparison, true, shown);
  add_published(comparison, false, shown);
  return shown;
}

/// The inputs of the curves, the published values (if any), and which curves are missing.
Sentence capture_caption(const CaptureComparison& comparison, const Dataset& dataset) {
  std::vector<Sentence> words = {
      say("Older models, from {W_A} = {:.3g} {J/m2} and {K} = {:.4g} GPa; those of Dahneke and "
          "Wall also use {e} = {:.3g} of the fit",
          comparison.adhesion_energy, comparison.stiffness / units::GPa, comparison.restitution)};
  if (comparison.yield) {
    words.push_back(say("yield pressure {:.3g} MPa ({})", comparison.yield->pressure / 1e6,
                        comparison.yield->source));
  } else {
    words.push_back(say("no published yield pressure of {}", dataset.system.particle.name));
  }
  if (comparison.unanswered > 0) {
    words.push_back(say("no capture velocity at {} of {} diameters", comparison.unanswered,
                        comparison.unanswered + comparison.diameter.size()));
  }
  for (const PublishedCapture& one : comparison.published) {
    words.push_back(say("published, {} at {}: {} m/s, {}", one.what,
                        diameter_sentence(one.diameter), number(one.velocity, 3), one.source));
  }
  return join(words, "; ") + ".";
}

constexpr std::size_t many_points = 150;

/// The dashes of curves of several sizes beside those of other datasets.
constexpr std::array<std::string_view, 5> size_dashes = {"", plot::long_dashes, plot::dash_dot,
                                                         plot::dashes, plot::dots};

/// The sizes of all panels, smallest first; none if there are more than dashes.
std::vector<double> sizes_told_apart(const std::vector<Panel>& panels) {
  std::vector<double> sizes;
  for (const Panel& panel : panels) sizes.push_back(panel.diameter);
  std::ranges::sort(sizes);
  sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
  if (sizes.size() > size_dashes.size()) sizes.clear();
  return sizes;
}

}  // namespace

plot::Picture restitution_overview(const Analysis& analysis, int width, int height) {
  const std::vector<Panel> panels = panels_of(analysis);
  plot::Range velocity{INFINITY, 0.0}, restitution{INFINITY, 0.0};
  for (std::size_t k = 0; k < analysis.datasets.size(); ++k) {
    const Axes axes = axes_of(analysis, panels, k);
    if (!std::isfinite(axes.velocity.lower)) continue;
    velocity.lower = std::min(velocity.lower, axes.velocity.lower);
    velocity.upper = std::max(velocity.upper, axes.velocity.upper);
    restitution.lower = std::min(restitution.lower, axes.restitution.lower);
    restitution.upper = std::max(restitution.upper, axes.restitution.upper);
  }
  plot::Plot shown;
  shown.x = velocity_axis(velocity);
  shown.y = restitution_axis(restitution);
  shown.key = plot::KeyPlace::above;
  const bool by_dataset = analysis.datasets.size() > 1;
  const std::vector<double> sizes = sizes_told_apart(panels);
  std::vector<plot::Layer> bands, curves, marks;
  plot::Points captured;
  std::vector<bool> named(analysis.datasets.size(), false);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Panel& panel = panels[i];
    const plot::Marker& marker = plot::marker(by_dataset ? panel.dataset : i);
    const std::string name =
        by_dataset ? short_name(analysis.datasets, panel.dataset) : diameter_label(panel.diameter);
    const bool show = by_dataset ? !named[panel.dataset] : panels.size() <= plot::markers.size();
    named[panel.dataset] = true;
    if (panel.curve != nullptr) {
      CurveColumns curve = curve_columns(*panel.curve);
      if (!curve.lower.empty()) {
        bands.emplace_back(plot::Band{curve.velocity,
                                      curve.lower,
                                      curve.upper,
                                      {std::string(marker.colour), by_dataset ? 0.15 : 0.25}});
      }
      for (std::size_t k = 0; k + 1 < curve.restitution.size(); ++k) {
        if (curve.restitution[k + 1] == 0.0) curve.restitution[k] = NAN;  // the axis shows this
      }
      const auto size = std::ranges::find(sizes, panel.diameter);
      const std::string_view dash =
          by_dataset && size != sizes.end()
              ? size_dashes[static_cast<std::size_t>(size - sizes.begin())]
              : "";
      curves.emplace_back(
          plot::Line{curve.velocity, curve.restitution, {marker.colour, 1.6, dash}});
    }
    const PointColumns columns = point_columns(analysis, panel.points);
    plot::Points points{columns.velocity, columns.restitution};
    if (analysis.fitted.data.noise.sd_stated) points.with_sd(columns.sd);
    points.marker = marker;
    points.size = analysis.fitted.data.points.size() > many_points ? 0.5 : 0.65;
    if (show) points.name = name;
    marks.emplace_back(std::move(points));
    captured.x.insert(captured.x.end(), columns.captured.begin(), columns.captured.end());
  }
  captured.y.assign(captured.x.size(), 0.0);
  for (std::vector<plot::Layer>* layers : {&bands, &curves, &marks}) {
    std::ranges::move(*layers, std::back_inserter(shown.layers));
  }
  if (!captured.x.empty()) shown.layers.push_back(captured_layer(std::move(captured)));
  for (std::size_t k = 0; by_dataset && k < sizes.size(); ++k) {  // only for the key
    plot::Line line{{}, {}, {plot::ink, 1.6, size_dashes[k]}};
    line.name = diameter_label(sizes[k]);
    shown.layers.push_back(std::move(line));
  }
  return {.name = "overview",
          .title = "Restitution against incident velocity, " + analysis.spec.id,
          .width = width,
          .height = height,
          .plots = {std::move(shown)}};
}

Sentence overview_caption(const Analysis& analysis) {
  const bool bands =
      std::ranges::any_of(analysis.uncertainty.curves,
                          [](const RestitutionCurve& curve) { return !curve.lower.empty(); });
  Sentence text = analysis.fitted.data.noise.sd_stated ? say("Points {+/-} 1 sd, and the fit")
                                                       : Sentence("Points, and the fit");
  text += bands ? say(" with its {} bands.", percent(analysis.uncertainty.options.level))
                : Sentence(".");
  if (averages_over_sizes(analysis.fitted.model)) text += say(" {}", mean_curve_words);
  return text;
}

Sentence figure_caption(const Analysis& analysis) {
  const FitResult& f = analysis.fitted;
  constexpr std::size_t most_captures = 4;
  std::vector<Sentence> pairs, results;
  for (const Dataset& dataset : analysis.datasets) {
    pairs.push_back(say("{} on {} ({})", dataset.system.particle.name, dataset.system.surface.name,
                        to_string(dataset.provenance)));
  }
  for (std::size_t s = 0; s < f.model.slots.size(); ++s) {
    const ParameterSlot& slot = f.model.slots[s];
    if (!slot.free || slot.is_constant()) continue;
    const double error = s < f.std_error.size() ? f.std_error[s] : 0.0;
    const std::string_view unit_name = slot.parameter->unit;
    results.push_back(say(
        "{} = {}", parameter_words(f.model, s, analysis.datasets),
        Number{acting_value(f.model, f.theta, s), significant(4),
               std::isfinite(error) ? error : 0.0, unit_name == "1" ? "" : std::string(unit_name)}
            .words()));
  }
  std::size_t captures = 0;
  for (const CaptureEstimate& capture : analysis.uncertainty.capture) {
    if (!capture.found || without_adhesion(analysis, capture.dataset)) continue;
    if (++captures > most_captures) break;
    Number value = with_interval(capture.value, capture.interval, padded(3));
    value.unit = "m/s";
    results.push_back(say("{} = {}", capture_name(analysis, capture), value.words()));
  }
  Sentence text = say("Restitution {e} against incident velocity {V}: {}. ", join(pairs, "; ")) +
                  overview_caption(analysis);
  if (std::ranges::any_of(f.data.points, &Observation::censored))
    text += " Open triangles: captured.";
  if (!results.empty()) text += say(" {}.", join(results, ", "));
  return text + say(" recoil {}.", version());
}

std::vector<Figure> restitution_figures(const Analysis& analysis) {
  const std::vector<Panel> panels = panels_of(analysis);
  std::vector<Figure> figures;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    plot::Picture picture =
        restitution_picture(analysis, panels[i], axes_of(analysis, panels, panels[i].dataset));
    picture.name = fmt::format("restitution-{}", i + 1);
    std::string explored = explored_panel(analysis, panels[i], picture.plots.front());
    figures.push_back(figure_of(std::move(picture), restitution_caption(analysis, panels[i])));
    figures.back().explored = std::move(explored);
  }
  return figures;
}

std::vector<Figure> residual_figures(const Analysis& analysis) {
  std::vector<Figure> figures;
  for (std::size_t k = 0; k < analysis.datasets.size(); ++k) {
    const std::vector<ResidualRow> rows = residual_rows(analysis, k);
    if (rows.empty()) continue;
    figures.push_back(
        figure_of({.name = fmt::format("residuals-{}", k + 1),
                   .title = "Weighted residuals against velocity, " + analysis.datasets[k].id,
                   .height = 320,
                   .plots = {residual_plot(rows)}},
                  residual_caption(analysis, rows, k)));
  }
  return figures;
}

std::vector<Figure> law_error_figures(const Analysis& analysis) {
  const FitResult& f = analysis.fitted;
  const ModelJudgement judged = judge_model(f, analysis.uncertainty.options.level);
  if (!judged.laws || !judged.laws->seen() || !f.model.law_error || f.covariance.empty()) return {};
  std::vector<Figure> figures;
  const std::vector<Panel> all = panels_of(analysis);
  for (std::size_t d = 0; d < analysis.datasets.size(); ++d) {
    std::vector<Panel> panels;
    for (const Panel& panel : all) {
      if (panel.dataset == d && !panel.points.empty()) panels.push_back(panel);
    }
    const std::size_t sizes = panels.size(), most = plot::markers.size();
    for (std::size_t k = 0; sizes > most && k < most; ++k) {
      panels[k] = panels[k * (sizes - 1) / (most - 1)];
    }
    panels.resize(std::min(sizes, most));
    if (panels.empty()) continue;
    const std::string name = short_name(analysis.datasets, d);
    Sentence caption =
        figures.empty()
            ? say("What the laws get wrong, {}: the loss of energy of every point beyond that of "
                  "exact laws with the fitted constants, {+/-} 1 sd; lines: the error of the laws "
                  "under its likeliest form, with {} bands.",
                  name, percent(analysis.uncertainty.options.level))
            : say("What the laws get wrong, {}, as above.", name);
    if (sizes > most) caption += say(" {} of {} sizes.", most, sizes);
    figures.push_back(
        figure_of({.name = fmt::format("law-error-{}", d + 1),
                   .title = "Error of the laws against velocity, " + analysis.datasets[d].id,
                   .width = 560,
                   .height = 380,
                   .plots = {law_error_plot(analysis, panels)}},
                  caption));
  }
  return figures;
}

std::vector<Figure> capture_figures(const Analysis& analysis) {
  std::vector<Figure> figures;
  for (const CaptureComparison& comparison : analysis.captures) {
    if (comparison.diameter.size() < 2 || comparison.curves.empty()) continue;
    const Dataset& dataset = analysis.datasets[comparison.dataset];
    figures.push_back(figure_of({.name = fmt::format("capture-models-{}", comparison.dataset + 1),
                                 .title = "Capture velocity against diameter, " + dataset.id,
                                 .height = 430,
                                 .plots = {capture_plot(comparison, dataset)}},
                                capture_caption(comparison, dataset)));
  }
  return figures;
}

}  // namespace recoil
