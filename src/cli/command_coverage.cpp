#include <fmt/format.h>

#include <memory>
#include <optional>

#include "analysis/analysis.hpp"
#include "cli/commands.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "core/statistics.hpp"
#include "coverage/coverage_truth.hpp"
#include "coverage/posterior_check.hpp"
#include "document/terminal.hpp"
#include "report/result_json.hpp"
#include "report/words_dataset.hpp"
#include "report/words_fit.hpp"
#include "uncertainty/bootstrap.hpp"

namespace recoil {
namespace {

/// The inputs of the simulation.
struct Prepared {
  FitSpec spec;
  std::vector<Dataset> datasets;
  CoverageOptions coverage;
  CoverageTruth truth;
  std::optional<PosteriorStudy> posterior;  ///< instead of `truth`
  Origin origin;                            ///< identifies kept rows and parts
};

/// @returns a pointer, because `truth` may refer to `spec`
std::unique_ptr<Prepared> prepare(const GivenOptions& given, const ShardOfCommand& shard) {
  auto ready = std::make_unique<Prepared>();
  FitInputs inputs = load_inputs(given.text("FIT"));
  ready->spec = std::move(inputs.spec);
  ready->datasets = std::move(inputs.datasets);
  CoverageOptions& coverage = ready->coverage;
  coverage.datasets = static_cast<int>(given.whole("--datasets"));
  coverage.uncertainty = uncertainty_options(ready->spec, analysis_options(given));
  require_scheme(ready->spec, coverage.uncertainty.scheme, gather(ready->datasets));
  std::string digits;
  if (given.has("--posterior")) {
    ready->posterior = posterior_study(ready->spec, ready->datasets, coverage.uncertainty);
    digits = digits_of(*ready->posterior->fitted);
  } else {
    ready->truth = coverage_truth(ready->spec, ready->datasets, coverage.uncertainty.seed);
    digits = digits_of(ready->truth);
  }
  ready->origin = shard.origin(ready->spec, ready->datasets, coverage.uncertainty.seed,
                               static_cast<std::size_t>(coverage.datasets), digits);
  return ready;
}

/// "95.0 % [92.1, 97.0]": a share with its `share_limits`.
std::string percentage(int part, int whole) {
  if (whole == 0) return "-";
  const ShareLimits limits = share_limits(part, whole);
  return fmt::format("{:.1f} % [{:.1f}, {:.1f}]", 100.0 * part / whole, 100.0 * limits.lower,
                     100.0 * limits.upper);
}

/// The coverage of one fit as a Markdown table, with a description of the simulation.
std::string coverage_markdown(const CoverageResult& result, const FitSpec& spec,
                              const CoverageOptions& options) {
  std::string text = fmt::format(
      "## Coverage of the intervals of `{}`\n\n{} data sets; {}. Level {:.0f} %, {} bootstrap "
      "replicates each, seed {}. {} fits and {} refits failed. In square brackets: the 95 % limits "
      "of each share (Wilson).\n\n",
      spec.id, result.datasets,
      result.truth_origin == TruthOrigin::recipe
          ? "truth and noise from the recipe, with a different seed for each"
          : "the fit's own estimate as truth, simulated independently of the fitter",
      100.0 * options.uncertainty.level, options.uncertainty.replicates, options.uncertainty.seed,
      result.failed, result.refits_failed);
  text +=
      "| parameter | truth | called well determined | interval | contains the truth | where well "
      "determined | median width |\n|---|---|---|---|---|---|---|\n";
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

/// The same for a terminal, without what was not made.
std::string coverage_text(const CoverageResult& result, const FitSpec& spec,
                          const CoverageOptions& options) {
  Table table;
  table.columns = {{"quantity"},           {"truth"},
                   {"well determined"},    {"interval", "", true},
                   {"contains the truth"}, {"median width"}};
  for (const CoverageRow& row : result.rows) {
    for (const CoverageCell& cell : row.cells) {
      if (cell.offered == 0) continue;
      table.rows.push_back({Sentence(fmt::format("{} [{}]", row.parameter, row.unit)),
                            Number{row.truth, significant(4)},
                            say("{} of {}", row.identifiable, result.datasets),
                            Sentence(cell.interval), Sentence(percentage(cell.held, cell.offered)),
                            Number{cell.median_width, significant(3)}});
    }
  }
  const std::string head = fmt::format(
      "{} data sets like {}; {}. Level {:.0f} %, {} replicates each, seed {}. {} fits and {} "
      "refits "
      "failed. In brackets: 95 % limits of each share (Wilson).",
      result.datasets, spec.id,
      result.truth_origin == TruthOrigin::recipe ? "truth and noise from the recipe"
                                                 : "the truth is the fit's own estimate",
      100.0 * options.uncertainty.level, options.uncertainty.replicates, options.uncertainty.seed,
      result.failed, result.refits_failed);
  return wrap(head, terminal_columns, 2) + "\n" + terminal_text(table, 0);
}

/// The columns of the posterior check, with `row` for each parameter.
template <class Row>
std::string posterior_rows(const PosteriorCheck& check, const Row& row) {
  std::string text;
  for (const RankedParameter& one : check.parameters) {
    text += row(
        one.parameter, fmt::format("{:.3g}", one.p_value),
        fmt::format("{:.2f} [{:.2f}, {:.2f}]", one.error_ratio, one.ratio_lower, one.ratio_upper),
        fmt::format("{:+.2f} +/- {:.2f}", one.shift, one.shift_sd),
        percentage(one.held, check.sets));
  }
  return text;
}

std::string posterior_markdown(const std::string& answer, const PosteriorCheck& check) {
  return fmt::format(
             "{}\n\n| parameter | p | too narrow by a factor of | shift [sd] | 90 % intervals that "
             "contain the truth |\n|---|---|---|---|---|\n",
             answer) +
         posterior_rows(check, [](const auto&... cells) {
           return fmt::format("| {} | {} | {} | {} | {} |\n", cells...);
         });
}

std::string posterior_text(const std::string& answer, const PosteriorCheck& check) {
  const auto line = [](const auto&... cells) {
    return fmt::format("{:12} {:>8}  {:>18}  {:>14}  {}\n", cells...);
  };
  std::string text = wrap(answer, terminal_columns, 2) + "\n";
  if (check.parameters.empty()) return text;
  return text + "\n" +
         line("parameter", "p", "too narrow by", "shift [sd]", "90 % intervals hold") +
         posterior_rows(check, line);
}

Pieces pieces_of(const Prepared& ready) {
  return {"coverage", ready.origin.pieces, ready.coverage.uncertainty.threads,
          [&ready](std::size_t i) {
            if (ready.posterior) return as_json(repeat_measurement(*ready.posterior, i));
            return as_json(run_coverage_trial(ready.spec, ready.truth, ready.coverage, i),
                           NonFinite::word);
          }};
}

template <class Trial>
std::vector<Trial> trials_of(const KeptRows& kept, std::size_t count) {
  std::vector<Trial> trials;
  for (std::size_t i = 0; i < count; ++i) {
    trials.push_back(value_from<Trial>(kept.find(i).value_or(Json())));
  }
  return trials;
}

void run_coverage(const GivenOptions& given) {
  const ShardOfCommand shard(given);
  const std::string out = given.text("--out");
  if (shard.one_of_several()) {
    shard.require_share(static_cast<std::size_t>(given.whole("--datasets")));
  } else if (!out.empty()) {
    require_writable_folder(std::filesystem::absolute(out).parent_path());
  }
  const std::unique_ptr<Prepared> ready = prepare(given, shard);
  std::optional<Claim> claim;
  if (!shard.one_of_several() && !out.empty()) {
    require_free({out});
    claim.emplace(out);
  }
  const std::shared_ptr<KeptRows> kept = shard.rows(ready->origin, out);
  if (!kept) return;
  const Pieces pieces = pieces_of(*ready);
  if (shard.one_of_several()) {
    shard.run_share(pieces, *kept, ready->origin);
    return;
  }
  resumable(pieces, *kept);
  std::string text, printed;
  if (ready->posterior) {
    const PosteriorCheck check = counted_rows(*kept, [&] {
      return judge_posterior(*ready->posterior, trials_of<PosteriorTrial>(*kept, pieces.count));
    });
    const std::string answer = plain_text(posterior_check_words(*ready->posterior, check));
    text = posterior_markdown(answer, check);
    printed = given.has("--json")
                  ? posterior_check_json(*ready->posterior, check, ready->spec, ready->coverage)
                  : posterior_text(answer, check);
  } else {
    const CoverageResult result = counted_rows(*kept, [&] {
      return count_coverage(ready->spec, ready->truth, ready->coverage,
                            trials_of<CoverageTrial>(*kept, pieces.count));
    });
    text = coverage_markdown(result, ready->spec, ready->coverage);
    printed = given.has("--json")
                  ? coverage_json(result, ready->spec, ready->coverage, ready->datasets)
                  : coverage_text(result, ready->spec, ready->coverage);
  }
  for (const Dataset& dataset : ready->datasets) {
    text += fmt::format("\n`{}`: {}\n", dataset.id, provenance_sentence(dataset.provenance));
  }
  if (!out.empty()) {
    write_or_print({{out, text}}, printed);
    kept->forget();
  }
  print_text("{}", printed);
}

}  // namespace

void add_coverage(Program& program) {
  program.command("coverage", "measure how often the intervals contain the truth", R"(
Simulates data sets of the same design with the fitted values as the truth, fits each of them,
and counts how often the intervals contain the truth. With --out it also writes a table in
Markdown, and Ctrl-C keeps finished work: the same command then continues.

  recoil coverage fits/dahneke1975-quartz.toml --datasets 100 --out coverage.md

With --posterior it says whether the posterior can be believed for these points: it repeats the
measurement at draws of the posterior, and ranks them among the draws of the posterior given both.

The study program covers grids of designs and several fits: ./run study, or
recoil_study --help.)",
                  run_coverage);
}

}  // namespace recoil
