#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"

namespace recoil {

/// Converts numbers with one unit into SI.
struct Scale {
  double factor = 1.0;
  double zero = 0.0;  ///< what 0 in the unit is in SI: 273.15 for degC

  double operator()(double stated) const { return stated * factor + zero; }
};

/// The scale of `unit`. @param of name of the quantity, for the message
/// @throws InputError if the unit is unknown or does not belong to `dimension`
Scale known_scale(Dimension dimension, const std::string& unit, const std::string& of,
                  const Location& where);

/// The number at the beginning of a text and the rest, "20 mm" as 20 and "mm". The rest may be
/// empty. nullopt if the text begins with no number.
std::optional<std::pair<double, std::string>> number_and_unit(std::string_view text);

/// Every quantity that a person states outside a table is parsed here: "20mm", "8 um", "20".
/// @param usual the unit of a number without a unit
/// @param of name of the quantity, for the message: "--diameter"
/// @return the value in SI
/// @throws InputError unless `text` is a number, alone or with a unit of this dimension
double parse_quantity(const std::string& text, Dimension dimension, const std::string& usual,
                      const std::string& of);

}  // namespace recoil
