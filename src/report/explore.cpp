#include "report/explore.hpp"

#include <algorithm>
#include <cmath>

#include "core/json.hpp"

namespace recoil {
namespace {

/// Points with scatter need all of it, the others a few columns.
const std::vector<std::pair<const char*, double (*)(const Observation&)>>& point_values() {
  using Point = const Observation&;
  static const std::vector<std::pair<const char*, double (*)(Point)>> values = {
      {"velocity", [](Point p) { return p.velocity; }},
      {"diameter", [](Point p) { return p.diameter; }},
      {"restitution", [](Point p) { return p.restitution; }},
      {"sd", [](Point p) { return p.weights.sd; }},
      {"censored", [](Point p) { return p.censored ? 1.0 : 0.0; }},
      {"input_sd", [](Point p) { return p.weights.input_sd; }},
      {"scatter", [](Point p) { return p.weights.scatter; }},
      {"shift", [](Point p) { return p.weights.shift; }},
      {"mean_sd", [](Point p) { return p.weights.mean_sd; }},
      {"least", [](Point p) { return p.weights.scatter > 0.0 ? p.weights.peak.deviance : 0.0; }},
      {"events", [](Point p) { return double(p.events); }},
      {"captured", [](Point p) { return double(p.captured); }},
      {"counted", [](Point p) { return p.counted ? 1.0 : 0.0; }}};
  return values;
}

double rounded(double value) {
  constexpr double digits = 8.0;
  if (value == 0.0 || !std::isfinite(value)) return value;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - digits);
  // Written as a quotient of whole numbers, so that its shortest text is short.
  return unit < 1.0 ? std::round(value / unit) / std::round(1.0 / unit)
                    : std::round(value / unit) * unit;
}

/// Rows of numbers and the names of their columns; a column in which all is 0 is left out.
void add_points(const Analysis& analysis, const std::vector<std::size_t>& points, Json& out) {
  std::vector<const Observation*> drawn;
  double chi2 = 0.0;
  for (std::size_t k = 0; k < points.size(); k += points.size() / most_panel_points + 1) {
    drawn.push_back(&analysis.fitted.data.points[points[k]]);
    chi2 += std::pow(analysis.fitted.residuals[points[k]], 2);
  }
  out["chi2"] = number_or_null(chi2);
  out["columns"] = Json::array();
  out["points"] = Json(std::vector<Json>(drawn.size(), Json::array()));
  for (const auto& [name, value] : point_values()) {
    const auto& of = value;
    if (std::all_of(drawn.begin(), drawn.end(),
                    [&of](const Observation* point) { return of(*point) == 0.0; })) {
      continue;
    }
    out["columns"].push_back(name);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      out["points"][i].push_back(number_or_null(rounded(of(*drawn[i]))));
    }
  }
}

}  // namespace

std::string explored_panel(const Analysis& analysis, const Panel& panel,
                           const plot::Picture& picture) {
  const FitResult& fit = analysis.fitted;
  const ImpactModel& model = fit.model;
  const plot::Plot& shown = picture.plots.front();
  if (!model.chain.empty() || averages_over_sizes(model) || !shown.frame) return "";
  if (model.contacts[panel.dataset].surface_diameter > 0.0) return "";  // it knows flats alone
  const auto& points = fit.data.points;                                 // and every point by its e
  if (std::any_of(points.begin(), points.end(),
                  [](const Observation& p) { return p.counts_only(); }))
    return "";
  const ImpactConditions at = conditions_at(model, fit.theta, panel.dataset, panel.diameter, 1.0);
  const ParameterSlot& adhesion = model.slots[model.slot_adhesion[panel.dataset]];
  Json out;
  out["law"] = to_string(model.adhesion);
  out["phase"] = to_string(model.phase);
  out["C_H"] = at.hertz_damping;
  out["C_A"] = at.adhesion_damping;
  out["adhesion"] = adhesion_value_under(model, fit.theta, panel.dataset);
  out["adhesion_name"] = adhesion.parameter->name;
  out["adhesion_unit"] = adhesion.parameter->unit;
  out["diameter"] = panel.diameter;
  out["reference_diameter"] = model.contacts[panel.dataset].reference_diameter;
  out["density"] = at.density;
  out["stiffness"] = at.stiffness;
  out["separation"] = at.separation;
  const double height = picture.height;
  out["frame"] = {shown.frame->left, shown.frame->right, height - shown.frame->bottom,
                  height - shown.frame->top};
  out["velocities"] = {shown.x.from.value(), shown.x.to.value()};
  out["top"] = shown.y.to.value();
  out["student"] = nullptr;
  if (const auto& student = fit.data.noise.student) {
    out["student"] = {{"nu", student->dof}, {"unit", std::sqrt(student->calibration())}};
  }
  add_points(analysis, panel.points, out);
  return json_line(out);
}

}  // namespace recoil
