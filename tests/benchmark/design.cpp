#include "design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/files.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
#include "estimate/fit_spec.hpp"

namespace recoil::bench {
namespace {

constexpr double reference_diameter = 4.9e-6;

/// To the three digits that a velocity would be stated with.
double three_digits(double value) { return std::stod(fmt::format("{:.3g}", value)); }

ImpactSystem materials() {
  ImpactSystem system;
  system.particle = {"ammonium fluorescein", truth().density, 1.2e9, 0.33, std::nullopt};
  system.surface = {"molybdenum", 0.0, 320e9, 0.31, std::nullopt};
  system.stiffness_K = truth().stiffness;
  system.adhesion_force_f0 = Start().f0;
  system.reference_diameter = reference_diameter;
  return system;
}

std::string points_csv(int velocities, bool state_sd) {
  std::string text = "series,diameter,incident_velocity,restitution";
  text += state_sd ? ",restitution_sd\n" : "\n";
  std::uint64_t index = 0;
  for (const double diameter : diameters()) {
    const double lowest = lowest_velocity * true_capture_velocity(truth(), diameter);
    for (int i = 0; i < velocities; ++i) {
      const double part = static_cast<double>(i) / (velocities - 1);
      const double velocity = three_digits(lowest * std::pow(highest_velocity / lowest, part));
      const double e = true_restitution(truth(), diameter, velocity);
      const double sd = relative_noise * e;
      RandomStream random(noise_seed, RandomPurpose::reconstruction, index++);
      text += fmt::format("{0:.2f} um,{0:.2f},{1},{2}", diameter / units::um, velocity,
                          e + sd * random.normal());
      text += state_sd ? fmt::format(",{}\n", sd) : "\n";
    }
  }
  return text;
}

/// A field after the restitution: a count, or a number without dimension.
std::string field_json(const char* column, bool is_count) {
  return fmt::format(",\n      {{ \"name\": \"{}\", {} }}", column,
                     is_count ? R"("type": "integer")" : R"("type": "number", "unit": "1")");
}

/// @param more fields after the restitution
std::string datapackage_json(const std::string& more) {
  const ImpactSystem system = materials();
  return fmt::format(R"({{
  "name": "benchmark",
  "title": "Four sizes of ammonium fluorescein on molybdenum, written by the benchmark",
  "resources": [{{
    "name": "points", "path": "points.csv",
    "schema": {{ "fields": [
      {{ "name": "series", "type": "string" }},
      {{ "name": "diameter", "type": "number", "unit": "um" }},
      {{ "name": "incident_velocity", "type": "number", "unit": "m/s" }},
      {{ "name": "restitution", "type": "number", "unit": "1" }}{}
    ] }}
  }}],
  "recoil": {{
    "provenance": "synthetic",
    "particle": {{ "material": "{}", "density": {}, "youngs_modulus": {}, "poisson_ratio": {} }},
    "surface": {{ "material": "{}", "youngs_modulus": {}, "poisson_ratio": {} }},
    "stiffness_K": {}, "adhesion_force_f0": {}, "reference_diameter": {}
  }}
}}
)",
                     more, system.particle.name, system.particle.density,
                     system.particle.youngs_modulus, system.particle.poisson_ratio,
                     system.surface.name, system.surface.youngs_modulus,
                     system.surface.poisson_ratio, *system.stiffness_K, *system.adhesion_force_f0,
                     *system.reference_diameter);
}

std::string fit_toml() {
  const Start start;
  return fmt::format(R"(dataset = "."

[parameters]
C_H = {{ initial = {}, bounds = [0, 1] }}
C_A = {{ initial = {}, bounds = [0, 10] }}
f0 = {{ initial = {}, free = true }}
)",
                     start.C_H, start.C_A, start.f0);
}

/// e^2 over the velocity at one diameter, from the independent simulator: a table that is read off
/// between its nodes, to about 1e-4. Enough where only the cost of a fit matters.
class RestitutionTable {
 public:
  RestitutionTable(const Truth& nature, double diameter)
      : lowest_(std::log(lowest_velocity * true_capture_velocity(nature, diameter))),
        step_((std::log(highest_velocity) - lowest_) / (nodes - 1)) {
    for (int i = 0; i < nodes; ++i) {
      const double e = true_restitution(nature, diameter, std::exp(lowest_ + i * step_));
      square_.push_back(e * e);
    }
  }

  /// The velocity at `part` of the way up, in [0, 1].
  double velocity(double part) const { return std::exp(lowest_ + part * (nodes - 1) * step_); }

  double restitution(double part) const {
    const double at = part * (nodes - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(at), square_.size() - 2);
    const double rest = at - static_cast<double>(i);
    return std::sqrt((1.0 - rest) * square_[i] + rest * square_[i + 1]);
  }

 private:
  static constexpr int nodes = 200;
  double lowest_;
  double step_;
  std::vector<double> square_;
};

FitSpec large_spec(int free_parameters) {
  FitSpec spec;
  spec.id = "large";
  for (const Parameter& entry : base_parameters()) {
    ParameterSpec parameter = default_of(entry);
    parameter.free = true;
    parameter.initial_stated = true;
    const Start start;
    if (entry.name == "C_H") {
      parameter.initial = start.C_H;
    } else if (entry.name == "C_A") {
      parameter.free = free_parameters >= 2;
      parameter.initial = parameter.free ? start.C_A : truth().C_A;
      parameter.per_dataset = free_parameters > 3;
    } else {
      parameter.free = free_parameters >= 3;
      parameter.initial = parameter.free ? start.f0 : truth().adhesion_force;
    }
    spec.parameters.push_back(parameter);
  }
  return spec;
}

}  // namespace

Truth truth() {
  Truth nature;
  nature.density = 1350.0;
  nature.stiffness = 1.789e9;
  nature.adhesion_force = 9.5;
  nature.reference_diameter = reference_diameter;
  nature.C_H = 2.5e-3;
  nature.C_A = 0.035;
  return nature;
}

const std::vector<double>& diameters() {
  static const std::vector<double> sizes = {2.58e-6, 3.42e-6, 4.90e-6, 6.89e-6};
  return sizes;
}

void write_peer_case(const std::filesystem::path& folder, int velocities, bool state_sd) {
  const Start start;
  write_whole_file(folder / "points.csv", points_csv(velocities, state_sd), Replacing::data);
  write_whole_file(folder / "datapackage.json",
                   datapackage_json(state_sd ? field_json("restitution_sd", false) : ""),
                   Replacing::data);
  write_whole_file(folder / "fit.toml", fit_toml(), Replacing::data);
  write_whole_file(folder / "constants.json",
                   fmt::format("{{\"density\": {}, \"stiffness\": {}, \"reference_diameter\": {}, "
                               "\"start\": {{\"C_H\": {}, \"C_A\": {}, \"f0\": {}}}}}\n",
                               truth().density, truth().stiffness, reference_diameter, start.C_H,
                               start.C_A, start.f0));
  write_whole_file(folder / "constants.csv",
                   fmt::format("density,stiffness,reference_diameter,start_C_H,start_C_A,start_f0\n"
                               "{},{},{},{},{},{}\n",
                               truth().density, truth().stiffness, reference_diameter, start.C_H,
                               start.C_A, start.f0));
}

void write_captures(const std::filesystem::path& rows, const std::filesystem::path& means,
                    const std::vector<double>& factors, int impacts) {
  constexpr double spread = 0.05;   // of the capture velocity from impact to impact
  constexpr double reading = 0.02;  // sd of e of one impact
  const std::string head = "series,diameter,incident_velocity,restitution,events,captured\n";
  std::string single = head;
  std::string counted = head;
  RandomStream random(noise_seed, RandomPurpose::reconstruction, 0);
  for (const double diameter : {diameters()[0], diameters()[2], diameters()[3]}) {
    const double capture = true_capture_velocity(truth(), diameter);
    for (const double factor : factors) {
      const double velocity = three_digits(factor * capture);
      const std::string place =
          fmt::format("{0:.2f} um,{0:.2f},{1}", diameter / units::um, velocity);
      double sum = 0.0;
      int rebounds = 0;
      for (int i = 0; i < impacts; ++i) {
        const double alike = velocity * std::exp(spread * random.normal());
        const double noise = reading * random.normal();
        if (alike <= capture) {
          single += place + ",,1,1\n";
          continue;
        }
        const double e = std::max(0.001, true_restitution(truth(), diameter, alike) + noise);
        single += fmt::format("{},{:.5f},1,0\n", place, e);
        sum += e;
        ++rebounds;
      }
      const std::string mean = rebounds > 0 ? fmt::format("{:.5f}", sum / rebounds) : "";
      counted += fmt::format("{},{},{},{}\n", place, mean, impacts, impacts - rebounds);
    }
  }
  const std::string package =
      datapackage_json(field_json("events", true) + field_json("captured", true));
  const std::string fit =
      fmt::format("dataset = \".\"\n\n[parameters]\nf0 = {{ initial = {}, free = false }}\n",
                  truth().adhesion_force);
  for (const auto& [folder, points] : {std::pair(rows, single), std::pair(means, counted)}) {
    write_whole_file(folder / "points.csv", points, Replacing::data);
    write_whole_file(folder / "datapackage.json", package, Replacing::data);
    write_whole_file(folder / "fit.toml", fit, Replacing::data);
  }
}

Case load_case(const std::filesystem::path& fit_file) {
  FitSpec spec = load_fit(fit_file);
  Case loaded;
  for (const std::filesystem::path& folder : spec.datasets) {
    loaded.datasets.push_back(load_dataset(folder));
  }
  spec.uncertainty.materials = Materials::exact;  // as its peers do
  loaded.model = make_model(spec, loaded.datasets);
  loaded.data = gather(loaded.datasets);
  return loaded;
}

Case large_case(std::size_t points, int free_parameters) {
  const std::size_t datasets = static_cast<std::size_t>(std::max(1, free_parameters - 2));
  const std::size_t sizes = diameters().size();
  Case made;
  std::vector<RestitutionTable> tables;  // [dataset x diameter]
  for (std::size_t d = 0; d < datasets; ++d) {
    Dataset dataset;
    dataset.id = fmt::format("surface-{}", d + 1);
    dataset.provenance = Provenance::synthetic;
    dataset.system = materials();
    Truth nature = truth();
    nature.C_A *= 1.0 + 0.1 * static_cast<double>(d);
    for (const double diameter : diameters()) {
      dataset.series.push_back(fmt::format("{:.2f} um", diameter / units::um));
      tables.emplace_back(nature, diameter);
    }
    made.datasets.push_back(std::move(dataset));
  }
  RandomStream random(noise_seed, RandomPurpose::reconstruction, 0);
  for (std::size_t i = 0; i < points; ++i) {
    const std::size_t d = i % datasets;
    ImpactPoint point;
    point.series = i / datasets % sizes;
    point.diameter = diameters()[point.series];
    const RestitutionTable& table = tables[d * sizes + point.series];
    const double part = random.uniform();
    const double e = table.restitution(part);
    point.incident_velocity = table.velocity(part);
    point.restitution_sd = relative_noise * e;
    point.restitution = e + relative_noise * e * random.normal();
    made.datasets[d].points.push_back(point);
  }
  made.model = make_model(large_spec(free_parameters), made.datasets);
  made.data = gather(made.datasets);
  return made;
}

}  // namespace recoil::bench
