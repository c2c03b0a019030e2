#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "report/figure_style.hpp"
#include "report/figures.hpp"
#include "report/format.hpp"
#include "report/svg_plot.hpp"

namespace recoil {
namespace {

// The velocity of the paper's Fig. 6.
constexpr double paper_velocity = 5.2;  // [m/s]
constexpr std::size_t most_moments = 160;

std::vector<std::vector<double>> cube_root_curve(double f0, double diameter, double largest_um) {
  std::vector<std::vector<double>> rows;
  constexpr int steps = 60;
  for (int i = 0; i <= steps; ++i) {
    // Denser where the cube root bends.
    const double radius = largest_um * std::pow(static_cast<double>(i) / steps, 2.0);
    rows.push_back({radius, adhesion_force_at(f0, diameter, 2.0 * radius * units::um)});
  }
  return rows;
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

/// Time and the four forces and their sum in the units of the axes.
std::vector<std::vector<double>> history_rows(const std::vector<ImpactMoment>& history,
                                              const ImpactScales& scales, double time_factor,
                                              double force_factor) {
  std::vector<std::vector<double>> rows;
  const double f = scales.force * force_factor;
  const std::size_t stride = history.size() / most_moments + 1;
  for (std::size_t i = 0; i < history.size(); ++i) {
    if (i % stride != 0 && i + 1 != history.size()) continue;
    const ImpactMoment& m = history[i];
    rows.push_back({m.time * scales.time * time_factor, m.hertz * f, m.hertz_damping * f,
                    m.adhesion * f, m.adhesion_damping * f,
                    (m.hertz + m.hertz_damping + m.adhesion + m.adhesion_damping) * f});
  }
  return rows;
}

std::string budget_words(const ImpactResult& result) {
  const EnergyBudget& energy = result.energy;
  return fmt::format("Of the incident kinetic energy C_H takes {:.3g} % and C_A {:.3g} %",
                     200.0 * energy.hertz_loss, 200.0 * energy.adhesion_loss);
}

Figure force_history_figure(const Analysis& analysis, std::size_t dataset) {
  const double velocity = velocity_for_history(analysis, dataset);
  const ImpactConditions conditions = reference_conditions(analysis, dataset, velocity);
  const ImpactScales scales = impact_scales(conditions);
  ImpactOptions options;
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
  PlotScript script;
  script.name = fmt::format("force-history-{}", dataset + 1);
  script.title = fmt::format("Contact forces during one impact, {}", analysis.datasets[dataset].id);
  script.height = 390;
  std::string heading =
      fmt::format("d = {} µm, V = {} m/s", diameter_text(conditions.diameter), number(velocity, 3));
  if (analysis.datasets.size() > 1) heading += ", " + analysis.datasets[dataset].id;
  std::string& c = script.commands;
  c = style::preamble() + style::title(heading) +
      fmt::format("set xrange [0:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n",
                  1.02 * longest * time.factor, bottom * force.factor - 0.06 * span,
                  top * force.factor + 0.06 * span) +
      fmt::format("set xlabel 'time since touch  [{}]' offset 0,0.4\n", time.name) +
      fmt::format("set ylabel 'force on the sphere  [{}]' offset 1,0\n", force.name) +
      style::key_below(3) + "set xzeroaxis lc rgb '#999999' lw 1\n" +
      data_block("history", history_rows(history, scales, time.factor, force.factor));
  c += fmt::format(
      "plot $history using 1:2 with lines lc rgb '{}' lw 2 title 'Hertz', \\\n"
      "  $history using 1:3 with lines lc rgb '{}' lw 2 dt (8,4) title 'Hertz damping', \\\n"
      "  $history using 1:4 with lines lc rgb '{}' lw 2 title 'adhesion', \\\n"
      "  $history using 1:5 with lines lc rgb '{}' lw 2 dt (8,4) title 'adhesion damping', \\\n"
      "  $history using 1:6 with lines lc rgb '{}' lw 1 dt (2,3) title 'sum'\n",
      style::blue, style::sky, style::vermillion, style::orange, style::ink);

  std::string caption = fmt::format(
      "{}. Reference diameter {} µm at {} m/s with the fitted parameters: {}. Forces "
      "away from the surface are positive.",
      analysis.datasets[dataset].id, diameter_text(conditions.diameter), number(velocity, 3),
      to_string(result.outcome));
  if (result.outcome == ImpactOutcome::rebound) {
    caption += fmt::format(" e = {}. {}.", number(std::sqrt(result.restitution_squared), 3),
                           budget_words(result));
  } else if (result.outcome == ImpactOutcome::captured) {
    caption += " The curves end where the sphere turns back for good.";
  }
  return {script.name, script.title, caption, draw_svg(script)};
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

  PlotScript script;
  script.name = "adhesion-force-1";
  script.title = "Adhesion force per length against radius";
  script.height = 340;
  std::string& c = script.commands;
  c = style::preamble() + fmt::format("set xrange [0:{:.6g}]\nset yrange [0:*]\n", largest_um) +
      "set xlabel 'radius r  [µm]' offset 0,0.4\nset ylabel 'f_{0}  [N/m]' offset 1,0\n"
      "set key bottom right Left reverse\n";
  std::vector<std::string> layers;
  bool refined = false;
  for (std::size_t k = 0; k < analysis.datasets.size(); ++k) {
    const ContactProperties& contact = model.contacts[k];
    const std::size_t slot = model.slot_f0[k];
    const double f0 = analysis.fitted.theta[slot];
    const style::Marker marker = style::markers[k % style::markers.size()];
    std::vector<std::vector<double>> sizes;
    for (const double diameter : distinct_diameters(analysis.datasets[k])) {
      sizes.push_back({diameter / 2.0 / units::um,
                       adhesion_force_at(f0, contact.reference_diameter, diameter)});
    }
    c += data_block(fmt::format("line{}", k),
                    cube_root_curve(f0, contact.reference_diameter, largest_um));
    c += data_block(fmt::format("sizes{}", k), sizes);
    layers.push_back(fmt::format("$line{} using 1:2 with lines lc rgb '{}' lw 2 title {}", k,
                                 marker.colour, gnuplot_text(analysis.datasets[k].id)));
    layers.push_back(fmt::format("$sizes{} using 1:2 with points lc rgb '{}' pt {} ps 0.8 notitle",
                                 k, marker.colour, marker.point));
    const bool differs = std::abs(f0 - contact.adhesion_force_derived) >
                         0.02 * std::abs(contact.adhesion_force_derived);
    if (differs) {
      c += data_block(
          fmt::format("derived{}", k),
          cube_root_curve(contact.adhesion_force_derived, contact.reference_diameter, largest_um));
      layers.push_back(
          fmt::format("$derived{} using 1:2 with lines lc rgb '{}' lw 1.4 dt (6,5) title 'eq. 12'",
                      k, marker.colour));
      refined = true;
    }
    const Interval interval = recommended_interval(intervals_of(analysis, slot));
    if (interval.available()) {
      c += data_block(fmt::format("free{}", k), {{contact.reference_diameter / 2.0 / units::um, f0,
                                                  *interval.lower, *interval.upper}});
      layers.push_back(
          fmt::format("$free{} using 1:2:3:4 with yerrorbars lc rgb '{}' lw 2 pt {} ps 1 notitle",
                      k, marker.colour, marker.point));
    }
  }
  c += fmt::format("plot {}\n", fmt::join(layers, ", \\\n  "));
  std::string caption =
      "f0 grows with the cube root of the radius (eq. 12); marks: the diameters of the data.";
  for (std::size_t k = 0; k < analysis.datasets.size(); ++k) {
    caption += fmt::format(" {}: {} N/m at d = {} µm{}.", analysis.datasets[k].id,
                           number(analysis.fitted.theta[model.slot_f0[k]]),
                           diameter_text(model.contacts[k].reference_diameter),
                           model.slots[model.slot_f0[k]].free ? ", fitted" : "");
  }
  if (refined) caption += " Dashed: what the material constants alone give.";
  return {{script.name, script.title, caption, draw_svg(script)}};
}

std::vector<Figure> force_history_figures(const Analysis& analysis) {
  std::vector<Figure> figures;
  for (std::size_t k = 0; k < analysis.datasets.size(); ++k) {
    figures.push_back(force_history_figure(analysis, k));
  }
  return figures;
}

}  // namespace recoil
