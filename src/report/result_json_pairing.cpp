#include <algorithm>

#include "core/json.hpp"
#include "core/program.hpp"
#include "core/units.hpp"
#include "report/result_json.hpp"

namespace recoil {
namespace {

Json passages_json(const PassageTable& table) {
  return {{"file", table.file},
          {"rows", table.rows},
          {"passages", table.passages.size()},
          {"damaged", table.damaged},
          {"repeated", table.duplicated},
          {"out_of_order", table.unsorted},
          {"columns_not_used", table.ignored},
          {"provenance",
           table.provenance ? Json(std::string(to_string(*table.provenance))) : Json(nullptr)}};
}

Json impacts_json(const PairingResult& pairs) {
  const auto used = std::count_if(pairs.impacts.begin(), pairs.impacts.end(),
                                  [](const Impact& impact) { return impact.used; });
  const auto later = std::count_if(pairs.impacts.begin(), pairs.impacts.end(),
                                   [](const Impact& impact) { return impact.number > 1; });
  return {{"down", pairs.down},
          {"up", pairs.up},
          {"pairs", pairs.impacts.size()},
          {"used", used},
          {"later", later},
          {"purity", number_or_null(pairs.purity())},
          {"returns", pairs.returns},
          {"expected_returns", number_or_null(pairs.expected_returns)}};
}

Json mean_json(const PointMean& point) {
  const bool rebounds = point.rebounds > 0;
  return {
      {"series", point.series},
      {"diameter_um", point.diameter / units::um},
      {"incident_velocity", point.velocity},
      {"velocity_sd", point.velocity_sd > 0.0 ? Json(point.velocity_sd) : Json(nullptr)},
      {"restitution", rebounds ? number_or_null(point.restitution) : Json(nullptr)},
      {"restitution_sd", point.restitution_sd > 0.0 ? Json(point.restitution_sd) : Json(nullptr)},
      {"rebounds", point.rebounds},
      {"unpaired", point.unpaired},
      {"captured", point.captured},
      {"events", point.events()}};
}

}  // namespace

std::string pairing_json(const PassageTable& table, const PairingResult& pairs,
                         const Averages& averages) {
  Json out;
  out["format_version"] = format_version;
  out["recoil_version"] = version();
  out["passages"] = passages_json(table);
  out["plane"] = {{"height_m", pairs.height},
                  {"height_sd_m", pairs.refined ? number_or_null(pairs.height_sd) : Json(nullptr)},
                  {"refined", pairs.refined}};
  out["impacts"] = impacts_json(pairs);
  out["without_rebound"] = {{"passages", averages.unpaired},
                            {"lost", number_or_null(averages.lost)},
                            {"too_slow", number_or_null(averages.too_slow)},
                            {"captured", averages.captured},
                            {"not_assigned", number_or_null(averages.unresolved)},
                            {"lost_share", number_or_null(averages.lost_share)}};
  out["points"] = Json::array();
  for (const PointMean& point : averages.points) out["points"].push_back(mean_json(point));
  return json_text(out);
}

}  // namespace recoil
