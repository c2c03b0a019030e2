#include "core/units.hpp"

#include <array>

namespace recoil {
namespace {

struct Unit {
  Dimension dimension;
  std::string_view name;
  double factor;
};

constexpr std::array<Unit, 8> known_units = {{
    {Dimension::length, "um", units::um},
    {Dimension::length, "mm", units::mm},
    {Dimension::length, "m", units::m},
    {Dimension::velocity, "m/s", 1.0},
    {Dimension::velocity, "cm/s", 1e-2},
    {Dimension::ratio, "1", 1.0},
    {Dimension::ratio, "%", 1e-2},
    {Dimension::count, "1", 1.0},
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

}  // namespace recoil
