#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "analysis/analysis.hpp"
#include "cli/commands.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "data/dataset.hpp"
#include "data/quantity.hpp"
#include "data/text.hpp"
#include "json/fit_file.hpp"
#include "plan/experiment_plan.hpp"
#include "plan/guesses.hpp"
#include "plot/plot.hpp"
#include "report/plan_report.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

/// Sets the requested velocities and diameters, or else those of the points.
void take_ranges(const GivenOptions& given, const std::vector<Dataset>& datasets,
                 PlanOptions& options) {
  options.diameters = given.numbers("--diameter");
  const std::vector<double> velocity = given.numbers("--velocity");
  if (!velocity.empty()) {
    require_range(velocity);
    options.slowest = velocity[0];
    options.fastest = velocity[1];
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

/// Assigns the value of --assume NAME=VALUE to every slot of this parameter.
void assume(const std::string& name, const std::string& text, const FitSpec& spec,
            ImpactModel& model) {
  bool found = false;
  for (ParameterSlot& slot : model.slots) {
    if (slot.parameter->name != name) continue;
    found = true;
    const std::string unit(slot.parameter->unit);
    const auto dimension = unit == "1" ? std::nullopt : dimension_of_unit(unit);
    const double value = parse_quantity(text, dimension.value_or(Dimension::ratio),
                                        dimension ? unit : "1", fmt::format("--assume {}", name));
    const double lower = slot.free ? slot.lower : std::min(0.0, slot.parameter->lower);
    const double upper = slot.free ? slot.upper : slot.parameter->upper;
    if (!(value >= lower && value <= upper)) {
      throw InputError({}, fmt::format("--assume {}={:g} is outside its bounds", name, value),
                       fmt::format("they are {:g} to {:g}", lower, upper),
                       "assume another value, or widen the bounds in the fit file");
    }
    slot.initial = value;
  }
  if (found) return;
  std::vector<std::string> names;
  for (const ParameterSlot& slot : model.slots) names.emplace_back(slot.parameter->name);
  throw InputError({}, fmt::format("--assume: {} is not a parameter of this fit", quote(name)),
                   fmt::format("its law of adhesion is {}", to_string(spec.adhesion)),
                   did_you_mean(name, names));
}

/// The values of `model`, with the covariance of a fit for those that it estimated and `stated`,
/// the names of --assume, do not replace. It includes the errors of the laws, if the fit does.
Guess guess_of(const ImpactModel& model, const std::optional<FitFile>& fitted,
               const std::set<std::string, std::less<>>& stated) {
  const std::size_t n = model.slots.size();
  Guess guess{model.initial(), {}};
  if (!fitted || !fitted->covariance) return guess;
  guess.covariance.assign(n, std::vector<double>(n, 0.0));
  std::map<std::string, std::size_t> rows;
  for (std::size_t j = 0; j < n; ++j) {
    if (stated.contains(model.slots[j].parameter->name)) continue;
    rows[model.slots[j].label()] = j;
  }
  for (const auto& [one, row] : *fitted->covariance) {
    for (const auto& [other, value] : row) {
      if (!rows.contains(one) || !rows.contains(other)) continue;
      guess.covariance[rows[one]][rows[other]] = value.value_or(0.0);
    }
  }
  return guess;
}

PlanOptions plan_options(const GivenOptions& given) {
  PlanOptions plan;
  plan.error = given.number("--error");
  plan.impacts = static_cast<int>(given.whole_if_any("--impacts").value_or(0));
  plan.events = static_cast<int>(given.whole("--events"));
  plan.checks = given.number("--checks");
  plan.scatter = given.number("--scatter");
  plan.floor = given.number("--floor");
  plan.spread = given.number("--spread");
  return plan;
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

/// That a fit of the points would take another law of loss than the plan assumes; empty if not.
std::string other_loss_words(const FitSpec& spec, const std::vector<Dataset>& datasets) {
  const auto measured = [](const Dataset& dataset) { return !dataset.points.empty(); };
  if (!std::ranges::all_of(datasets, measured)) return "";
  const std::string loss = choose_loss(spec, datasets).spec.loss;
  if (loss.empty() || loss == hunt_crossley) return "";
  return fmt::format(
      " (a fit of the points chooses the loss {}: fit them, and plan with --parameters)", loss);
}

void run_plan(const GivenOptions& given) {
  const fs::path out = given.text("--out");
  if (!out.empty()) require_writable_folder(out);
  const std::string parameters = given.text("--parameters");
  const std::optional<FitFile> fitted = read_parameters(parameters);
  const FitSpec spec = with_fitted_loss(load_fit(given.text("FIT")), fitted);
  std::vector<Dataset> datasets;
  for (const fs::path& folder : spec.datasets) {
    datasets.push_back(load_dataset_to_be_measured(folder));
  }
  PlanOptions options = plan_options(given);
  take_ranges(given, datasets, options);
  const std::vector<fs::path> forms = forms_of(out, datasets);
  const Replacing replacing = given.has("--replace") ? Replacing::data : Replacing::results;
  std::optional<Claim> claim;
  if (!out.empty()) {
    require_free(forms, replacing);
    claim.emplace(out / "plan.json");
  }
  const std::vector<Dataset> planned = datasets_to_plan(datasets, options.diameters);
  ImpactModel model = make_model(spec, planned);
  const std::string to_a_factor = fmt::format("to a factor of {:g}", guess_factor);
  std::string origin = "the initial values of the fit file, " + to_a_factor +
                       (fitted ? "" : other_loss_words(spec, datasets));
  if (fitted) {
    take_fitted_values(model, datasets, *fitted, parameters);
    origin = origin_words(*fitted, parameters) + ", with the errors of the fit";
  }
  std::set<std::string, std::less<>> stated;
  for (const auto& [name, value] : given.assignments("--assume")) {
    assume(name, value, spec, model);
    origin += fmt::format(", {} as stated{}", name, fitted ? " " + to_a_factor : "");
    stated.insert(name);
  }
  const ExperimentPlan plan = plan_experiment(
      spec, planned, drawn_values(model, guess_of(model, fitted, stated), spec.uncertainty.seed),
      options);
  const std::string result = json_plan(plan);
  if (!out.empty()) {
    std::vector<WholeFile> files;
    for (std::size_t d = 0; d < forms.size(); ++d) {
      files.push_back({forms[d], csv_points_to_make(plan, d)});
    }
    files.push_back({out / "plan.html", plan_html(plan, origin)});
    files.push_back({out / "plan.json", result});
    write_whole_files(files, replacing);
  }
  print_text("{}", given.has("--json") ? result : plan_text(plan, origin, importance_of(given)));
}

}  // namespace

void add_plan(Program& program) {
  program.command("plan",
                  "plan an experiment: which velocities and sizes to measure, and how often", R"(
Needs a fit file and datasets with materials; the datasets need no points yet. The plan
determines the free parameters and the capture velocities with the fewest impacts, and states
the errors to expect. It serves for parameters that are a factor of 2 wrong, but less well:
measure a quarter of it, fit, and plan the rest with --parameters. With --out it writes plan.html (a page to read), plan.json and points.csv
(to be filled in).

  recoil init my-spheres --like datasets/wall1990-mica --diameter 4.9
  recoil plan my-spheres/fit.toml --velocity 0.5,50 --diameter 2,5 --error 0.05 \
      --out my-plan)",
                  run_plan);
}

}  // namespace recoil
