#include "cli/coverage_words.hpp"

#include <fmt/format.h>

#include "core/statistics.hpp"

namespace recoil {
namespace {

/// "95.0 % [92.1, 97.0]": the share with `share_limits`.
std::string percentage(int part, int whole) {
  if (whole == 0) return "-";
  const ShareLimits limits = share_limits(part, whole);
  return fmt::format("{:.1f} % [{:.1f}, {:.1f}]", 100.0 * part / whole, 100.0 * limits.lower,
                     100.0 * limits.upper);
}

std::string truth_words(TruthOrigin origin) {
  return origin == TruthOrigin::recipe
             ? "truth and noise from the recipe, another seed for each"
             : "the fit's own estimate as truth, simulated independently of the fitter";
}

}  // namespace

std::string coverage_markdown(const CoverageResult& result, const FitSpec& spec,
                              const CoverageOptions& options) {
  std::string text = fmt::format(
      "## Coverage of the intervals of `{}`\n\n{} data sets; {}. Level {:.0f} %, {} bootstrap "
      "replicates each, seed {}. {} fits and {} refits failed. In square brackets: "
      "the 95 % limits of each share (Wilson).\n\n",
      spec.id, result.datasets, truth_words(result.truth_origin), 100.0 * options.uncertainty.level,
      options.uncertainty.replicates, options.uncertainty.seed, result.failed,
      result.refits_failed);
  text +=
      "| parameter | truth | called identifiable | interval | contains the truth | where "
      "identifiable "
      "| median width |\n|---|---|---|---|---|---|---|\n";
  for (const CoverageRow& row : result.rows) {
    for (const CoverageCell& cell : row.cells) {
      text += fmt::format("| {} [{}] | {:.4g} | {} of {} | {} | {} | {} ({} of {}) | {:.3g} |\n",
                          row.parameter, row.unit, row.truth, row.identifiable, result.datasets,
                          cell.interval, percentage(cell.held, cell.offered),
                          percentage(cell.held_identifiable, cell.offered_identifiable),
                          cell.held_identifiable, cell.offered_identifiable, cell.median_width);
    }
  }
  return text;
}

}  // namespace recoil
