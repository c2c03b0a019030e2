#include "validation/studies/coverage_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/json.hpp"
#include "uncertainty/identifiability.hpp"
#include "validation/studies/independent_coverage.hpp"

namespace recoil {
namespace {

std::optional<double> ratio(int part, int whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / whole;
}

/// The result kept under `key`, or `measure` and keep it.
CoverageResult kept_or_measured(const std::filesystem::path& folder, const std::string& key,
                                const std::function<CoverageResult()>& measure) {
  if (folder.empty()) return measure();
  const std::filesystem::path file = folder / (sha256_hex(key).substr(0, 16) + ".json");
  if (std::filesystem::exists(file)) {
    return value_from<CoverageResult>(Json::parse(read_text_file(file)));
  }
  CoverageResult result = measure();
  std::filesystem::create_directories(folder);
  write_whole_file(file, json_text(as_json(result, NonFinite::word)), Replacing::data);
  return result;
}

std::string key_of(const FitSpec& spec, const CoverageOptions& options) {
  return fmt::format("{} {} {} {} {} {}", spec.sha256, options.datasets,
                     options.uncertainty.replicates, options.uncertainty.seed,
                     options.uncertainty.level, static_cast<int>(spec.uncertainty.materials));
}

void set_options(CoverageStudy& study, const CoverageOptions& options) {
  study.datasets = options.datasets;
  study.replicates = options.uncertainty.replicates;
  study.seed = options.uncertainty.seed;
  study.level = options.uncertainty.level;
}

void add_result(CoverageStudy& study, const std::string& design, const CoverageResult& result) {
  study.designs.push_back({design, result.truth_origin, result.failed, result.refits_failed});
  for (const CoverageRow& from : result.rows) {
    ParameterCoverage row;
    row.design = design;
    row.parameter = from.parameter;
    row.unit = from.unit;
    row.truth = from.truth;
    row.usable = result.datasets - result.failed;
    row.identifiable = from.identifiable;
    row.actual_error = from.actual_error;
    for (const CoverageCell& cell : from.cells) {
      if (cell.interval == "posterior") continue;  // not sampled
      std::optional<double> width;
      if (from.truth > 0.0 && cell.offered > 0 && std::isfinite(cell.median_width)) {
        width = cell.median_width / from.truth;
      }
      row.intervals.push_back(
          {cell.interval,
           {cell.offered, cell.held, cell.offered_identifiable, cell.held_identifiable, width}});
      if (cell.interval == "recommended") row.relative_width = width;
    }
    study.rows.push_back(std::move(row));
  }
}

void add_source(CoverageStudy& study, const Dataset& dataset) {
  const auto same = [&](const CoverageStudy::Source& source) { return source.id == dataset.id; };
  if (std::none_of(study.sources.begin(), study.sources.end(), same)) {
    study.sources.push_back({dataset.id, dataset.provenance});
  }
}

}  // namespace

std::optional<double> IntervalCoverage::share() const { return ratio(contained, offered); }

std::optional<double> IntervalCoverage::share_identifiable() const {
  return ratio(contained_identifiable, offered_identifiable);
}

const IntervalCoverage* ParameterCoverage::find(std::string_view interval) const {
  for (const auto& [name, at] : intervals) {
    if (name == interval) return &at;
  }
  return nullptr;
}

const IntervalCoverage& ParameterCoverage::recommended() const { return *find("recommended"); }

double ParameterCoverage::share_identifiable() const {
  return usable == 0 ? 0.0 : static_cast<double>(identifiable) / usable;
}

CoverageVerdict verdict_of(const ParameterCoverage& row) {
  const auto nominal = [](double share) { return least_nominal <= share && share <= most_nominal; };
  const double share = row.recommended().share().value_or(0.0);
  if (1.0 - row.share_identifiable() >= least_warned) {
    return nominal(share) ? CoverageVerdict::nominal_warned : CoverageVerdict::warned;
  }
  if (nominal(share)) return CoverageVerdict::nominal;
  return share < least_nominal ? CoverageVerdict::too_narrow : CoverageVerdict::too_wide;
}

bool scatters_too_much(const ParameterCoverage& row) {
  return !row.parameter.starts_with("V*") && row.actual_error.value_or(0.0) > widest_error;
}

bool misleads(const ParameterCoverage& row) {
  return scatters_too_much(row) && row.share_identifiable() > most_misled;
}

CoverageStudy read_coverage_study(const std::filesystem::path& file) {
  CoverageStudy study = read_study<CoverageStudy>(file, "study of coverage", "rows");
  for (const ParameterCoverage& row : study.rows) {
    if (row.find("recommended") != nullptr) continue;
    throw InputError({file.string()}, "this is no study of coverage",
                     row.design + ", " + row.parameter + ": no recommended interval",
                     "let ./run study write it again");
  }
  return study;
}

void add_measured(CoverageStudy& study, const std::string& design, const CoverageOptions& options,
                  const std::filesystem::path& kept, const std::string& key,
                  const std::function<CoverageResult()>& measure) {
  set_options(study, options);
  add_result(study, design, kept_or_measured(kept, key, measure));
}

CoverageStudy measure_grid(const FitSpec& spec, const Dataset& base,
                           const std::vector<GridDesign>& designs, const CoverageOptions& options,
                           const std::filesystem::path& kept) {
  CoverageStudy study;
  study.grid_of = spec.id;
  study.exact_materials = true;  // see `grid_spec`
  add_source(study, base);
  for (const GridDesign& design : designs) {
    const std::string key =
        fmt::format("{} {} {}", design.name(), key_of(spec, options), base.sha256);
    add_measured(study, design.name(), options, kept, key, [&] {
      const FitSpec own = grid_spec(spec, design);
      return measure_coverage(own, grid_truth(own, base, design, options.uncertainty.seed),
                              options);
    });
  }
  return study;
}

void add_design(CoverageStudy& study, const FitSpec& spec, const std::vector<Dataset>& datasets,
                const CoverageOptions& options, const std::filesystem::path& kept) {
  study.exact_materials = spec.uncertainty.materials == Materials::exact;
  std::string key = key_of(spec, options);
  for (const Dataset& dataset : datasets) {
    key += " " + dataset.sha256;
    add_source(study, dataset);
  }
  add_measured(study, spec.id, options, kept, key, [&] {
    return measure_coverage(spec, independent_truth(spec, datasets, options.uncertainty.seed),
                            options);
  });
}

}  // namespace recoil
