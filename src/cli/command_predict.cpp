
#include <memory>
#include <optional>

#include "analysis/analysis.hpp"
#include "cli/commands.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "core/units.hpp"
#include "plot/draw.hpp"
#include "report/prediction_report.hpp"

namespace recoil {
namespace {

struct PredictOptions : CommonFlags {
  std::string sizes;
  std::string unit;
  std::optional<double> height;  // [mm]
  bool midpoints = false;
};

void run_predict(const PredictOptions& options) {
  if (!options.out.empty()) require_writable_folder(options.out);
  const MeasuredSizes sizes = load_sizes(options.sizes, options.unit);
  const AnalysisOptions resolved = options.analysis.resolved();
  FitInputs inputs = load_inputs(options.fit_file);
  const std::filesystem::path out = options.out;
  std::optional<Claim> claim;
  if (!options.out.empty()) {
    require_free({out / "predict.csv", out / "predict.json"});
    claim.emplace(out / "predict.json");
  }
  Analysis analysis = analyse_fit(std::move(inputs), resolved);
  choose_dataset(analysis.datasets, options.dataset);  // throws before the bootstrap
  analysis.uncertainty = bootstrap_only(analysis.fitted, analysis.datasets,
                                        uncertainty_options(analysis.spec, resolved));
  const PolydispersePrediction mixture =
      predict_sizes(analysis, sizes, options.height, options.midpoints, options.dataset);
  const std::string result = json_prediction(analysis, mixture);
  const std::string printed = options.json ? result : text_prediction(analysis, mixture);
  if (!options.out.empty()) {
    write_or_print(
        {{out / "predict-average.svg", plot::draw_svg(mixture_figure(analysis, mixture).picture)},
         {out / "predict.csv", csv_prediction(mixture)},
         {out / "predict.json", result}},
        printed);
  }
  print_text("{}", printed);
  if (!options.height && !sizes.probe_height) {
    print_text(options.json ? stderr : stdout,
               "note: without --height, the {:g} mm of Li, Dunn & Brach (1999) is used\n",
               mixture.probe_height / units::mm);
  }
}

}  // namespace

void add_predict(Program& program) {
  const Command command =
      program.command("predict", "predict the mean restitution of a mixture of sizes", R"(
Fits as `recoil fit` does and averages e(V) over the sizes of SIZES.csv (columns diameter and
count) under three conventions: captured spheres count as e = 0; captured spheres are left out;
captured spheres and those too slow to return to the measuring plane are left out. With --out it
writes predict.csv, predict.json and a picture.

  recoil predict fits/li1999-sst65-silicon.toml --sizes datasets/li1999-sst65-silicon/sizes.csv)");
  const auto options = std::make_shared<PredictOptions>();
  add_fit_file(command, options->fit_file);
  command.option("--sizes", options->sizes, "the size distribution (CSV)").required().takes("FILE");
  command.option("--unit", options->unit,
                 "unit of its diameters: um, mm or m (default: from the datapackage.json beside "
                 "it, otherwise um)");
  command
      .option("--height", options->height,
              "height of the measuring plane above the surface [mm] (default: from the "
              "datapackage.json beside it, otherwise 1)")
      .within(0.0, 1000.0);
  command.flag("--midpoints", options->midpoints,
               "place all spheres of a bin at its midpoint, as in the paper (default: spread them "
               "over the bin)");
  command.option("--dataset", options->dataset, "id of the dataset, in a fit of several")
      .takes("ID");
  command.option("--out", options->out, "folder for the files (default: none are written)")
      .takes("DIR");
  add_analysis_flags(command, options->analysis);
  add_json_flag(command, options->json);
  command.runs([options] { run_predict(*options); });
}

}  // namespace recoil
