#include "report/plan_files.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/json.hpp"
#include "core/program.hpp"
#include "core/units.hpp"
#include "data/datapackage.hpp"
#include "report/format.hpp"

namespace recoil {
namespace {

Json count_or_null(const std::optional<double>& value) {
  return value ? Json(std::ceil(*value)) : Json(nullptr);
}

Json assumed_json(const ExperimentPlan& plan) {
  Json out;
  for (std::size_t j = 0; j < plan.theta.size(); ++j) {
    const ParameterSlot& slot = plan.model.slots[j];
    out[slot.label()] = {{"value", number_or_null(plan.theta[j])},
                         {"unit", slot.parameter->unit},
                         {"free", slot.free}};
  }
  return out;
}

Json place_json(const ExperimentPlan& plan, std::size_t dataset, double diameter, double velocity) {
  return {{"dataset", plan.datasets[dataset].id},
          {"diameter_um", diameter / units::um},
          {"incident_velocity", velocity}};
}

Json quantity_json(const ExperimentPlan& plan, const PlannedQuantity& quantity) {
  Json out;
  out["kind"] = to_string(quantity.kind);
  if (quantity.kind == PlannedKind::parameter) {
    out["parameter"] = quantity.label;
  } else {
    out["dataset"] = plan.datasets[quantity.dataset].id;
    out["diameter_um"] = quantity.diameter / units::um;
  }
  out["value"] = number_or_null(quantity.value);
  out["unit"] = quantity.unit;
  out["relative_error"] = number_or_null(quantity.error);
  out["relative_error_even"] = number_or_null(quantity.plain_error);
  out["impacts"] = count_or_null(quantity.impacts);
  out["impacts_even"] = count_or_null(quantity.plain_impacts);
  out["impacts_alone"] = count_or_null(quantity.alone_impacts);
  out["learnt_at"] = Json::array();
  for (const LearntAt& at : quantity.learnt_at) {
    Json place = place_json(plan, at.dataset, at.diameter, at.velocity);
    place["share"] = at.share;
    out["learnt_at"].push_back(std::move(place));
  }
  return out;
}

}  // namespace

std::string json_plan(const ExperimentPlan& plan) {
  const PlanOptions& options = plan.options;
  Json out;
  out["format_version"] = format_version;
  out["recoil_version"] = version();
  out["fit"] = plan.fit;
  out["datasets"] = Json::array();
  for (const Dataset& dataset : plan.datasets) {
    out["datasets"].push_back({{"id", dataset.id},
                               {"particle", dataset.system.particle.name},
                               {"surface", dataset.system.surface.name}});
  }
  out["assumed"] = {{"parameters", assumed_json(plan)},
                    {"velocities", {options.slowest, options.fastest}},
                    {"scatter", options.scatter},
                    {"floor", options.floor},
                    {"spread", options.spread}};
  out["wanted_error"] = options.error;
  out["reached"] = plan.reached;
  out["checks"] = options.checks;
  out["points"] = plan.points;
  out["events_per_point"] = options.events;
  out["impacts"] = plan.impacts;
  out["efficiency"] = number_or_null(plan.efficiency);
  out["settings"] = Json::array();
  for (const PlannedSetting& setting : plan.settings) {
    Json row = place_json(plan, setting.dataset, setting.diameter, setting.velocity);
    row["points"] = setting.points;
    row["impacts"] = setting.points * options.events;
    row["restitution"] = number_or_null(setting.restitution);
    row["restitution_sd"] = setting.sd > 0.0 ? Json(setting.sd) : Json(nullptr);
    row["captured"] = setting.captured;
    out["settings"].push_back(std::move(row));
  }
  out["quantities"] = Json::array();
  for (const PlannedQuantity& quantity : plan.quantities) {
    out["quantities"].push_back(quantity_json(plan, quantity));
  }
  return json_text(out);
}

std::string csv_points_to_make(const ExperimentPlan& plan, std::size_t dataset) {
  const std::vector<DataColumn>& columns = plan.datasets[dataset].columns;
  std::string csv;
  for (const DataColumn& column : columns) csv += (csv.empty() ? "" : ",") + column.name;
  csv += '\n';
  for (const PlannedSetting& setting : plan.settings) {
    if (setting.dataset != dataset) continue;
    std::string row;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (c > 0) row += ',';
      const auto quantity = value_named<Quantity>(columns[c].name);
      if (!quantity) continue;
      const double factor = unit_factor(dimension_of(*quantity), columns[c].unit).value_or(1.0);
      if (quantity == Quantity::series) {
        row += diameter_words(setting.diameter);
      } else if (quantity == Quantity::diameter) {
        row += fmt::format("{:.6g}", setting.diameter / factor);
      } else if (quantity == Quantity::incident_velocity) {
        row += fmt::format("{:.6g}", setting.velocity / factor);
      } else if (quantity == Quantity::events) {
        row += fmt::format("{}", plan.options.events);
      }
    }
    for (int k = 0; k < setting.points; ++k) csv += row + '\n';
  }
  return csv;
}

}  // namespace recoil
