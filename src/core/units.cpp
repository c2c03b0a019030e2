#include "core/units.hpp"

#include <array>

namespace recoil {
namespace {

struct Unit {
  Dimension dimension;
  std::string_view name;
  double factor;
};

constexpr std::array<Unit, 22> known_units = {{
    {Dimension::count, "1", 1.0},
    {Dimension::ratio, "1", 1.0},
    {Dimension::ratio, "%", 1e-2},
    {Dimension::length, "um", units::um},
    {Dimension::length, "µm", units::um},
    {Dimension::length, "nm", units::nm},
    {Dimension::length, "mm", units::mm},
    {Dimension::length, "cm", units::cm},
    {Dimension::length, "m", units::m},
    {Dimension::velocity, "m/s", 1.0},
    {Dimension::velocity, "cm/s", units::cm},
    {Dimension::velocity, "mm/s", units::mm},
    {Dimension::time, "s", 1.0},
    {Dimension::time, "ms", units::ms},
    {Dimension::time, "us", units::us},
    {Dimension::time, "µs", units::us},
    {Dimension::pressure, "Pa", 1.0},
    {Dimension::pressure, "hPa", 100.0},
    {Dimension::pressure, "kPa", 1e3},
    {Dimension::pressure, "mbar", 100.0},
    {Dimension::pressure, "bar", 1e5},
    {Dimension::temperature, "K", 1.0},
}};

}  // namespace

std::optional<double> unit_factor(Dimension dimension, std::string_view unit) {
  for (const Unit& known : known_units) {
    if (known.dimension == dimension && known.name == unit) return known.factor;
  }
  return std::nullopt;
}

std::vector<std::string> unit_names(Dimension dimension) {
  std::vector<std::string> names;
  for (const Unit& known : known_units) {
    if (known.dimension == dimension) names.emplace_back(known.name);
  }
  return names;
}

std::optional<Dimension> dimension_of_unit(std::string_view unit) {
  for (const Unit& known : known_units) {
    if (known.name == unit) return known.dimension;
  }
  return std::nullopt;
}

}  // namespace recoil
