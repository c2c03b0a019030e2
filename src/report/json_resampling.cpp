// What the resampling says about itself in fit.json: chance, bounds, failures.
#include "report/json_resampling.hpp"

#include "core/units.hpp"
#include "report/format.hpp"
#include "report/json_values.hpp"
#include "report/words_intervals.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_listed = 100;  // failed replicates by their index

}  // namespace

Json mc_error_json(const Interval& interval) {
  if (!interval.available() || !interval.lower_error || !interval.upper_error) return nullptr;
  return Json::array(
      {number_or_null(*interval.lower_error), number_or_null(*interval.upper_error)});
}

void put_resampling(Json& parameter, const Analysis& analysis, std::size_t slot) {
  const IntervalSet set = intervals_of(analysis, slot);
  const Sentence label = symbol(analysis.fitted.model.slots[slot].label());
  Json errors = Json::object();
  Json notes = Json::object();
  for (const IntervalKind kind : values_of<IntervalKind>()) {
    errors[to_string(kind)] = mc_error_json(set[kind]);
    if (set[kind].note) notes[to_string(kind)] = plain_text(note_words(set[kind], label));
  }
  parameter["intervals_mc_error"] = errors;
  parameter["intervals_note"] = notes;
  parameter["intervals_differ"] =
      set.disagreement ? Json(plain_text(disagreement_words(analysis.fitted, slot, set)))
                       : Json(nullptr);
  parameter["bca_constants"] = nullptr;
  if (set.bca_constants) {
    parameter["bca_constants"] = {
        {"bias", number_or_null(set.bca_constants->bias)},
        {"acceleration", number_or_null(set.bca_constants->acceleration)}};
  }
  parameter["bound_share"] = set.bound_share ? number_or_null(*set.bound_share) : Json(nullptr);
}

Json failures_json(const BootstrapResult& bootstrap, const Observations& data) {
  const FailedReplicates& failures = bootstrap.failures;
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
  return {{"text", failures_words(bootstrap, data)},
          {"replicates", index},
          {"message", failure_message(failures)},
          {"suspects", suspects}};
}

}  // namespace recoil
