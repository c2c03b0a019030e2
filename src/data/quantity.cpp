#include "data/quantity.hpp"

#include <fmt/format.h>

#include "core/numbers.hpp"
#include "data/text.hpp"

namespace recoil {

Scale known_scale(Dimension dimension, const std::string& unit, const std::string& of,
                  const Location& where) {
  if (const auto factor = unit_factor(dimension, unit)) {
    Scale scale{*factor};
    if (unit == "degC" || unit == "°C") scale.zero = 273.15;
    if (unit == "degF" || unit == "°F") scale.zero = 459.67 * scale.factor;
    return scale;
  }
  const auto other = dimension_of_unit(unit);
  throw InputError(where,
                   other ? fmt::format("{} in {}", of, quote(unit))
                         : fmt::format("unknown unit {} of {}", quote(unit), of),
                   other ? fmt::format("that is the unit of a {}", name_of(*other)) : "",
                   fmt::format("use {}", join(unit_names(dimension))));
}

std::optional<std::pair<double, std::string>> number_and_unit(std::string_view text) {
  text = trimmed(text);
  for (std::size_t length = text.size(); length > 0; --length) {
    if (const auto value = parse_number(text.substr(0, length))) {
      return std::pair{*value, std::string(trimmed(text.substr(length)))};
    }
  }
  return std::nullopt;
}

double parse_quantity(const std::string& text, Dimension dimension, const std::string& usual,
                      const std::string& of) {
  const auto stated = number_and_unit(text);
  if (!stated) {
    throw InputError({}, fmt::format("{} {} is not a number", of, quote(text)), "",
                     fmt::format("write for example 4.9{}", usual == "1" ? "" : usual));
  }
  const std::string& unit = stated->second.empty() ? usual : stated->second;
  return known_scale(dimension, unit, of, {})(stated->first);
}

}  // namespace recoil
