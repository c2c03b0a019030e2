#pragma once

#include <array>
#include <string_view>

#include "core/names.hpp"

namespace recoil {

/// What an experimenter can set beside velocities, diameters and materials.
enum class Condition {
  ambient_pressure,       ///< [Pa]
  relative_humidity,      ///< [1]
  temperature,            ///< [K]
  target_thickness,       ///< [m]
  probe_height,           ///< of the measuring plane above the surface [m]
  neutralised,            ///< 0 or 1: the spheres' charge is taken off
  surface_rms_roughness,  ///< [m]
};

/// Their names in files.
template <>
struct NamesOf<Condition> {
  static constexpr std::array<std::string_view, 7> names = {
      "ambient_pressure", "relative_humidity", "temperature",          "target_thickness",
      "probe_height",     "neutralised",       "surface_rms_roughness"};
};

}  // namespace recoil
