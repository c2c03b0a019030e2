#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "analysis/analysis.hpp"
#include "cli/commands.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "core/units.hpp"
#include "data/dataset.hpp"
#include "json/fit_file.hpp"
#include "plan/experiment_plan.hpp"
#include "plot/plot.hpp"
#include "predict/simulated_impact.hpp"
#include "report/plan_report.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

struct PlanFlags : CommonFlags {
  std::map<std::string, double> assumed;  ///< by the name of the parameter; those that were given
  std::vector<double> velocity;           // [m/s]
  std::vector<double> diameters;          // [um]
  PlanOptions plan;
  bool replace = false;
};

/// Sets the requested velocities and diameters, or else those of the points.
void take_ranges(const PlanFlags& flags, const std::vector<Dataset>& datasets,
                 PlanOptions& options) {
  for (const double diameter : flags.diameters) options.diameters.push_back(diameter * units::um);
  if (!flags.velocity.empty()) {
    require_range(flags.velocity);
    options.slowest = flags.velocity[0];
    options.fastest = flags.velocity[1];
    return;
  }
  double slowest = INFINITY;
  double fastest = 0.0;
  for (const Dataset& dataset : datasets) {
    for (const ImpactPoint& point : dataset.points) {
      slowest = std::min(slowest, point.incident_velocity);
      fastest = std::max(fastest, point.incident_velocity);
    }
  }
  if (slowest < fastest) {
    options.slowest = slowest;
    options.fastest = fastest;
  }
}

/// Assigns an assumed value to every slot of its parameter.
void assume(const std::string& name, double value, const FitSpec& spec, ImpactModel& model) {
  bool found = false;
  for (ParameterSlot& slot : model.slots) {
    if (slot.parameter->name != name) continue;
    found = true;
    if (slot.free && !(value >= slot.lower && value <= slot.upper)) {
      throw InputError({}, fmt::format("--{} {:g} is outside its bounds", name, value),
                       fmt::format("the fit file allows {:g} to {:g}", slot.lower, slot.upper),
                       "assume another value, or widen the bounds");
    }
    slot.initial = value;
  }
  if (found) return;
  throw InputError({}, fmt::format("--{} is not a parameter of this fit", name),
                   fmt::format("its law of adhesion is {}", to_string(spec.adhesion)),
                   traits(spec.adhesion).by_force ? "give --f0" : "give --W");
}

/// The files of points to be measured, one for each dataset.
std::vector<fs::path> forms_of(const fs::path& folder, const std::vector<Dataset>& datasets) {
  if (datasets.size() == 1) return {folder / "points.csv"};
  std::vector<fs::path> forms;
  for (const Dataset& dataset : datasets) {
    forms.push_back(folder / (plot::plot_name("points-" + dataset.id) + ".csv"));
  }
  return forms;
}

void run_plan(PlanFlags flags) {
  if (!flags.out.empty()) require_writable_folder(flags.out);
  const std::optional<FitFile> fitted = read_parameters(flags.parameters);
  const FitSpec spec = with_fitted_loss(load_fit(flags.fit_file), fitted);
  std::vector<Dataset> datasets;
  for (const fs::path& folder : spec.datasets) {
    datasets.push_back(load_dataset_to_be_measured(folder));
  }
  take_ranges(flags, datasets, flags.plan);
  const std::vector<fs::path> forms = forms_of(flags.out, datasets);
  const Replacing replacing = flags.replace ? Replacing::data : Replacing::results;
  std::optional<Claim> claim;
  if (!flags.out.empty()) {
    require_free(forms, replacing);
    claim.emplace(fs::path(flags.out) / "plan.json");
  }
  const std::vector<Dataset> planned = datasets_to_plan(datasets, flags.plan.diameters);
  ImpactModel model = make_model(spec, planned);
  std::string origin = "the initial values of the fit file";
  if (fitted) {
    take_fitted_values(model, datasets, *fitted, flags.parameters);
    origin = "from " + flags.parameters;
  }
  for (const auto& [name, value] : flags.assumed) {
    assume(name, value, spec, model);
    origin += fmt::format(", {} as stated", name);
  }
  const ExperimentPlan plan = plan_experiment(spec, planned, model.initial(), flags.plan);
  const std::string result = json_plan(plan);
  if (!flags.out.empty()) {
    const fs::path out = flags.out;
    std::vector<WholeFile> files;
    for (std::size_t d = 0; d < forms.size(); ++d) {
      files.push_back({forms[d], csv_points_to_make(plan, d)});
    }
    files.push_back({out / "plan.html", plan_html(plan, origin)});
    files.push_back({out / "plan.json", result});
    write_whole_files(files, replacing);
  }
  print_text("{}", flags.json ? result : plan_text(plan, origin));
}

void add_assumptions(const Command& command, const std::shared_ptr<PlanFlags>& flags) {
  const auto parameter = [&](const std::string& name, const std::string& help, double most) {
    command
        .option(
            "--" + name, [flags, name](double value) { flags->assumed[name] = value; }, help)
        .within(0.0, most, name);
  };
  parameter("C_H",
            "assume this damping of the contact [s/m] (default: the initial value of the fit file)",
            1e6);
  parameter(
      "C_A",
      "assume this damping of the adhesion [s/m] (default: the initial value of the fit file)",
      1e6);
  parameter("f0",
            "assume this adhesion per length at the reference diameter [N/m] (default: from the "
            "fit file or the materials)",
            1e6);
  parameter("W", "assume this work of adhesion [J/m2] (laws jkr, dmt and maugis)", 40.0);
  command
      .option("--parameters", flags->parameters,
              "take the values from this fit.json, of the same fit and data")
      .takes("FILE");
  command
      .option("--scatter", flags->plan.scatter,
              "standard deviation of the e of one impact, relative to e")
      .shows_default()
      .within(0.0, 1.0, "scatter");
  command
      .option("--floor", flags->plan.floor,
              "part of that standard deviation that does not depend on e")
      .shows_default()
      .within(1e-6, 1.0, "standard deviation");
  command
      .option("--spread", flags->plan.spread,
              "relative standard deviation of the capture velocity from impact to impact; 0: "
              "capture is sharp")
      .shows_default()
      .within(0.0, 0.5, "spread");
}

}  // namespace

void add_plan(Program& program) {
  const Command command = program.command(
      "plan", "plan an experiment: which velocities and sizes to measure, and how often", R"(
Needs a fit file and datasets with materials; the datasets need no points yet. The plan
determines the free parameters and the capture velocities with the fewest impacts, and states
the errors to expect. It depends on the assumed parameters: repeat it with --parameters after
the first results. With --out it writes plan.html (a page to read), plan.json and points.csv
(to be filled in).

  recoil init my-spheres --like datasets/wall1990-mica --diameter 4.9
  recoil plan my-spheres/fit.toml --velocity 0.5,50 --diameter 2,5 --error 0.05 \
      --out my-plan)");
  const auto flags = std::make_shared<PlanFlags>();
  add_fit_file(command, flags->fit_file);
  command
      .option("--velocity", flags->velocity,
              "range of incident velocities MIN,MAX [m/s] (default: that of the points, or 0.8 to "
              "30 times the capture velocities)")
      .list()
      .values(2, 2)
      .takes("MIN,MAX")
      .within(velocity_limits.first, velocity_limits.second, "velocity");
  command
      .option("--diameter", flags->diameters,
              "available sphere diameters [um], e.g. 2,5,10 (default: those of the points)")
      .list()
      .takes("D,D,...")
      .within(diameter_limits_um.first, diameter_limits_um.second, "diameter");
  command
      .option("--error", flags->plan.error,
              "wanted relative standard error of every free parameter and capture velocity")
      .shows_default()
      .within(1e-4, 1.0, "error");
  command
      .option("--impacts", flags->plan.impacts,
              "total number of impacts (default: as many as the wanted error needs, at most 10000)")
      .within(1, 10000000);
  command.option("--events", flags->plan.events, "number of impacts averaged in one point")
      .shows_default()
      .within(1, 100000);
  command
      .option("--checks", flags->plan.checks,
              "share of the points that is spread evenly to detect a wrong model")
      .shows_default()
      .within(0.0, 1.0, "share");
  add_assumptions(command, flags);
  command.option("--out", flags->out, "folder for the files (default: nothing is written)")
      .takes("DIR");
  command.flag("--replace", flags->replace, "replace an existing points.csv");
  add_json_flag(command, flags->json);
  command.runs([flags] { run_plan(*flags); });
}

}  // namespace recoil
