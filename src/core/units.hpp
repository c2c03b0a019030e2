#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/names.hpp"

namespace recoil {

/// Multiply to convert to SI, divide to convert from SI: `4.9 * units::um`.
namespace units {
inline constexpr double m = 1.0;
inline constexpr double cm = 1e-2;
inline constexpr double mm = 1e-3;
inline constexpr double um = 1e-6;
inline constexpr double nm = 1e-9;
inline constexpr double ms = 1e-3;
inline constexpr double us = 1e-6;
inline constexpr double ns = 1e-9;
inline constexpr double GPa = 1e9;
}  // namespace units

/// A length [m] in micrometres.
constexpr double in_um(double metres) { return metres / units::um; }

/// An angle [rad] in degrees.
constexpr double in_degrees(double radians) { return radians * (180.0 / std::numbers::pi); }

/// Standard gravity [m/s2], exact by definition (CGPM 1901).
inline constexpr double standard_gravity = 9.80665;

/// What a column of a data file or a value on the command line measures. Texts have no unit.
enum class Dimension {
  text,
  count,
  ratio,
  length,
  velocity,
  time,
  pressure,
  temperature,
  density,
  energy_per_area,
  force_per_length,
  acceleration,
  inverse_velocity,
  frequency,
  angle
};

constexpr auto names_of_values(Dimension) {
  return name_list("text", "count", "ratio", "length", "velocity", "time", "pressure",
                   "temperature", "density", "energy per area", "force per length", "acceleration",
                   "inverse velocity", "frequency", "angle");
}

/// The factor to SI of a unit name ("um", "cm/s", "%"); nullopt if `unit` does not belong to
/// `dimension`.
std::optional<double> unit_factor(Dimension dimension, std::string_view unit);

/// The unit names accepted for `dimension`, the usual one first.
std::vector<std::string> unit_names(Dimension dimension);

/// The SI unit of `dimension`, "1" of counts and ratios. @pre it is no text
std::string si_unit(Dimension dimension);

/// What `unit` measures; nullopt for an unknown unit.
std::optional<Dimension> dimension_of_unit(std::string_view unit);

}  // namespace recoil
