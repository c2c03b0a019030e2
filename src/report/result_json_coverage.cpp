#include "core/json.hpp"
#include "core/program.hpp"
#include "core/statistics.hpp"
#include "report/result_json.hpp"

namespace recoil {
namespace {

/// How many of how many, and the 95 % limits of the share (Wilson).
Json share_json(int part, int whole) {
  Json limits = nullptr;
  if (whole > 0) {
    const ShareLimits wilson = share_limits(part, whole);
    limits = {wilson.lower, wilson.upper};
  }
  return {{"held", part},
          {"offered", whole},
          {"share", whole > 0 ? Json(static_cast<double>(part) / whole) : Json(nullptr)},
          {"limits", limits}};
}

Json row_json(const CoverageRow& row) {
  Json intervals = Json::object();
  for (const CoverageCell& cell : row.cells) {
    Json entry = share_json(cell.held, cell.offered);
    entry["where_identifiable"] = share_json(cell.held_identifiable, cell.offered_identifiable);
    entry["median_width"] = number_or_null(cell.median_width);
    intervals[cell.interval] = std::move(entry);
  }
  return {{"parameter", row.parameter},
          {"unit", row.unit},
          {"truth", number_or_null(row.truth)},
          {"identifiable", row.identifiable},
          {"actual_error", number_or_null(row.actual_error)},
          {"intervals", intervals}};
}

}  // namespace

std::string coverage_json(const CoverageResult& result, const FitSpec& spec,
                          const CoverageOptions& options, const std::vector<Dataset>& datasets) {
  Json out;
  out["format_version"] = format_version;
  out["recoil_version"] = version();
  out["fit"] = {{"id", spec.id}, {"sha256", spec.sha256}};
  out["datasets"] = Json::array();
  for (const Dataset& dataset : datasets) {
    out["datasets"].push_back({{"id", dataset.id},
                               {"provenance", to_string(dataset.provenance)},
                               {"sha256", dataset.sha256}});
  }
  out["simulated"] = result.datasets;
  out["truth"] = to_string(result.truth_origin);
  out["level"] = options.uncertainty.level;
  out["replicates"] =
      options.uncertainty.replicates_auto ? Json("auto") : Json(options.uncertainty.replicates);
  out["seed"] = options.uncertainty.seed;
  out["failed"] = result.failed;
  out["refits_failed"] = result.refits_failed;
  out["rows"] = Json::array();
  for (const CoverageRow& row : result.rows) out["rows"].push_back(row_json(row));
  return json_text(out);
}

}  // namespace recoil
