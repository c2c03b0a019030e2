// What the resampling says about itself in fit.json: chance, bounds, failures.
#include <array>

#include "core/units.hpp"
#include "report/json_values.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_listed = 100;  // failed replicates by their index

}  // namespace

Json mc_error_json(const Interval& interval) {
  if (!interval.available() || !interval.lower_error || !interval.upper_error) return nullptr;
  return Json::array(
      {number_or_null(*interval.lower_error), number_or_null(*interval.upper_error)});
}

void put_resampling(Json& parameter, const IntervalSet& set) {
  const std::array<std::pair<const char*, const Interval*>, 5> kinds = {
      {{"wald", &set.wald},
       {"profile", &set.profile},
       {"percentile", &set.percentile},
       {"bca", &set.bca},
       {"studentized", &set.studentized}}};
  Json errors = Json::object();
  Json notes = Json::object();
  for (const auto& [name, interval] : kinds) {
    errors[name] = mc_error_json(*interval);
    if (!interval->note.empty()) notes[name] = interval->note;
  }
  parameter["intervals_mc_error"] = errors;
  parameter["intervals_note"] = notes;
  parameter["intervals_differ"] = set.disagreement.empty() ? Json(nullptr) : Json(set.disagreement);
  parameter["bca_constants"] = nullptr;
  if (set.bca_constants) {
    parameter["bca_constants"] = {
        {"bias", number_or_null(set.bca_constants->bias)},
        {"acceleration", number_or_null(set.bca_constants->acceleration)}};
  }
  parameter["bound_share"] = set.bound_share ? number_or_null(*set.bound_share) : Json(nullptr);
}

Json failures_json(const FailedReplicates& failures, const Observations& data) {
  if (failures.index.empty()) return nullptr;
  Json index = Json::array();
  for (std::size_t k = 0; k < failures.index.size() && k < most_listed; ++k) {
    index.push_back(failures.index[k]);
  }
  Json suspects = Json::array();
  for (const FailedReplicates::Suspect& suspect : failures.suspects) {
    const Observation& point = data.points[suspect.point];
    suspects.push_back({{"point", suspect.point + 1},
                        {"incident_velocity", number_or_null(point.velocity)},
                        {"diameter_um", number_or_null(point.diameter / units::um)},
                        {"disturbance_when_failed", number_or_null(suspect.failed)},
                        {"disturbance_otherwise", number_or_null(suspect.usual)}});
  }
  return {{"text", failures.text},
          {"replicates", index},
          {"message", failures.message},
          {"suspects", suspects}};
}

}  // namespace recoil
