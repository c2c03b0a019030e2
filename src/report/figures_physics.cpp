#include "report/figures_physics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/units.hpp"
#include "impact/reference_solver.hpp"
#include "report/format.hpp"

namespace recoil {
namespace {

// The velocity of the paper's Fig. 6.
constexpr double paper_velocity = 5.2;  // [m/s]
constexpr std::size_t most_moments = 160;

plot::Line cube_root_curve(double f0, double diameter, double largest_um) {
  plot::Line line;
  constexpr int steps = 60;
  for (int i = 0; i <= steps; ++i) {
    // Denser where the cube root bends.
    const double radius = largest_um * std::pow(static_cast<double>(i) / steps, 2.0);
    line.x.push_back(radius);
    line.y.push_back(adhesion_force_at(f0, diameter, 2.0 * radius * units::um));
  }
  return line;
}

double velocity_for_history(const Analysis& analysis, std::size_t dataset) {
  double lower = INFINITY;
  double upper = 0.0;
  for (const Observation& point : analysis.fitted.data.points) {
    if (point.dataset != dataset) continue;
    lower = std::min(lower, point.velocity);
    upper = std::max(upper, point.velocity);
  }
  if (!(upper > 0.0)) return paper_velocity;
  const bool reached = lower <= paper_velocity && paper_velocity <= upper;
  return reached ? paper_velocity : std::sqrt(lower * upper);
}

struct ForceUnit {
  double factor;
  const char* name;
};

ForceUnit force_unit(double largest) {
  if (largest < 1e-6) return {1e9, "nN"};
  if (largest < 1e-3) return {1e6, "µN"};
  return {1e3, "mN"};
}

struct TimeUnit {
  double factor;
  const char* name;
};

TimeUnit time_unit(double longest) {
  return longest < 2e-6 ? TimeUnit{1e9, "ns"} : TimeUnit{1e6, "µs"};
}

/// The four forces and their sum against time, in the units of the axes.
std::vector<plot::Layer> history_lines(const std::vector<ImpactMoment>& history,
                                       const ImpactScales& scales, double time_factor,
                                       double force_factor) {
  constexpr auto dashed = plot::Dash::long_dashes;
  std::array<plot::Line, 5> lines = {{{{}, {}, {plot::blue, 2.0}},
                                      {{}, {}, {plot::sky, 2.0, dashed}},
                                      {{}, {}, {plot::vermillion, 2.0}},
                                      {{}, {}, {plot::orange, 2.0, dashed}},
                                      {{}, {}, {plot::ink, 1.0, plot::Dash::dots}}}};
  constexpr std::array<const char*, 5> names = {"Hertz", "Hertz damping", "adhesion",
                                                "adhesion damping", "sum"};
  const double f = scales.force * force_factor;
  const std::size_t stride = history.size() / most_moments + 1;
  for (std::size_t i = 0; i < history.size(); ++i) {
    if (i % stride != 0 && i + 1 != history.size()) continue;
    const ImpactMoment& m = history[i];
    const double sum = m.hertz + m.hertz_damping + m.adhesion + m.adhesion_damping;
    const std::array<double, 5> forces = {m.hertz, m.hertz_damping, m.adhesion, m.adhesion_damping,
                                          sum};
    for (std::size_t k = 0; k < lines.size(); ++k) {
      lines[k].x.push_back(m.time * scales.time * time_factor);
      lines[k].y.push_back(forces[k] * f);
    }
  }
  std::vector<plot::Layer> layers = {
      plot::Rule{plot::Direction::horizontal, 0.0, {"#999999", 1.0}}};
  for (std::size_t k = 0; k < lines.size(); ++k) {
    lines[k].name = names[k];
    layers.push_back(std::move(lines[k]));
  }
  return layers;
}

Sentence budget_words(const ImpactResult& result) {
  const EnergyBudget& energy = result.energy;
  return say("Of the incident kinetic energy {C_H} takes {:.3g} % and {C_A} {:.3g} %",
             200.0 * energy.hertz_loss, 200.0 * energy.adhesion_loss);
}

Figure force_history_figure(const Analysis& analysis, std::size_t dataset) {
  const double velocity = velocity_for_history(analysis, dataset);
  const ImpactConditions conditions = reference_conditions(analysis, dataset, velocity);
  const ImpactScales scales = impact_scales(conditions);
  ImpactOptions options;
  options.adhesion = analysis.fitted.model.adhesion;
  options.phase = analysis.fitted.model.phase;
  options.budget = true;
  std::vector<ImpactMoment> history;
  const ImpactResult result = simulate_impact(impact_groups(conditions), options, &history);

  double largest = 0.0;
  double longest = 0.0;
  double bottom = 0.0;
  double top = 0.0;
  for (const ImpactMoment& m : history) {
    for (const double force : {m.hertz, m.hertz_damping, m.adhesion, m.adhesion_damping}) {
      largest = std::max(largest, std::abs(force) * scales.force);
      bottom = std::min(bottom, force * scales.force);
      top = std::max(top, force * scales.force);
    }
    longest = std::max(longest, m.time * scales.time);
  }
  const ForceUnit force = force_unit(largest);
  const TimeUnit time = time_unit(longest);
  const double span = (top - bottom) * force.factor;
  plot::Plot shown;
  shown.heading =
      fmt::format("d = {}, V = {} m/s", diameter_label(conditions.diameter), number(velocity, 3));
  if (analysis.datasets.size() > 1) shown.heading += ", " + analysis.datasets[dataset].id;
  shown.x = {"time since contact", time.name};
  shown.x.set_range({0.0, 1.02 * longest * time.factor});
  shown.y = {"force on the sphere", force.name};
  shown.y.set_range({bottom * force.factor - 0.06 * span, top * force.factor + 0.06 * span});
  shown.key = {plot::KeyPlace::below, 3};
  shown.layers = history_lines(history, scales, time.factor, force.factor);
  plot::Picture picture;
  picture.name = fmt::format("force-history-{}", dataset + 1);
  picture.title =
      fmt::format("Contact forces during one impact, {}", analysis.datasets[dataset].id);
  picture.height = 390;
  picture.plots = {std::move(shown)};

  Sentence caption = fmt::format(
      "{}. Reference diameter {} at {} m/s with the fitted parameters: {}. Forces "
      "away from the surface are positive.",
      analysis.datasets[dataset].id, diameter_label(conditions.diameter), number(velocity, 3),
      to_string(result.outcome));
  if (result.outcome == ImpactOutcome::rebound) {
    caption +=
        say(" e = {}. {}.", number(std::sqrt(result.restitution_squared), 3), budget_words(result));
  } else if (result.outcome == ImpactOutcome::captured) {
    caption += " The curves end where the captured sphere has turned back for good.";
  }
  return figure_of(std::move(picture), caption);
}

}  // namespace

std::vector<Figure> adhesion_force_figures(const Analysis& analysis) {
  const ImpactModel& model = analysis.fitted.model;
  double largest_um = 0.0;
  for (const Observation& point : analysis.fitted.data.points) {
    largest_um = std::max(largest_um, point.diameter / 2.0 / units::um);
  }
  if (!(largest_um > 0.0)) return {};
  largest_um *= 1.15;

  plot::Plot shown;
  shown.x = {"radius r", "µm"};
  shown.x.set_range({0.0, largest_um});
  shown.y = {"f0", "N/m"};
  shown.y.from = 0.0;
  shown.key.place = plot::KeyPlace::lower_right;
  bool refined = false;
  for (std::size_t k = 0; k < analysis.datasets.size(); ++k) {
    const ContactProperties& contact = model.contacts[k];
    const std::size_t slot = model.slot_adhesion[k];
    const double f0 = adhesion_force_under(model, analysis.fitted.theta, k);
    const plot::Marker& marker = plot::marker(k);
    plot::Line line = cube_root_curve(f0, contact.reference_diameter, largest_um);
    line.stroke = {marker.colour, 2.0};
    line.name = analysis.datasets[k].id;
    shown.layers.push_back(std::move(line));
    plot::Points sizes;
    sizes.marker = marker;
    sizes.size = 0.8;
    for (const double diameter : distinct_diameters(analysis.datasets[k])) {
      sizes.x.push_back(diameter / 2.0 / units::um);
      sizes.y.push_back(adhesion_force_at(f0, contact.reference_diameter, diameter));
    }
    shown.layers.push_back(std::move(sizes));
    const bool differs = std::abs(f0 - contact.adhesion_force_derived) >
                         0.02 * std::abs(contact.adhesion_force_derived);
    if (differs) {
      plot::Line derived =
          cube_root_curve(contact.adhesion_force_derived, contact.reference_diameter, largest_um);
      derived.stroke = {marker.colour, 1.4, plot::Dash::dashes};
      derived.name = "eq. 12";
      shown.layers.push_back(std::move(derived));
      refined = true;
    }
    const Interval interval = recommended_interval(intervals_of(analysis, slot));
    if (interval.available() && traits(model.adhesion).by_force) {
      plot::Points free{{contact.reference_diameter / 2.0 / units::um}, {f0}};
      free.lower = {*interval.lower};
      free.upper = {*interval.upper};
      free.marker = marker;
      free.size = 1.0;
      free.width = 2.0;
      shown.layers.push_back(std::move(free));
    }
  }
  plot::Picture picture;
  picture.name = "adhesion-force-1";
  picture.title = "Adhesion force per length against radius";
  picture.plots = {std::move(shown)};
  Sentence caption = say(
      "{f0} grows with the cube root of the radius (eq. 12); marks: the diameters of the data.");
  for (std::size_t k = 0; k < analysis.datasets.size(); ++k) {
    caption += fmt::format(" {}: {} N/m at d = {} µm{}.", analysis.datasets[k].id,
                           number(adhesion_force_under(model, analysis.fitted.theta, k)),
                           diameter_text(model.contacts[k].reference_diameter),
                           model.slots[model.slot_adhesion[k]].free ? ", fitted" : "");
  }
  if (refined) caption += " Dashed: what the material constants alone give.";
  return {figure_of(std::move(picture), caption)};
}

std::vector<Figure> force_history_figures(const Analysis& analysis) {
  std::vector<Figure> figures;
  for (std::size_t k = 0; k < analysis.datasets.size(); ++k) {
    figures.push_back(force_history_figure(analysis, k));
  }
  return figures;
}

}  // namespace recoil
