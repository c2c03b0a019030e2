#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/files.hpp"
#include "coverage/coverage_truth.hpp"
#include "studies/coverage_grid.hpp"

namespace recoil {
namespace {

using Json = nlohmann::ordered_json;

// What the study asks of a 95 % interval, and of a verdict that warns instead.
constexpr double least_held = 0.93, most_held = 0.97;
constexpr double least_warned = 0.90;

// ---- kept results ----------------------------------------------------------------------------

Json to_json(const CoverageResult& result) {
  Json rows = Json::array();
  for (const CoverageRow& row : result.rows) {
    Json cells = Json::array();
    for (const CoverageCell& c : row.cells) {
      cells.push_back({c.interval, c.offered, c.held, c.offered_identifiable, c.held_identifiable,
                       c.median_width});
    }
    rows.push_back({row.parameter, row.unit, row.truth, row.identifiable, cells});
  }
  return {result.datasets, result.failed, result.refits_failed, result.truth_source, rows};
}

CoverageResult from_json(const Json& j) {
  CoverageResult result{j[0], j[1], j[2], j[3], {}};
  for (const Json& r : j[4]) {
    CoverageRow row{r[0], r[1], r[2], r[3], {}};
    for (const Json& c : r[4]) row.cells.push_back({c[0], c[1], c[2], c[3], c[4], c[5]});
    result.rows.push_back(std::move(row));
  }
  return result;
}

std::filesystem::path kept_file(const std::filesystem::path& folder, const std::string& key) {
  return folder / (sha256_hex(key).substr(0, 16) + ".json");
}

// ---- the table -------------------------------------------------------------------------------

const CoverageCell& cell_of(const CoverageRow& row, const std::string& interval) {
  const auto found = std::find_if(row.cells.begin(), row.cells.end(),
                                  [&](const CoverageCell& c) { return c.interval == interval; });
  return found != row.cells.end() ? *found : row.cells.front();
}

double share(int part, int whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// "holds", "warned", "TOO NARROW" or "TOO WIDE" of one parameter in one design.
std::string judgement(const CoverageRow& row, int usable) {
  const CoverageCell& recommended = cell_of(row, "recommended");
  const double identifiable = share(row.identifiable, usable);
  const auto within = [](double held) { return least_held <= held && held <= most_held; };
  const double held = share(recommended.held, recommended.offered);
  const double held_identifiable =
      share(recommended.held_identifiable, recommended.offered_identifiable);
  if (1.0 - identifiable >= least_warned) return within(held) ? "holds, warned" : "warned";
  if (within(held) && within(held_identifiable)) return "holds";
  return std::min(held, held_identifiable) < least_held ? "TOO NARROW" : "TOO WIDE";
}

std::string percent(int part, int whole) {
  return whole == 0 ? "-" : fmt::format("{:.1f}", 100.0 * share(part, whole));
}

/// Rows of several designs, and how many of them hold what is promised.
class CoverageTableWriter {
 public:
  void add(const std::string& design, const CoverageResult& coverage) {
    const int usable = coverage.datasets - coverage.failed;
    for (const CoverageRow& row : coverage.rows) {
      const CoverageCell& best = cell_of(row, "recommended");
      const std::string verdict = judgement(row, usable);
      ++rows_;
      held_ += verdict.starts_with("holds") ? 1 : 0;
      warned_ += verdict == "warned" ? 1 : 0;
      wide_ += verdict == "TOO WIDE" ? 1 : 0;
      table_ +=
          fmt::format("| {} | {} | {} | {} | {} | {} |", design, row.parameter,
                      percent(row.identifiable, usable), percent(usable - row.identifiable, usable),
                      percent(best.held, best.offered),
                      percent(best.held_identifiable, best.offered_identifiable));
      for (const char* kind : {"profile", "studentized", "bca", "percentile", "wald", "delta"}) {
        const auto found = std::find_if(row.cells.begin(), row.cells.end(),
                                        [&](const CoverageCell& c) { return c.interval == kind; });
        table_ += found == row.cells.end()
                      ? " |"
                      : fmt::format(" {} |", percent(found->held, found->offered));
      }
      table_ += fmt::format(
          " {} | {} |\n",
          row.truth > 0.0 ? fmt::format("{:.3g}", best.median_width / row.truth) : "-", verdict);
    }
  }

  std::string summary() const {
    return fmt::format(
        "**{} of {} rows hold** ({:.0f} to {:.0f} % of the data sets, and of those in which "
        "the verdict calls the parameter identifiable); in {} more the verdict warned in at "
        "least {:.0f} % of the data sets; {} miss both, {} of them because the interval holds "
        "the truth too often.\n\n",
        held_, rows_, 100.0 * least_held, 100.0 * most_held, warned_, 100.0 * least_warned,
        rows_ - held_ - warned_, wide_);
  }
  const std::string& table() const { return table_; }

 private:
  int rows_ = 0, held_ = 0, warned_ = 0, wide_ = 0;
  std::string table_ =
      "| design | parameter | identifiable, % | warned, % | recommended, % | where identifiable, % "
      "| profile | studentized | bca | percentile | wald | delta | width / truth | |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
};

std::string chance_words(const CoverageOptions& options) {
  return fmt::format("One standard error of a coverage of 95 % is {:.1f} %.",
                     100.0 * std::sqrt(0.95 * 0.05 / std::max(1, options.datasets)));
}

std::string key_words(const FitSpec& spec, const CoverageOptions& options) {
  return fmt::format("{} {} {} {} {}", spec.sha256, options.datasets,
                     options.uncertainty.replicates, options.uncertainty.seed,
                     options.uncertainty.level);
}

/// The result kept under `key`, or `measure` and keep it.
template <class Measure>
CoverageResult kept_or_measured(const std::filesystem::path& folder, const std::string& key,
                                const Measure& measure) {
  if (folder.empty()) return measure();
  const std::filesystem::path file = kept_file(folder, key);
  if (std::filesystem::exists(file)) return from_json(Json::parse(read_text_file(file)));
  CoverageResult result = measure();
  std::filesystem::create_directories(folder);
  write_whole_file(file, to_json(result).dump() + "\n");
  return result;
}

}  // namespace

std::vector<GridResult> measure_grid(const FitSpec& spec, const Dataset& base,
                                     const std::vector<GridDesign>& designs,
                                     const CoverageOptions& options,
                                     const std::filesystem::path& kept) {
  std::vector<GridResult> results;
  for (const GridDesign& design : designs) {
    const std::string key = fmt::format(
        "{} {} {} {} {} {} {}", design.name(), spec.sha256, base.sha256, options.datasets,
        options.uncertainty.replicates, options.uncertainty.seed, options.uncertainty.level);
    results.push_back({design, kept_or_measured(kept, key, [&] {
                         const FitSpec own = grid_spec(spec, design);
                         return measure_coverage(
                             own, grid_truth(own, base, design, options.uncertainty.seed), options);
                       })});
  }
  return results;
}

std::string grid_markdown(const std::vector<GridResult>& results, const FitSpec& spec,
                          const CoverageOptions& options) {
  CoverageTableWriter writer;
  for (const GridResult& result : results) writer.add(result.design.name(), result.coverage);
  return fmt::format(
             "## Coverage by kind of data: `{}`\n\n{} simulated data sets per design, {} bootstrap "
             "replicates each, seed {}, level {:.0f} %; {}. One diameter, n points evenly in log V "
             "from 1.05 (with captures 0.85) to 50 times the capture velocity. Scatter: equal "
             "(0.02), near-capture (0.01 far above capture, five times that at it), 10 % of e; its "
             "size is stated with the points or has to be estimated. {}\n\n",
             spec.id, options.datasets, options.uncertainty.replicates, options.uncertainty.seed,
             100.0 * options.uncertainty.level,
             results.empty() ? "" : results.front().coverage.truth_source, chance_words(options)) +
         writer.summary() + writer.table();
}

DesignResult measure_design(const FitSpec& spec, const std::vector<Dataset>& datasets,
                            const CoverageOptions& options, const std::filesystem::path& kept) {
  std::string key = key_words(spec, options);
  for (const Dataset& dataset : datasets) key += " " + dataset.sha256;
  return {spec.id, kept_or_measured(kept, key, [&] {
            return measure_coverage(spec, coverage_truth(spec, datasets, options.uncertainty.seed),
                                    options);
          })};
}

std::string designs_markdown(const std::vector<DesignResult>& results,
                             const CoverageOptions& options) {
  CoverageTableWriter writer;
  std::string sources;
  for (const DesignResult& result : results) {
    writer.add(result.id, result.coverage);
    sources += fmt::format("- `{}`: {}; {} fits and {} refits failed\n", result.id,
                           result.coverage.truth_source, result.coverage.failed,
                           result.coverage.refits_failed);
  }
  return fmt::format(
             "## Coverage for the designs of the fits\n\n{} simulated data sets per design, {} "
             "bootstrap replicates each, seed {}, level {:.0f} %. {}\n\n",
             options.datasets, options.uncertainty.replicates, options.uncertainty.seed,
             100.0 * options.uncertainty.level, chance_words(options)) +
         writer.summary() + sources + "\n" + writer.table();
}

}  // namespace recoil
