#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "core/files.hpp"
#include "core/json.hpp"
#include "validation/synthetic/case.hpp"

namespace recoil::hidden {
namespace {

/// As a table prints it: `digits` significant digits, never 1.2e+01.
std::string printed(double value, int digits) {
  const int decimals = digits - 1 - static_cast<int>(std::floor(std::log10(value)));
  return fmt::format("{:.{}f}", value, std::max(decimals, 0));
}

Json field(const char* name, const char* type, const char* unit, const char* description) {
  Json f = {{"name", name}, {"type", type}};
  if (*unit != '\0') f["unit"] = unit;
  f["description"] = description;
  return f;
}

/// The conditions that some of the points state.
std::vector<std::string> changed_conditions(const Case& made) {
  std::set<std::string> names;
  for (const Point& p : made.points) {
    if (!p.changed.name.empty()) names.insert(p.changed.name);
  }
  return {names.begin(), names.end()};
}

/// Drops are of known heights; every second data set states which.
bool names_settings(const Case& made) {
  const Design& design = made.design;
  return design.dropped && !reads_times(design.readout) && made.order.index % 2 == 1;
}

bool counts_captures(const Case& made) {
  return std::any_of(made.points.begin(), made.points.end(),
                     [](const Point& p) { return p.captured > 0; });
}

Json fields_of(const Case& made) {
  Json fields = {field("series", "string", "", "one row of the table"),
                 field("diameter", "number", "um", "of the sphere"),
                 field("incident_velocity", "number", "m/s", "before the impact"),
                 field("restitution", "number", "1", "mean of the rebounds"),
                 field("restitution_sd", "number", "1", "standard error of that mean"),
                 field("events", "integer", "1", "rebounds averaged in this point")};
  if (counts_captures(made)) {
    fields.push_back(field("captured", "integer", "1", "of the events; empty where not counted"));
  }
  for (const std::string& condition : changed_conditions(made)) {
    const bool plain = condition == "neutralised" || condition == "relative_humidity" ||
                       condition == "velocities_calibrated" || condition == "sizes_calibrated" ||
                       condition == "sizes_equal";
    const char* const unit = plain ? "1" : condition == "ambient_pressure" ? "Pa" : "m";
    fields.push_back(field(condition.c_str(), "number", unit, "of the impacts of this point"));
  }
  if (names_settings(made)) {
    fields.push_back(field("setting", "string", "", "the height from which it was dropped"));
  }
  return fields;
}

std::string package_text(const Case& made, const std::string& name) {
  const Design& d = made.design;
  const Base& b = d.base;
  Json package;
  package["name"] = name;
  package["title"] = fmt::format("Synthetic impacts of {} spheres on {}", d.sphere, d.surface);
  package["resources"] = Json::array();
  Json resource = {{"name", "points"}, {"path", "points.csv"}};
  resource["schema"]["fields"] = fields_of(made);
  package["resources"].push_back(resource);
  Json& own = package["recoil"];
  own["provenance"] = "synthetic";
  own["particle"] = {{"material", d.sphere},
                     {"density", b.density},
                     {"youngs_modulus", b.youngs_modulus},
                     {"poisson_ratio", b.poisson_ratio}};
  own["surface"] = {{"material", d.surface},
                    {"density", b.surface_density},
                    {"youngs_modulus", b.surface_modulus},
                    {"poisson_ratio", b.surface_ratio}};
  if (b.stated_stiffness > 0.0) own["stiffness_K"] = b.stated_stiffness;
  for (const StatedCondition& c : made.conditions) own["conditions"][c.name] = c.value;
  if (d.dropped) {
    own["method"] = reads_times(d.readout) ? "bounce_intervals" : "drop_heights";
    own["adhesion_energy"] = 0;
  } else {
    own["adhesion_force_f0"] = b.adhesion_force;
    own["reference_diameter"] = b.reference_diameter;
  }
  return package.dump(2) + "\n";
}

std::string points_text(const Case& made) {
  const std::vector<std::string> changed = changed_conditions(made);
  std::string text = "series,diameter,incident_velocity,restitution,restitution_sd,events";
  const bool counts = counts_captures(made);
  if (counts) text += ",captured";
  for (const std::string& name : changed) text += "," + name;
  const bool settings = names_settings(made);
  if (settings) text += ",setting";
  text += "\n";
  for (std::size_t i = 0; i < made.points.size(); ++i) {
    const Point& p = made.points[i];
    const std::string& name = made.design.rows[p.row].name;
    const bool quoted = name.find(',') != std::string::npos;
    text += fmt::format("{0}{1}{0},{2:g},{3},{4:.{5}f},{6},{7}", quoted ? "\"" : "", name,
                        1e6 * p.diameter, printed(p.velocity, 3), made.readings[i],
                        made.design.decimals + (p.events > 0 ? 2 : 0),
                        printed(p.sd / (1.0 + made.effects.deviations_short), 3),
                        p.events > 0 ? p.events : made.design.events);
    if (counts) text += p.events > 0 ? fmt::format(",{}", p.captured) : ",";
    for (const std::string& condition : changed) {
      text += p.changed.name == condition ? fmt::format(",{:g}", p.changed.value) : ",";
    }
    if (settings) text += fmt::format(",height {}", p.setting);
    text += "\n";
  }
  return text;
}

std::string fit_text(const Case& made, const std::string& dataset) {
  if (made.design.dropped) {
    return fmt::format(
        "dataset = \"{}\"\n\n[parameters]\nC_H = {{ initial = 3e-2, bounds = [0, 1] }}\n\n"
        "[uncertainty]\nreplicates = 0\nlevel = 0.95\nseed = 20260101\n",
        dataset);
  }
  const bool steel = made.design.id == "li";
  return fmt::format(
      "dataset = \"{}\"\n\n[model]\nadhesion_damping_phase = \"rebound\"\n\n[parameters]\n"
      "C_H = {{ initial = {}, bounds = [0, 1] }}\n"
      "C_A = {{ initial = 3e-2, bounds = [0, 10] }}\n"
      "f0 = {{ free = false }}\n\n[uncertainty]\nreplicates = 0\nlevel = 0.95\n"
      "seed = 20260101\n",
      dataset, steel ? "3e-2" : "3e-3");
}

}  // namespace

std::filesystem::path write_case(const Case& made, const std::filesystem::path& folder) {
  const std::string name = neutral_name(made.order);
  write_whole_file(folder / name / "datapackage.json", package_text(made, name), Replacing::data);
  write_whole_file(folder / name / "points.csv", points_text(made), Replacing::data);
  const std::filesystem::path fit = folder / (name + ".toml");
  write_whole_file(fit, fit_text(made, name), Replacing::data);
  return fit;
}

ScratchFolder::ScratchFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "impacts-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace recoil::hidden
