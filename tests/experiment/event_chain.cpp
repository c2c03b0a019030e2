// The whole chain on the reconstructed experiment: events, pairing, points, fit, beside the truth
// that the recipe put there, and with each correction left out. Prints Markdown.
//   event_chain > reports/event-chain.md
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/files.hpp"
#include "estimate/fit.hpp"
#include "estimate/fit_spec.hpp"
#include "experiment/averages.hpp"
#include "experiment/pairing_files.hpp"
#include "reconstruction/passages.hpp"

namespace {

using namespace recoil;
namespace fs = std::filesystem;

struct Chain {
  fs::path dataset;
  Recipe recipe;
  EventTable table;
  int times = 1;  ///< so many times as many spheres as the recipe asks for
};

/// A way of getting from events to points.
struct Way {
  std::string name;
  bool at_plane = false;   ///< velocities not corrected to the surface
  bool later = false;      ///< second and further impacts used as well
  bool no_counts = false;  ///< survivors taken as plain means
  bool one_size = false;   ///< all sizes together
};

std::string points_of(const Chain& chain, const Way& way, const std::vector<double>& edges,
                      Averages& averages) {
  const auto rebounds = static_cast<std::size_t>(chain.times * chain.recipe.noise.events);
  PairOptions options;
  options.keep_later = way.later;
  options.height = chain.recipe.sizes->probe_height;
  options.angle = 8.0 * M_PI / 180.0;
  PairResult pairs = pair_events(chain.table.events, options);
  if (way.at_plane) {
    for (Impact& impact : pairs.impacts) {
      impact.incident = chain.table.events[impact.down].velocity;
      impact.rebound = -chain.table.events[impact.up].velocity;
      impact.restitution = impact.rebound / impact.incident;
    }
    for (Unpaired& lone : pairs.unpaired) lone.incident = chain.table.events[lone.down].velocity;
  }
  AverageOptions by;
  by.per_bin = rebounds / (way.one_size ? 1 : edges.size() - 1);  // about one drop height
  if (!way.one_size) by.size_edges = edges;
  averages = average(chain.table.events, chain.table.series, pairs, by);
  if (way.no_counts) {
    for (PointMean& point : averages.points) point.captured = 0;
    std::erase_if(averages.points, [](const PointMean& p) { return p.rebounds == 0; });
  }
  return points_csv(averages);
}

/// Mean of e - truth(mean size, mean velocity) over the rebounds of points with velocities in the
/// range.
std::string difference(const Chain& chain, const Averages& averages, double from, double to) {
  double sum = 0.0;
  double rebounds = 0.0;
  for (const PointMean& point : averages.points) {
    if (point.rebounds == 0 || point.velocity < from || point.velocity >= to) continue;
    const auto n = static_cast<double>(point.rebounds);
    sum += n * (point.restitution -
                true_restitution(chain.recipe.truth, point.diameter, point.velocity));
    rebounds += n;
  }
  return rebounds > 0.0 ? fmt::format("{:+.4f}", sum / rebounds) : "-";
}

std::string row(const Chain& chain, const Way& way, const std::vector<double>& edges) {
  Averages averages;
  const std::string csv = points_of(chain, way, edges, averages);
  const std::string like = read_text_file(chain.dataset / "datapackage.json");
  const Dataset dataset = parse_dataset(
      package_json(like, "datapackage.json", chain.recipe.id, "reconstruction", "events", ""), csv,
      chain.dataset);
  const FitSpec spec = load_fit(fs::path(RECOIL_SOURCE_DIR) / "fits" / (chain.recipe.id + ".toml"));
  const Observations data = gather({dataset}, spec.noise);
  const ImpactModel model = make_model(spec, {dataset});
  const FitResult fitted = fit(model, data);
  const double d10 = chain.recipe.series[0].diameter;
  std::string numbers = " no usable fit | | | |";
  if (fitted.usable) {
    const std::size_t h = fitted.model.slot_C_H[0];
    const std::size_t a = fitted.model.slot_C_A[0];
    const CaptureVelocity capture = capture_velocity(fitted.model, fitted.theta, 0, d10);
    numbers = fmt::format(" {:.4f} +- {:.4f} | {:.4f} +- {:.4f} | {:.3f} | {:.4f} |",
                          fitted.theta[h], fitted.std_error[h], fitted.theta[a],
                          fitted.std_error[a], capture.value, fitted.rmse);
  }
  return fmt::format("| {} | {} | {} | {} | {} |{}\n", way.name, averages.points.size(),
                     averages.captured, difference(chain, averages, 0.0, 0.7),
                     difference(chain, averages, 0.7, 10.0), numbers);
}

std::string chapter(const std::string& id, const std::vector<double>& edges, int times) {
  Chain chain;
  chain.times = times;
  chain.dataset = fs::path(RECOIL_SOURCE_DIR) / "datasets" / id;
  chain.recipe = load_recipe(chain.dataset);
  EventFormat format;
  format.units = {
      {"time", "s"}, {"velocity", "m/s"}, {"tangential_velocity", "m/s"}, {"diameter", "um"}};
  chain.table =
      parse_events(draw_passages(chain.recipe, chain.recipe.seed, times), "events.csv", "", format);
  const auto& truth = std::get<RingAdhesionTruth>(chain.recipe.truth);
  const double d10 = chain.recipe.series[0].diameter;
  std::string out = fmt::format(
      "\n## `{}`, {} spheres seen to rebound per drop height\n\n{} passages.\n\n"
      "| from the events | points | captured | e - truth below 0.7 m/s | and above | C_H [s/m] | "
      "C_A "
      "[s/m] | V* at d10 [m/s] | rms of e |\n|---|---|---|---|---|---|---|---|---|\n"
      "| *the truth of the recipe* | | | | | {:g} | {:g} | {:.3f} | |\n",
      id, times * chain.recipe.noise.events, chain.table.events.size(), truth.C_H, truth.C_A,
      true_capture_velocity(chain.recipe.truth, d10));
  out += row(chain, {"all corrections, four size classes"}, edges);
  out += row(chain, {"without the correction from the plane to the surface", true}, edges);
  out += row(chain, {"second and further impacts left in", false, true}, edges);
  out += row(chain, {"captured spheres not counted", false, false, true}, edges);
  out += row(chain, {"all sizes in one point", false, false, false, true}, edges);
  out += row(chain,
             {"all sizes in one point, captured not counted (as the paper's points)", false, false,
              true, true},
             edges);
  return out;
}

}  // namespace

int main() {
  fmt::print(
      "# From events to parameters, and what each correction does\n\n"
      "The recipes of the two steel reconstructions say what the instrument would have recorded "
      "(`[passages]`); `recoil pair`\nturns that into points, and the shipped fit is run on them. "
      "**Nothing here was measured**: the truth is the recipe's, so\nthe tables show what the "
      "chain "
      "does to it. The shipped points.csv are made from the same truth without these steps.\n\n"
      "- Errors are one standard error of the fit. Near capture only C_A + 2 C_H is determined "
      "well "
      "(truth: 0.035 s/m).\n"
      "- *e - truth*: mean over the rebounds of each point's e less the truth at its mean size and "
      "velocity. One rebound scatters\n  by 10 %, so of 14 x 40 the mean is uncertain by 0.004, of "
      "14 x 800 by 0.001.\n"
      "- *captured*: spheres that the points call captured; *V\\**: capture velocity.\n");
  const std::vector<double> small = {20e-6, 35e-6, 50e-6, 70e-6, 110e-6};
  const std::vector<double> large = {60e-6, 70e-6, 80e-6, 90e-6, 125e-6};
  for (const int times : {1, 20}) {
    fmt::print("{}", chapter("li1999-sst65-silicon", small, times));
    fmt::print("{}", chapter("li1999-sst125-silicon", large, times));
  }
  fmt::print(
      "\nMade by `build/release/tests/experiment/event_chain > reports/event-chain.md`; the events "
      "themselves by\n`recoil reconstruct datasets/li1999-sst65-silicon --passages events.csv`.\n");
}
