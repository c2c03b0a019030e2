#include "report/json_values.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/units.hpp"
#include "report/words_intervals.hpp"
#include "report/words_two_point.hpp"

namespace recoil {

void put(Json& object, const std::string& key, std::optional<double> value,
         const std::string& why) {
  object[key] = number_or_null(value.value_or(NAN));
  if (object[key].is_null()) object[key + "_why"] = why;
}

Json interval_json(const Interval& interval) {
  if (!interval.available() || !std::isfinite(*interval.lower) || !std::isfinite(*interval.upper)) {
    return nullptr;
  }
  return Json::array({number_or_null(*interval.lower), number_or_null(*interval.upper)});
}

std::string why_none(const Interval& interval) {
  return interval.available() ? "a bound is not finite" : missing_words(interval);
}

Json numbers_json(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number_or_null(value));
  return list;
}

namespace {

Json point_json(const Analysis& a, std::size_t index) {
  if (index >= a.fitted.data.points.size()) return nullptr;
  const Observation& point = a.fitted.data.points[index];
  return {{"incident_velocity", number_or_null(point.velocity)},
          {"restitution", number_or_null(point.restitution)},
          {"diameter_um", number_or_null(point.diameter / units::um)}};
}

std::vector<std::size_t> damping_slots(const Analysis& a, std::size_t dataset) {
  return {a.fitted.model.slot_C_H[dataset], a.fitted.model.slot_C_A[dataset]};
}

std::string held_out_why(const TwoPointComparison& comparison) {
  return comparison.nothing_held_out ? held_out_words(comparison)
                                     : "no other diameter was predicted";
}

Json two_point_json(const Analysis& a, const TwoPointComparison& comparison) {
  const TwoPointResult& two = comparison.result;
  const bool answered = two.status != TwoPointStatus::too_few_points;
  Json out;
  out["status"] = to_string(two.status);
  const std::string words = plain_text(two_point_words(a.fitted, comparison.dataset, two));
  out["text"] = words;
  out["iterations"] = two.iterations;
  out["diameter_um"] = number_or_null(two.diameter / units::um);
  out["low_point"] = answered ? point_json(a, two.low_point) : Json(nullptr);
  out["high_point"] = answered ? point_json(a, two.high_point) : Json(nullptr);
  Json parameters = Json::object();
  for (const std::size_t s : damping_slots(a, comparison.dataset)) {
    Json entry;
    put(entry, "value", s < two.theta.size() ? two.theta[s] : NAN, words);
    entry["unit"] = a.fitted.model.slots[s].parameter->unit;
    put(entry, "spread", s < comparison.spread.size() ? comparison.spread[s] : NAN,
        "no replicate has an answer");
    parameters[a.fitted.model.slots[s].label()] = entry;
  }
  out["parameters"] = parameters;
  put(out, "rmse", answered ? comparison.rmse : NAN, words);
  put(out, "held_out_rmse", comparison.held_out_rmse, held_out_why(comparison));
  out["failed"] = comparison.failed;
  return out;
}

Json full_json(const Analysis& a, const TwoPointComparison& comparison) {
  Json out;
  put(out, "rmse", comparison.full_rmse, "no point rebounded");
  put(out, "held_out_rmse", comparison.full_held_out_rmse, held_out_why(comparison));
  Json spread = Json::object();
  for (const std::size_t s : damping_slots(a, comparison.dataset)) {
    spread[a.fitted.model.slots[s].label()] = s < comparison.full_spread.size()
                                                  ? number_or_null(comparison.full_spread[s])
                                                  : Json(nullptr);
  }
  out["spread"] = spread;
  return out;
}

}  // namespace

void put_two_point(Json& out, const Analysis& a) {
  Json two = Json::object();
  Json full = Json::object();
  for (const TwoPointComparison& comparison : a.uncertainty.two_point) {
    const std::string& id = a.datasets[comparison.dataset].id;
    two[id] = two_point_json(a, comparison);
    full[id] = full_json(a, comparison);
  }
  // The contract's keys are those of the first dataset; a joint fit lists all of them beside.
  out["two_point"] = two.empty() ? Json(nullptr) : two.begin().value();
  if (two.empty()) out["two_point_why"] = "the comparison was not made";
  Json first = full.empty() ? Json::object() : full.begin().value();
  if (full.empty()) {
    put(first, "rmse", a.fitted.rmse, "no point rebounded");
    put(first, "held_out_rmse", NAN, "the comparison was not made");
  }
  out["full"] = first;
  out["two_point_by_dataset"] = two;
  out["full_by_dataset"] = full;
}

/// One row per point of every curve.
Json curve_json(const Analysis& a) {
  Json list = Json::array();
  for (const RestitutionCurve& curve : a.uncertainty.curves) {
    for (std::size_t i = 0; i < curve.velocity.size() && i < curve.restitution.size(); ++i) {
      Json row;
      row["dataset"] = a.datasets[curve.dataset].id;
      row["series"] = curve.series;
      row["diameter_um"] = number_or_null(curve.diameter / units::um);
      row["incident_velocity"] = number_or_null(curve.velocity[i]);
      row["restitution"] = number_or_null(curve.restitution[i]);
      const bool banded = i < curve.lower.size() && i < curve.upper.size() &&
                          std::isfinite(curve.lower[i]) && std::isfinite(curve.upper[i]);
      row["band"] = banded ? numbers_json({curve.lower[i], curve.upper[i]}) : Json(nullptr);
      row["two_point"] =
          i < curve.two_point.size() ? number_or_null(curve.two_point[i]) : Json(nullptr);
      list.push_back(row);
    }
  }
  return list;
}

Json residuals_json(const Analysis& a) {
  const FitResult& f = a.fitted;
  Json list = Json::array();
  const auto at = [](const std::vector<double>& values, std::size_t i) {
    return i < values.size() ? number_or_null(values[i]) : Json(nullptr);
  };
  for (std::size_t i = 0; i < a.fitted.data.points.size(); ++i) {
    const Observation& point = a.fitted.data.points[i];
    const Dataset& dataset = a.datasets[point.dataset];
    list.push_back(
        {{"dataset", dataset.id},
         {"series", point.series < dataset.series.size() ? dataset.series[point.series] : ""},
         {"diameter_um", number_or_null(point.diameter / units::um)},
         {"incident_velocity", number_or_null(point.velocity)},
         {"restitution", number_or_null(point.restitution)},
         {"restitution_sd",
          a.fitted.data.sd_stated ? number_or_null(point.weights.sd) : Json(nullptr)},
         {"sd_used", number_or_null(point.weights.sd)},
         {"sd_of_e2_from_inputs", number_or_null(point.weights.input_sd)},
         {"captured", point.censored},
         {"captured_count", point.captured},
         {"events", point.events},
         {"predicted", at(f.prediction, i)},
         {"weighted_residual", at(f.residuals, i)},
         {"leverage", at(f.leverage, i)}});
  }
  return list;
}

Json starts_json(const Analysis& a) {
  Json list = Json::array();
  for (const StartSummary& start : a.fitted.starts) {
    list.push_back({{"start", numbers_json(start.start)},
                    {"end", numbers_json(start.end)},
                    {"chi2", number_or_null(start.chi2)},
                    {"converged", start.converged()},
                    {"ended", to_string(start.ending)},
                    {"message", start.message}});
  }
  return list;
}

}  // namespace recoil
