#include "made_fits.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "validation/truth/truth.hpp"

namespace pairs {
namespace {

using Json = nlohmann::ordered_json;

/// Two bodies, and the damping of their impacts.
struct Bodies {
  double density = 1350.0, youngs_modulus = 1.2e9, poisson_ratio = 0.33;
  double adhesion_energy = 0.335;  ///< [J/m2]
  double C_H = 3e-3, C_A = 0.03;   ///< [s/m]
};

Json system_of(const Bodies& bodies) {
  return {{"provenance", "synthetic"},
          {"particle",
           {{"material", "sphere"},
            {"density", bodies.density},
            {"youngs_modulus", bodies.youngs_modulus},
            {"poisson_ratio", bodies.poisson_ratio}}},
          {"surface",
           {{"material", "glass"},
            {"density", 2500.0},
            {"youngs_modulus", 70e9},
            {"poisson_ratio", 0.22}}},
          {"adhesion_energy", bodies.adhesion_energy}};
}

recoil::Truth truth_of(const Bodies& bodies, double diameter, recoil::TrueAdhesion law) {
  recoil::Truth truth;
  truth.law = law;
  truth.density = bodies.density;
  const double sphere = (1.0 - std::pow(bodies.poisson_ratio, 2)) / bodies.youngs_modulus;
  truth.stiffness = 4.0 / 3.0 / (sphere + (1.0 - 0.22 * 0.22) / 70e9);
  truth.reference_diameter = diameter;
  truth.adhesion_force =
      recoil::recipe_adhesion_force(truth.stiffness, bodies.adhesion_energy, diameter);
  truth.work = bodies.adhesion_energy;
  truth.C_H = bodies.C_H;
  truth.C_A = bodies.adhesion_energy > 0.0 ? bodies.C_A : 0.0;
  return truth;
}

/// A table of points: cells by column.
class Points {
 public:
  explicit Points(std::vector<std::pair<std::string, std::string>> columns)
      : columns_(std::move(columns)) {
    columns_.insert(columns_.begin(), {"series", ""});
  }
  /// @param cells of the columns but the series
  void add(const std::vector<std::string>& cells) {
    rows_ += "run,";
    for (std::size_t k = 0; k < cells.size(); ++k) rows_ += (k == 0 ? "" : ",") + cells[k];
    rows_ += "\n";
  }

  void write(const std::filesystem::path& folder, const Json& system) const {
    Json fields = Json::array();
    std::string header;
    for (const auto& [name, unit] : columns_) {
      const bool counts = name == "events" || name == "captured";
      const char* type = unit.empty() ? "string" : counts ? "integer" : "number";
      fields.push_back({{"name", name}, {"type", type}});
      if (!unit.empty()) fields.back()["unit"] = unit;
      header += (header.empty() ? "" : ",") + name;
    }
    const Json resource = {
        {"name", "points"}, {"path", "points.csv"}, {"schema", {{"fields", fields}}}};
    const Json package = {{"name", folder.filename().string()},
                          {"resources", Json::array({resource})},
                          {"recoil", system}};
    support::write_text(folder / "points.csv", header + "\n" + rows_);
    support::write_text(folder / "datapackage.json", package.dump(2));
  }

 private:
  std::vector<std::pair<std::string, std::string>> columns_;
  std::string rows_;
};

const std::vector<std::pair<std::string, std::string>> mean_columns = {{"diameter", "um"},
                                                                       {"incident_velocity", "m/s"},
                                                                       {"restitution", "1"},
                                                                       {"restitution_sd", "1"}};

std::string number(double value) { return fmt::format("{:.6g}", value); }

/// `count` points from `slowest` to `fastest` [m/s], alternately too high and too low by one
/// standard deviation.
Points rebounds(const recoil::Truth& truth, double diameter, int count, double slowest,
                double fastest) {
  constexpr double sd = 0.01;
  Points points(mean_columns);
  for (int k = 0; k < count; ++k) {
    const double part = count > 1 ? k / (count - 1.0) : 0.0;
    const double velocity = slowest * std::pow(fastest / slowest, part);
    const double e = recoil::true_restitution(truth, diameter, velocity);
    points.add({number(diameter * 1e6), number(velocity), number(e + (k % 2 == 0 ? sd : -sd)),
                number(sd)});
  }
  return points;
}

/// The same from 1.3 to 20 times the capture velocity.
Points adhering(const recoil::Truth& truth, double diameter, int count) {
  const double capture = recoil::true_capture_velocity(truth, diameter);
  return rebounds(truth, diameter, count, 1.3 * capture, 20.0 * capture);
}

}  // namespace

std::vector<MadeFit> write_made_fits(const support::TemporaryFolder& place) {
  using recoil::TrueAdhesion;
  std::vector<MadeFit> made;
  const auto add = [&](const MadeFit& fit, const std::string& keys) -> std::filesystem::path {
    std::string datasets;
    for (const std::string& id : fit.datasets) {
      datasets += (datasets.empty() ? "\"" : ", \"") + id + "\"";
    }
    place.write(fit.name + "/fit.toml", "dataset = [" + datasets + "]\n" + keys +
                                            "[uncertainty]\nreplicates = 39\nown_design = false\n");
    made.push_back(fit);
    return place / fit.name;
  };
  const Bodies organic;
  const double size = 4.9e-6;
  const auto capture = [&](TrueAdhesion law) {
    return recoil::true_capture_velocity(truth_of(organic, size, law), size);
  };

  for (const auto& [name, law] :
       std::vector<std::pair<std::string, TrueAdhesion>>{{"ring", TrueAdhesion::ring},
                                                         {"jkr", TrueAdhesion::jkr},
                                                         {"dmt", TrueAdhesion::dmt},
                                                         {"maugis", TrueAdhesion::jkr}}) {
    MadeFit fit;
    fit.name = name;
    fit.quick = name == "ring" || name == "jkr";
    const auto folder = add(fit, "[model]\nadhesion = \"" + name + "\"\n");
    adhering(truth_of(organic, size, law), size, 6).write(folder / "data", system_of(organic));
  }
  const recoil::Truth ring = truth_of(organic, size, TrueAdhesion::ring);
  {
    const auto folder = add({"student"}, "[noise]\nresiduals = \"student\"\n");
    adhering(ring, size, 8).write(folder / "data", system_of(organic));
  }
  {
    const auto folder = add({"several_datasets", {"glass", "bare"}}, "");
    adhering(ring, size, 6).write(folder / "glass", system_of(organic));
    Bodies weaker = organic;
    weaker.adhesion_energy = 0.1;
    adhering(truth_of(weaker, size, TrueAdhesion::ring), size, 6)
        .write(folder / "bare", system_of(weaker));
  }
  {
    const auto folder = add({"two_spheres"}, "");
    Json system = system_of(organic);
    system["surface"]["diameter"] = 50e-6;
    adhering(ring, size, 6).write(folder / "data", system);
  }
  {
    const auto folder = add({"all_captured"}, "");
    Points points({{"diameter", "um"},
                   {"incident_velocity", "m/s"},
                   {"restitution", "1"},
                   {"events", "1"},
                   {"captured", "1"}});
    for (const double times : {0.3, 0.5, 0.8}) {
      points.add({number(size * 1e6), number(times * capture(TrueAdhesion::ring)), "", "10", "10"});
    }
    points.write(folder / "data", system_of(organic));
  }
  {
    const auto folder = add({"counts_only"}, "[parameters]\nC_H = { free = false }\n");
    Points points(
        {{"diameter", "um"}, {"incident_velocity", "m/s"}, {"events", "1"}, {"captured", "1"}});
    const std::vector<std::pair<double, int>> captured = {
        {0.85, 19}, {0.95, 14}, {1.0, 10}, {1.05, 7}, {1.2, 1}};
    for (const auto& [times, count] : captured) {
      points.add({number(size * 1e6), number(times * capture(TrueAdhesion::ring)), "20",
                  std::to_string(count)});
    }
    points.write(folder / "data", system_of(organic));
  }
  Bodies dry = organic;
  dry.adhesion_energy = 0.0;
  dry.C_H = 0.03;
  {
    const auto folder = add({"dry_ball", {"data"}, 20e-3, 2.0}, "");
    const recoil::Truth truth = truth_of(dry, 20e-3, TrueAdhesion::ring);
    rebounds(truth, 20e-3, 6, 1.0, 4.0).write(folder / "data", system_of(dry));
  }
  {
    const auto folder = add({"one_point", {"data"}, 20e-3, 2.0}, "");
    const recoil::Truth truth = truth_of(dry, 20e-3, TrueAdhesion::ring);
    rebounds(truth, 20e-3, 1, 2.0, 2.0).write(folder / "data", system_of(dry));
  }
  {
    Bodies gel = dry;
    gel.density = 1000.0;
    gel.youngs_modulus = 1e5;
    gel.poisson_ratio = 0.49;
    const auto folder = add({"gel", {"data"}, 2e-3, 1.0}, "");
    const recoil::Truth truth = truth_of(gel, 2e-3, TrueAdhesion::ring);
    rebounds(truth, 2e-3, 6, 0.3, 2.0).write(folder / "data", system_of(gel));
  }
  {
    const auto folder = add({"beads", {"data"}, 1e-3, 0.5}, "");
    Bodies glass = organic;
    glass.density = 2500.0;
    glass.youngs_modulus = 70e9;
    glass.poisson_ratio = 0.22;
    const recoil::Truth truth = truth_of(glass, 1e-3, TrueAdhesion::ring);
    rebounds(truth, 1e-3, 6, 0.05, 2.0).write(folder / "data", system_of(glass));
  }
  return made;
}

}  // namespace pairs
