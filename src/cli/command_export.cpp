#include <fmt/format.h>

#include <algorithm>

#include "analysis/analysis.hpp"
#include "cli/commands.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "core/units.hpp"
#include "document/sentence.hpp"
#include "export/files.hpp"
#include "export/table.hpp"
#include "json/fit_file.hpp"
#include "report/words_export.hpp"
#include "report/words_restitution.hpp"
#include "report/words_verdict.hpp"

namespace recoil {
namespace {

/// A model with its fitted values.
struct Fitted {
  ImpactModel model;
  std::vector<double> theta;
  std::vector<Dataset> datasets;
  std::vector<std::vector<double>> replicates;
  double level = 0.95;
  ExportSource source;
};

/// Copies the values to `fitted.source`. `std_error_of(s)` is the standard error of slot s.
template <class StandardError>
void set_values(Fitted& fitted, const StandardError& std_error_of) {
  for (std::size_t s = 0; s < fitted.theta.size(); ++s) {
    const ParameterSlot& slot = fitted.model.slots[s];
    fitted.source.values.push_back({slot.label(), std::string(slot.parameter->unit),
                                    acting_value(fitted.model, fitted.theta, s), slot.free,
                                    std_error_of(s)});
  }
}

Fitted fit_points(FitInputs inputs, const GivenOptions& given, bool bands) {
  const AnalysisOptions resolved = analysis_options(given);
  Analysis analysis = analyse_fit(std::move(inputs), resolved);
  // An engine has no error of the laws: the values are those that fit best without one.
  const FitResult& fitted = with_laws_exact(analysis.fitted);
  Fitted out;
  if (bands) {
    const UncertaintyOptions assess = uncertainty_options(analysis.spec, resolved);
    out.level = assess.level;
    out.replicates = bootstrap_only(fitted, analysis.datasets, assess).bootstrap.theta;
  }
  out.model = fitted.model;
  out.theta = fitted.theta;
  out.source.parameters = "fitted by all of its points";
  set_values(out, [&](std::size_t s) {
    const double error = fitted.std_error[s];
    return error > 0.0 ? std::optional(error) : std::nullopt;
  });
  out.source.rmse = fitted.rmse;
  const ModelVerdict verdict = judge_model(analysis.fitted).verdict;
  if (verdict == ModelVerdict::does_not_fit || verdict == ModelVerdict::fits_within_law_error) {
    out.source.misfit =
        plain_text(verdict_sentence(analysis.fitted) + " " +
                   join(restitution_sentences(analysis.datasets, analysis.fitted), " "));
  }
  out.datasets = std::move(analysis.datasets);
  return out;
}

Fitted read_fitted_values(FitInputs inputs, const FitFile& fit, const std::string& file) {
  Fitted out;
  out.model = make_model(inputs.spec, inputs.datasets);
  const std::vector<FittedValue> values = take_fitted_values(out.model, inputs.datasets, fit, file);
  out.theta = out.model.initial();
  out.source.parameters = origin_words(fit, file);
  set_values(out, [&](std::size_t s) { return values[s].std_error; });
  const Observations data = gather(inputs.datasets, inputs.spec);
  out.source.rmse = root_mean_square(out.model, out.theta, data, first_weights(data));
  out.datasets = std::move(inputs.datasets);
  return out;
}

/// @throws InputError if every impact was captured, because the fit then has its initial values
void require_rebounds(const Dataset& dataset) {
  if (std::ranges::any_of(dataset.points,
                          [](const ImpactPoint& point) { return !point.all_captured(); })) {
    return;
  }
  throw InputError({dataset.folder.string()}, "nothing of this dataset can be exported",
                   "all of its impacts were captured, which determines no parameter",
                   "measure faster impacts");
}

/// The requested diameter and velocities, or by default those of the points.
ExportRequest request_of(const GivenOptions& given, const Dataset& dataset, std::size_t index) {
  ExportRequest request;
  request.dataset = index;
  const std::vector<double> velocity = given.numbers("--velocity");
  if (velocity.empty()) {
    const auto [least, most] =
        std::ranges::minmax_element(dataset.points, [](const ImpactPoint& a, const ImpactPoint& b) {
          return a.incident_velocity < b.incident_velocity;
        });
    request.slowest = least->incident_velocity;
    request.fastest = most->incident_velocity;
    if (request.slowest == request.fastest) {
      throw InputError({}, "all points have one velocity", "a range is needed",
                       "state one: --velocity MIN,MAX");
    }
  } else {
    require_range(velocity);
    request.slowest = velocity[0];
    request.fastest = velocity[1];
  }
  const std::vector<double> sizes = distinct_diameters(dataset);
  request.diameter = given.number_if_any("--diameter").value_or(sizes[sizes.size() / 2]);
  return request;
}

bool holds_all_sizes(ExportTarget target) {
  return target == ExportTarget::openfoam || target == ExportTarget::fluent ||
         target == ExportTarget::table;
}

std::vector<WholeFile> files_for(ExportTarget target, const ExportJob& job) {
  using Writer = std::vector<WholeFile> (*)(const ExportJob&);
  static constexpr Writer writers[] = {lammps_files, liggghts_files, yade_files, openfoam_files,
                                       fluent_files};  // in the order of ExportTarget
  return writers[static_cast<std::size_t>(target)](job);
}

std::vector<WholeFile> table_files(const Fitted& fitted, const ExportRequest& request,
                                   const std::vector<double>& sizes, int threads) {
  const std::vector<TabulatedSize> table =
      restitution_table(fitted.model, fitted.theta,
                        {request.dataset, sizes, request.slowest, request.fastest,
                         fitted.replicates, fitted.level, threads});
  return {{"restitution.csv", csv_restitution(table)}, {"capture.csv", csv_captures(table)}};
}

void run_export(const GivenOptions& given) {
  const ExportTarget target = *value_named<ExportTarget>(given.text("--to"));
  const std::filesystem::path out = given.text("--out");
  require_writable_folder(out);
  const Claim claim(out / "export");
  const std::string parameters = given.text("--parameters");
  const std::optional<FitFile> values = read_parameters(parameters);
  FitInputs inputs = load_inputs(given.text("FIT"));
  const std::size_t d = choose_dataset(inputs.datasets, given.text("--dataset"));
  require_rebounds(inputs.datasets[d]);
  Fitted fitted = values ? read_fitted_values(std::move(inputs), *values, parameters)
                         : fit_points(std::move(inputs), given, target == ExportTarget::table);
  const Dataset& dataset = fitted.datasets[d];
  const ExportRequest request = request_of(given, dataset, d);
  fitted.source.fit = given.text("FIT");
  fitted.source.dataset = dataset.id;
  fitted.source.provenance = dataset.provenance;

  std::vector<double> sizes = distinct_diameters(dataset);
  if (given.has("--diameter")) sizes = {request.diameter};
  ExportJob job;
  job.impact = exported_impact(fitted.model, fitted.theta, request);
  job.form = form_for(target, job.impact, given.has("--stock"));
  job.force = job.impact.force;
  if (job.form == ExportForm::refitted) {
    job.refitted = refitted_force(job.impact);
    job.force = job.refitted->force;
  }
  if (job.form == ExportForm::approximation) {
    job.stock = nearest_stock(target, job.impact);
  }
  if (job.form == ExportForm::lookup && target != ExportTarget::table) {
    job.lookup =
        restitution_lookup(fitted.model, fitted.theta,
                           {d, {sizes.front(), sizes.back()}, request.slowest, request.fastest});
  }
  job.heading = export_heading(target, fitted.source, job);
  std::vector<WholeFile> files =
      target == ExportTarget::table
          ? table_files(fitted, request, sizes, static_cast<int>(given.whole("--threads")))
          : files_for(target, job);
  for (WholeFile& file : files) file.path = out / file.path;
  write_whole_files(files);

  for (const std::string& line : job.heading) print_line(line);
  if (!holds_all_sizes(target) && !given.has("--diameter") && sizes.size() > 1) {
    print_line(fmt::format("note: without --diameter, {:g} um is used, the middle one of {} sizes",
                           request.diameter / units::um, sizes.size()));
  }
  if (target == ExportTarget::table && fitted.replicates.empty()) {
    print_line(
        "note: the table has no bands, because bands need the bootstrap; leave --parameters out to "
        "get them");
  }
  for (const WholeFile& file : files) print_text("written: {}\n", file.path.string());
  print_text("use: {}\n", export_use(target));
}

}  // namespace

void add_export(Program& program) {
  program.command("export", "write a fitted impact as input for another program, or as a table", R"(
Fits as `recoil fit` does, or takes the values of a fit.json with --parameters. LAMMPS and
YADE run the force law itself, so this export is exact. LIGGGHTS gets the nearest of its own
contact models, and the file states the error. OpenFOAM, Fluent and the table get e(V, d) with
captures. Every file states what it leaves out.

  recoil export fits/wall1990-molybdenum.toml --to lammps --diameter 4.9 --out my-lammps
  lmp -in my-lammps/impact.lammps -var V 2.4)",
                  run_export);
}

}  // namespace recoil
