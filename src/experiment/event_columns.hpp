#pragma once

#include <array>
#include <string>
#include <vector>

#include "experiment/events.hpp"

namespace recoil {

/// A field of the events, in the order of `event_fields()`.
enum class EventField { time, velocity, tangential, diameter, series };
inline constexpr std::size_t event_field_count = 5;

/// Where each field stands in a row, and its factor to SI.
struct EventColumns {
  std::array<int, event_field_count> index{-1, -1, -1, -1, -1};  ///< -1: no such column
  std::array<double, event_field_count> factor{1.0, 1.0, 1.0, 1.0, 1.0};
  std::size_t width = 0;             ///< cells of a row
  std::vector<std::string> ignored;  ///< columns that are no field
  std::string provenance;            ///< of the data package; empty when it states none
  std::string unit_source;           ///< in words
};

/// Ties the fields to the header's columns and finds their units.
/// @param package_text the data package beside the file; empty for none.
/// @throws InputError when a needed column or a unit is missing or not known.
EventColumns event_columns(const std::vector<std::string>& header, const std::string& file,
                           const std::string& package_text, const EventFormat& format);

}  // namespace recoil
