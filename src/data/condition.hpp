#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/names.hpp"

namespace recoil {

/// What an experimenter can set beside velocities, diameters and materials.
enum class Condition {
  ambient_pressure,       ///< of the air around; 0 is vacuum [Pa]
  relative_humidity,      ///< [1]
  temperature,            ///< [K]
  target_thickness,       ///< [m]
  probe_height,           ///< of the measuring plane above the surface [m]
  neutralised,            ///< 0 or 1: the spheres' charge is taken off
  surface_rms_roughness,  ///< [m]
  velocities_calibrated,  ///< 0 or 1: what is read was checked against a known velocity or height
  sizes_calibrated        ///< 0 or 1: the diameters were checked against a standard
};

/// Their names in files.
template <>
struct NamesOf<Condition> {
  static constexpr std::array<std::string_view, 9> names = {
      "ambient_pressure",      "relative_humidity",     "temperature",
      "target_thickness",      "probe_height",          "neutralised",
      "surface_rms_roughness", "velocities_calibrated", "sizes_calibrated"};
};

/// What a condition may be, in SI, and what a value outside of it usually means.
struct ConditionInfo {
  std::string_view unit;
  std::string_view meaning;
  double lower = 0.0;
  double upper = 0.0;
  std::string_view hint;
  bool yes_or_no = false;  ///< 1 or 0, and nothing between
};
const ConditionInfo& info_of(Condition condition);

/// The conditions that are stated of some impacts.
class Conditions {
 public:
  std::optional<double> of(Condition condition) const {
    return values_[static_cast<std::size_t>(condition)];
  }
  void set(Condition condition, double value) {
    values_[static_cast<std::size_t>(condition)] = value;
  }
  /// These, and of what they leave open that of `others`.
  Conditions or_else(const Conditions& others) const;
  bool operator==(const Conditions&) const = default;
  /// An order of no meaning, for maps.
  bool operator<(const Conditions& other) const { return values_ < other.values_; }

 private:
  std::array<std::optional<double>, NamesOf<Condition>::names.size()> values_;
};

}  // namespace recoil
