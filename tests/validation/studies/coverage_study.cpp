#include "validation/studies/coverage_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/json.hpp"
#include "validation/studies/independent_coverage.hpp"

namespace recoil {
namespace {

template <class T>
Json json_of(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

template <class T>
std::optional<T> optional_at(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || found->is_null()) return std::nullopt;
  return found->get<T>();
}

std::optional<double> ratio(const std::optional<int>& part, const std::optional<int>& whole) {
  if (!part || !whole || *whole == 0) return std::nullopt;
  return static_cast<double>(*part) / *whole;
}

Json json_of(const ParameterCoverage& row) {
  Json intervals = Json::object();
  for (const IntervalCoverage& at : row.intervals) {
    Json& own = intervals[at.interval];
    if (!at.offered) {
      own = {{"share", json_of(at.stated_share)}, {"relative_width", json_of(at.relative_width)}};
      continue;
    }
    own = {{"offered", *at.offered},
           {"contained", json_of(at.contained)},
           {"offered_identifiable", json_of(at.offered_identifiable)},
           {"contained_identifiable", json_of(at.contained_identifiable)},
           {"relative_width", json_of(at.relative_width)}};
  }
  return {{"design", row.design},
          {"parameter", row.parameter},
          {"unit", row.unit},
          {"truth", json_of(row.truth)},
          {"usable", row.usable},
          {"identifiable", row.identifiable},
          {"relative_width", json_of(row.relative_width)},
          {"actual_error", json_of(row.actual_error)},
          {"intervals", intervals}};
}

ParameterCoverage row_of(const Json& json) {
  ParameterCoverage row;
  row.design = json.at("design");
  row.parameter = json.at("parameter");
  row.unit = json.at("unit");
  row.truth = optional_at<double>(json, "truth");
  row.usable = json.at("usable");
  row.identifiable = json.at("identifiable");
  row.relative_width = optional_at<double>(json, "relative_width");
  row.actual_error = optional_at<double>(json, "actual_error");
  for (const auto& [name, own] : json.at("intervals").items()) {
    row.intervals.push_back(
        {name, optional_at<int>(own, "offered"), optional_at<int>(own, "contained"),
         optional_at<int>(own, "offered_identifiable"),
         optional_at<int>(own, "contained_identifiable"), optional_at<double>(own, "share"),
         optional_at<double>(own, "relative_width")});
  }
  if (row.find("recommended") == nullptr) {
    throw std::invalid_argument(row.design + ", " + row.parameter + ": no recommended interval");
  }
  return row;
}

template <class Enum>
Enum enum_at(const Json& json, const char* key) {
  const std::string name = json.at(key);
  const std::optional<Enum> value = value_named<Enum>(name);
  if (!value) throw std::invalid_argument(fmt::format("{}: '{}' is unknown", key, name));
  return *value;
}

Provenance provenance_at(const Json& json, const char* key) {
  const std::string name = json.at(key);
  for (const Provenance provenance : {Provenance::measured, Provenance::digitised,
                                      Provenance::reconstruction, Provenance::synthetic}) {
    if (to_string(provenance) == name) return provenance;
  }
  throw std::invalid_argument(fmt::format("{}: '{}' is unknown", key, name));
}

// ---- measuring -------------------------------------------------------------------------------

Json kept_json(const CoverageResult& result) {
  Json rows = Json::array();
  for (const CoverageRow& row : result.rows) {
    Json cells = Json::array();
    for (const CoverageCell& c : row.cells) {
      cells.push_back({c.interval, c.offered, c.held, c.offered_identifiable, c.held_identifiable,
                       c.median_width});
    }
    rows.push_back({row.parameter, row.unit, row.truth, row.identifiable, row.actual_error, cells});
  }
  return {{"datasets", result.datasets},
          {"failed", result.failed},
          {"refits_failed", result.refits_failed},
          {"truth", name_of(result.truth_origin)},
          {"rows", rows}};
}

CoverageResult kept_result(const Json& json) {
  CoverageResult result;
  result.datasets = json.at("datasets");
  result.failed = json.at("failed");
  result.refits_failed = json.at("refits_failed");
  result.truth_origin = enum_at<TruthOrigin>(json, "truth");
  for (const Json& r : json.at("rows")) {
    CoverageRow row{r[0], r[1], r[2], r[3], r[4], {}};
    for (const Json& c : r[5]) row.cells.push_back({c[0], c[1], c[2], c[3], c[4], c[5]});
    result.rows.push_back(std::move(row));
  }
  return result;
}

/// The result kept under `key`, or `measure` and keep it.
template <class Measure>
CoverageResult kept_or_measured(const std::filesystem::path& folder, const std::string& key,
                                const Measure& measure) {
  if (folder.empty()) return measure();
  const std::filesystem::path file = folder / (sha256_hex(key).substr(0, 16) + ".json");
  if (std::filesystem::exists(file)) return kept_result(Json::parse(read_text_file(file)));
  CoverageResult result = measure();
  std::filesystem::create_directories(folder);
  write_whole_file(file, kept_json(result).dump() + "\n");
  return result;
}

std::string key_of(const FitSpec& spec, const CoverageOptions& options) {
  return fmt::format("{} {} {} {} {} {} {}", spec.sha256, options.datasets,
                     options.uncertainty.replicates, options.uncertainty.seed,
                     options.uncertainty.level, options.uncertainty.posterior,
                     spec.uncertainty.materials);
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
    ParameterCoverage row{design,
                          from.parameter,
                          from.unit,
                          from.truth,
                          result.datasets - result.failed,
                          from.identifiable,
                          {},
                          from.actual_error,
                          {}};
    for (const CoverageCell& cell : from.cells) {
      // A method that no data set was asked for has no column.
      if (cell.offered == 0 && cell.interval == "posterior") {
        continue;
      }
      std::optional<double> width;
      if (from.truth > 0.0 && cell.offered > 0 && std::isfinite(cell.median_width)) {
        width = cell.median_width / from.truth;
      }
      row.intervals.push_back({cell.interval, cell.offered, cell.held, cell.offered_identifiable,
                               cell.held_identifiable, std::nullopt, width});
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

std::optional<double> IntervalCoverage::share() const {
  return offered ? ratio(contained, offered) : stated_share;
}

std::optional<double> IntervalCoverage::share_identifiable() const {
  return ratio(contained_identifiable, offered_identifiable);
}

const IntervalCoverage* ParameterCoverage::find(std::string_view interval) const {
  for (const IntervalCoverage& at : intervals) {
    if (at.interval == interval) return &at;
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

std::string coverage_study_json(const CoverageStudy& study) {
  Json json = json_of(study.stamp);
  if (!study.grid_of.empty()) json["grid_of"] = study.grid_of;
  json["exact_materials"] = study.exact_materials;
  json["datasets"] = study.datasets;
  json["replicates"] = study.replicates;
  json["seed"] = study.seed;
  json["level"] = study.level;
  json["designs"] = Json::array();
  for (const CoverageStudy::Design& design : study.designs) {
    json["designs"].push_back({{"id", design.id},
                               {"truth", name_of(design.truth)},
                               {"fits_failed", json_of(design.fits_failed)},
                               {"refits_failed", json_of(design.refits_failed)}});
  }
  json["sources"] = Json::array();
  for (const CoverageStudy::Source& source : study.sources) {
    json["sources"].push_back({{"id", source.id}, {"provenance", to_string(source.provenance)}});
  }
  json["rows"] = Json::array();
  for (const ParameterCoverage& row : study.rows) json["rows"].push_back(json_of(row));
  return json.dump(1) + "\n";
}

CoverageStudy read_coverage_study(const std::filesystem::path& file) {
  try {
    const Json json = Json::parse(read_text_file(file));
    CoverageStudy study;
    study.stamp = stamp_of(json);
    study.grid_of = json.value("grid_of", std::string());
    // Before it was said, all constants were exact.
    study.exact_materials = json.value("exact_materials", true);
    study.datasets = json.at("datasets");
    study.replicates = json.at("replicates");
    study.seed = json.at("seed");
    study.level = json.at("level");
    for (const Json& design : json.at("designs")) {
      study.designs.push_back({design.at("id"), enum_at<TruthOrigin>(design, "truth"),
                               optional_at<int>(design, "fits_failed"),
                               optional_at<int>(design, "refits_failed")});
    }
    for (const Json& source : json.at("sources")) {
      study.sources.push_back({source.at("id"), provenance_at(source, "provenance")});
    }
    for (const Json& row : json.at("rows")) study.rows.push_back(row_of(row));
    return study;
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& problem) {
    throw InputError({file.string()}, "this is no study of coverage", problem.what(),
                     "let ./run study write it again");
  }
}

CoverageStudy measure_grid(const FitSpec& spec, const Dataset& base,
                           const std::vector<GridDesign>& designs, const CoverageOptions& options,
                           const std::filesystem::path& kept) {
  CoverageStudy study;
  set_options(study, options);
  study.grid_of = spec.id;
  study.exact_materials = true;  // see `grid_spec`
  add_source(study, base);
  for (const GridDesign& design : designs) {
    const std::string key =
        fmt::format("{} {} {}", design.name(), key_of(spec, options), base.sha256);
    add_result(study, design.name(), kept_or_measured(kept, key, [&] {
                 const FitSpec own = grid_spec(spec, design);
                 return measure_coverage(
                     own, grid_truth(own, base, design, options.uncertainty.seed), options);
               }));
  }
  return study;
}

void add_design(CoverageStudy& study, const FitSpec& spec, const std::vector<Dataset>& datasets,
                const CoverageOptions& options, const std::filesystem::path& kept) {
  set_options(study, options);
  study.exact_materials = !spec.uncertainty.materials;
  std::string key = key_of(spec, options);
  for (const Dataset& dataset : datasets) {
    key += " " + dataset.sha256;
    add_source(study, dataset);
  }
  add_result(study, spec.id, kept_or_measured(kept, key, [&] {
               return measure_coverage(
                   spec, independent_truth(spec, datasets, options.uncertainty.seed), options);
             }));
}

}  // namespace recoil
