// The whole chain on the reconstructed experiment: events, pairing, points, fit, beside the truth
// that the recipe put there, and with each correction left out. Prints Markdown: ./run study
// event-chain.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

#include "report/corrections.hpp"
#include "studies/corrections.hpp"

namespace {

using namespace recoil;
namespace fs = std::filesystem;

std::string cell(const std::optional<double>& value) {
  return value ? fmt::format("{:+.4f}", *value) : "-";
}

std::string with_error(double value, double error) {
  return error > 0.0 ? fmt::format("{:.4f} +- {:.4f}", value, error)
                     : fmt::format("{:.4f} (bound)", value);
}

std::string row_text(const CorrectionRow& row) {
  std::string numbers = " no usable fit | | | |";
  if (row.usable) {
    numbers = fmt::format(" {} | {} | {:.3f} | {:.4f} |", with_error(row.C_H, row.C_H_sd),
                          with_error(row.C_A, row.C_A_sd), row.capture_velocity, row.rmse);
  }
  return fmt::format("| {} | {} | {} | {} | {} |{}\n", words_of(row.left_out), row.points,
                     row.captured, cell(row.error_slow), cell(row.error_fast), numbers);
}

struct Reconstruction {
  explicit Reconstruction(const std::string& id)
      : recipe(load_recipe(fs::path(RECOIL_SOURCE_DIR) / "datasets" / id)),
        dataset(load_dataset(recipe.folder)),
        spec(load_fit(fs::path(RECOIL_SOURCE_DIR) / "fits" / (id + ".toml"))) {}

  CorrectionStudy study(int times, std::size_t classes,
                        std::span<const Correction> ways = all_ways) const {
    AverageOptions averaging = recipe_averaging(recipe);
    averaging.per_bin = averaging.per_bin * static_cast<std::size_t>(times) / classes;
    averaging.size_classes = classes;
    averaging.mean_diameter = classes == 1;
    return study_corrections(spec, dataset, known_events(recipe, times), recipe_pairing(recipe),
                             averaging, ways);
  }

  Recipe recipe;
  Dataset dataset;
  FitSpec spec;
};

std::string chapter(const Reconstruction& of, int times, std::size_t classes) {
  const CorrectionStudy study = of.study(times, classes);
  std::string out = fmt::format(
      "\n## `{}`, {:g} spheres seen to rebound per drop height, {}\n\n{} passages.\n\n"
      "| from the events | points | captured | e - truth below {:g} m/s | and above | C_H [s/m] | "
      "C_A [s/m] | V* at d10 [m/s] | rms of e |\n|---|---|---|---|---|---|---|---|---|\n"
      "| *the truth of the recipe* | | | | | {:g} | {:g} | {:.3f} | |\n",
      of.recipe.id, study.rebounds_per_velocity,
      classes > 1 ? fmt::format("{} size classes", classes) : "all sizes in one point",
      study.passages, slow_impacts, study.C_H, study.C_A, study.capture_velocity);
  for (const CorrectionRow& row : study.rows) out += row_text(row);
  return out;
}

/// Mean and standard error over several streams.
class Mean {
 public:
  void add(double value) {
    sum_ += value;
    squares_ += value * value;
    ++count_;
  }
  std::string text(int decimals) const {
    const double mean = sum_ / count_;
    const double variance = std::max(squares_ / count_ - mean * mean, 0.0);
    return fmt::format("{:.{}f} +- {:.{}f}", mean, decimals, std::sqrt(variance / (count_ - 1)),
                       decimals);
  }

 private:
  double sum_ = 0.0;
  double squares_ = 0.0;
  int count_ = 0;
};

/// The row of all corrections with other random numbers than the recipe's.
std::string other_numbers(Reconstruction of, std::size_t classes) {
  constexpr std::array base = {Correction::none_left_out};
  constexpr int streams = 10;
  Mean below, above, C_H, C_A, capture;
  const std::string id = of.recipe.id;
  for (int k = 0; k < streams; ++k) {
    ++of.recipe.seed;
    const CorrectionRow row = of.study(20, classes, base).rows.front();
    if (!row.usable)
      return fmt::format("| `{}` | {} | a fit without an answer | | | | |\n", id, classes);
    below.add(row.error_slow.value_or(0.0));
    above.add(row.error_fast.value_or(0.0));
    C_H.add(row.C_H);
    C_A.add(row.C_A);
    capture.add(row.capture_velocity);
  }
  return fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n", id, classes, below.text(5),
                     above.text(5), C_H.text(5), C_A.text(5), capture.text(4));
}

}  // namespace

int main() {
  fmt::print(
      "# From events to parameters, and what each correction does\n\n"
      "The recipes of the two steel reconstructions say what the instrument would have recorded "
      "(`[passages]`); `recoil pair`\nturns that into points, and the shipped fit is run on them. "
      "**Nothing here was measured**: the truth is the recipe's, so\nthe tables show what the "
      "chain does to it. The shipped points.csv are those of 40 spheres per drop height, all sizes "
      "in\none point, all corrections.\n\n"
      "- Errors are one standard error of the fit. Near capture only C_A + 2 C_H is determined "
      "well (truth: 0.035 s/m).\n"
      "- *e - truth*: mean over the rebounds of each point's e less the truth at its mean size and "
      "velocity. One rebound scatters\n  by 10 %, so of 14 x 40 the mean is uncertain by 0.004, of "
      "14 x 800 by 0.001; rows of one table share their events.\n"
      "- *captured*: spheres that the points call captured; *V\\**: capture velocity.\n");
  const Reconstruction fine("li1999-sst65-silicon");
  const Reconstruction coarse("li1999-sst125-silicon");
  for (const Reconstruction* of : {&fine, &coarse}) {
    for (const std::size_t classes : {1UL, 4UL}) fmt::print("{}", chapter(*of, 1, classes));
    for (const std::size_t classes : {1UL, 4UL, 16UL}) fmt::print("{}", chapter(*of, 20, classes));
  }
  fmt::print(
      "\n## Other random numbers\n\n"
      "All corrections, 800 spheres per drop height, mean over ten other streams of events with "
      "its "
      "standard error. What is left\nhere is no chance of the tables above: what goes away with "
      "finer size classes is the mixture of sizes within a class\n(their mean e is not the e of "
      "their mean size, and the smallest are missing from it); what stays is the chain's own.\n\n"
      "| | size classes | e - truth below {:g} m/s | and above | C_H [s/m] | C_A [s/m] | V* at d10 "
      "[m/s] |\n|---|---|---|---|---|---|---|\n",
      slow_impacts);
  for (const Reconstruction* of : {&fine, &coarse}) {
    for (const std::size_t classes : {4UL, 16UL}) fmt::print("{}", other_numbers(*of, classes));
  }
  fmt::print(
      "\nThe truth: C_H = 0.005, C_A = 0.025 s/m. The events themselves: `recoil reconstruct "
      "datasets/li1999-sst65-silicon\n--passages events.csv`.\n");
}
