#include "core/units.hpp"

#include <algorithm>
#include <numbers>

namespace recoil {
namespace {

struct Unit {
  Dimension dimension;
  std::string_view name;
  double factor;
};

constexpr Unit known_units[] = {
    {Dimension::count, "1", 1.0},
    {Dimension::ratio, "1", 1.0},
    {Dimension::ratio, "%", 1e-2},
    {Dimension::length, "um", units::um},
    {Dimension::length, "µm", units::um},  // U+00B5, the micro sign
    {Dimension::length, "μm", units::um},  // U+03BC, the Greek letter
    {Dimension::length, "nm", units::nm},
    {Dimension::length, "mm", units::mm},
    {Dimension::length, "cm", units::cm},
    {Dimension::length, "m", units::m},
    {Dimension::length, "in", 0.0254},  // international yard and pound agreement of 1959
    {Dimension::length, "ft", 0.3048},
    {Dimension::velocity, "m/s", 1.0},
    {Dimension::velocity, "cm/s", units::cm},
    {Dimension::velocity, "mm/s", units::mm},
    {Dimension::velocity, "km/h", 1.0 / 3.6},
    {Dimension::velocity, "ft/s", 0.3048},
    {Dimension::velocity, "in/s", 0.0254},
    {Dimension::velocity, "m/sec", 1.0},
    {Dimension::velocity, "mph", 1609.344 / 3600.0},
    {Dimension::time, "s", 1.0},
    {Dimension::time, "ms", units::ms},
    {Dimension::time, "us", units::us},
    {Dimension::time, "µs", units::us},
    {Dimension::time, "μs", units::us},
    {Dimension::time, "sec", 1.0},
    {Dimension::time, "msec", units::ms},
    {Dimension::time, "usec", units::us},
    {Dimension::pressure, "Pa", 1.0},
    {Dimension::pressure, "hPa", 100.0},
    {Dimension::pressure, "kPa", 1e3},
    {Dimension::pressure, "MPa", 1e6},
    {Dimension::pressure, "GPa", units::GPa},
    {Dimension::pressure, "mbar", 100.0},
    {Dimension::pressure, "bar", 1e5},
    {Dimension::pressure, "atm", 101325.0},
    {Dimension::pressure, "Torr", 101325.0 / 760.0},
    {Dimension::temperature, "K", 1.0},
    {Dimension::temperature, "degC", 1.0},  // known_scale adds the zero
    {Dimension::temperature, "°C", 1.0},
    {Dimension::temperature, "degF", 5.0 / 9.0},
    {Dimension::temperature, "°F", 5.0 / 9.0},
    {Dimension::density, "kg/m3", 1.0},
    {Dimension::density, "g/cm3", 1e3},
    {Dimension::energy_per_area, "J/m2", 1.0},
    {Dimension::energy_per_area, "mJ/m2", 1e-3},
    {Dimension::force_per_length, "N/m", 1.0},
    {Dimension::acceleration, "m/s2", 1.0},
    {Dimension::inverse_velocity, "s/m", 1.0},
    {Dimension::frequency, "1/s", 1.0},
    {Dimension::frequency, "Hz", 1.0},
    {Dimension::frequency, "fps", 1.0},
    {Dimension::angle, "rad", 1.0},
    {Dimension::angle, "deg", std::numbers::pi / 180.0},
    {Dimension::angle, "°", std::numbers::pi / 180.0},
};

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

std::string si_unit(Dimension dimension) {
  const auto* const found = std::ranges::find_if(known_units, [&](const Unit& unit) {
    return unit.dimension == dimension && unit.factor == 1.0;
  });
  return std::string(found->name);
}

std::optional<Dimension> dimension_of_unit(std::string_view unit) {
  for (const Unit& known : known_units) {
    if (known.name == unit) return known.dimension;
  }
  return std::nullopt;
}

}  // namespace recoil
