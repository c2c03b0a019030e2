
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

void run_predict(const GivenOptions& given) {
  const std::filesystem::path out = given.text("--out");
  if (!out.empty()) require_writable_folder(out);
  const MeasuredSizes sizes = load_sizes(given.text("--sizes"), given.text("--unit"));
  const std::string dataset = given.text("--dataset");
  const AnalysisOptions resolved = analysis_options(given);
  FitInputs inputs = load_inputs(given.text("FIT"));
  std::optional<Claim> claim;
  if (!out.empty()) {
    require_free({out / "predict.csv", out / "predict.json"});
    claim.emplace(out / "predict.json");
  }
  Analysis analysis = analyse_fit(std::move(inputs), resolved);
  choose_dataset(analysis.datasets, dataset);  // throws before the bootstrap
  analysis.uncertainty = bootstrap_only(analysis.fitted, analysis.datasets,
                                        uncertainty_options(analysis.spec, resolved));
  const PolydispersePrediction mixture = predict_sizes(
      analysis, sizes, given.number_if_any("--height"), given.has("--midpoints"), dataset);
  const std::string result = json_prediction(analysis, mixture);
  const std::string printed = given.has("--json") ? result : text_prediction(analysis, mixture);
  if (!out.empty()) {
    write_or_print(
        {{out / "predict-average.svg", plot::draw_svg(mixture_figure(analysis, mixture).picture)},
         {out / "predict.csv", csv_prediction(mixture)},
         {out / "predict.json", result}},
        printed);
  }
  print_text("{}", printed);
  if (!given.has("--height") && !sizes.probe_height) {
    print_text(given.has("--json") ? stderr : stdout,
               "note: without --height, the {:g} mm of Li, Dunn & Brach (1999) is used\n",
               mixture.probe_height / units::mm);
  }
}

}  // namespace

void add_predict(Program& program) {
  program.command("predict", "predict the mean restitution of a mixture of sizes", R"(
Fits as `recoil fit` does and averages e(V) over the sizes of SIZES.csv (columns diameter and
count) under three conventions: captured spheres count as e = 0; captured spheres are left out;
captured spheres and those too slow to return to the measuring plane are left out. With --out it
writes predict.csv, predict.json and a picture.

  recoil predict fits/li1999-sst65-silicon.toml --sizes datasets/li1999-sst65-silicon/sizes.csv)",
                  run_predict);
}

}  // namespace recoil
