#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "report/report.hpp"

/// The parts of fit.json that are shared by its writers.
namespace recoil {

/// `format_version` of every JSON that people script against: it grows when a key goes or changes
/// its meaning, not when one is added.
inline constexpr int format_version = 1;

/// `object[key]` and, when there is no number, the reason as `object[key_why]`.
void put(Json& object, const std::string& key, std::optional<double> value, const std::string& why);

/// [lower, upper] or null.
Json interval_json(const Interval& interval);

/// Why `interval_json` gave null.
std::string why_none(const Interval& interval);

Json numbers_json(const std::vector<double>& values);

/// `two_point` and `full` of the contract (those of the first dataset), and the same for every
/// dataset under `two_point_by_dataset` and `full_by_dataset`.
void put_two_point(Json& out, const Analysis& analysis);

/// `curve`: one row per point of every curve.
Json curve_json(const Analysis& analysis);

/// `residuals`: one row per data point.
Json residuals_json(const Analysis& analysis);

/// `starts`: where the minimisation began and ended.
Json starts_json(const Analysis& analysis);

}  // namespace recoil
