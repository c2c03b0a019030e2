#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/names.hpp"
#include "experiment/passages.hpp"

namespace recoil {

/// A field of the passages.
enum class PassageField { time, velocity, tangential, diameter, series };

template <>
struct NamesOf<PassageField> {
  static constexpr std::array<std::string_view, 5> names = {
      "time", "velocity", "tangential_velocity", "diameter", "series"};
};

/// Where each field stands in a row, and its factor to SI.
struct PassageColumns {
  PerValue<PassageField, std::optional<std::size_t>> index;  ///< nothing: no such column
  PerValue<PassageField, double> factor;
  std::size_t width = 0;                 ///< cells of a row
  std::vector<std::string> ignored;      ///< columns that are no field
  std::optional<Provenance> provenance;  ///< of the data package
  std::vector<FieldUnit> units;          ///< of the fields that are there, series excepted
};

/// Ties the fields to the header's columns and finds their units.
/// @param package_text the data package beside the file; empty for none.
/// @throws InputError when a needed column or a unit is missing or not known.
PassageColumns passage_columns(const std::vector<std::string>& header, const std::string& file,
                               const std::string& package_text, const PassageFormat& format);

}  // namespace recoil
