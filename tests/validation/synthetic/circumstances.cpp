#include "validation/synthetic/circumstances.hpp"

#include <algorithm>
#include <cmath>

namespace recoil::hidden {
namespace {

/// Relative humidity over which a meniscus of water at 293.15 K has this radius (Thomson 1871).
double humidity_for(double radius) {
  const double length = 0.0728 * 1.805e-5 / (8.314462618 * 293.15);
  return std::exp(-length / radius);
}

/// Thickness of a plate in which a point force F moves the struck place with the velocity of
/// mobility F (Zener 1941).
double thickness_for(const Base& base, double mobility) {
  const double per_area = 4.0 / std::sqrt(3.0) *
                          std::sqrt(base.surface_modulus * base.surface_density /
                                    (1.0 - std::pow(base.surface_ratio, 2)));
  return 1.0 / std::sqrt(mobility * per_area);
}

}  // namespace

std::vector<StatedCondition> conditions_behind(const std::string& effect, const Base& base,
                                               const Effects& effects) {
  if (effect == "gas_film") {
    return {{"ambient_pressure", effects.gas_pressure}, {"probe_height", effects.gas_distance}};
  }
  if (effect == "flight_drag") return {{"ambient_pressure", effects.flight_pressure}};
  if (effect == "capillary") return {{"relative_humidity", humidity_for(effects.bridge_length)}};
  if (effect == "plate_flexure") {
    return {{"target_thickness", thickness_for(base, effects.contact.plate_mobility)}};
  }
  if (effect == "electrostatic_image") return {{"neutralised", 0.0}};
  if (effect == "asperity_loss") return {{"surface_rms_roughness", 5e-8}};
  if (effect == "velocity_offset" || effect == "height_origin") {
    return {{"velocities_calibrated", 0.0}};
  }
  if (effect == "size_calibration") return {{"sizes_calibrated", 0.0}};
  if (effect == "polydispersity") return {{"sizes_equal", 0.0}};
  return {};
}

StatedCondition change_against(const std::string& effect) {
  if (effect == "gas_film" || effect == "flight_drag") return {"ambient_pressure", 1.0};
  if (effect == "capillary") return {"relative_humidity", 0.0};
  if (effect == "plate_flexure") return {"target_thickness", 0.05};
  if (effect == "electrostatic_image") return {"neutralised", 1.0};
  if (effect == "asperity_loss") return {"surface_rms_roughness", 5e-10};
  if (effect == "probe_plane") return {"probe_height", 0.0};
  if (effect == "velocity_offset" || effect == "height_origin") {
    return {"velocities_calibrated", 1.0};
  }
  if (effect == "size_calibration") return {"sizes_calibrated", 1.0};
  if (effect == "polydispersity") return {"sizes_equal", 1.0};
  return {};
}

Effects under(const StatedCondition& condition, Effects effects) {
  if (condition.name == "ambient_pressure") {
    effects.gas_pressure = std::min(effects.gas_pressure, condition.value);
    effects.flight_pressure = std::min(effects.flight_pressure, condition.value);
  } else if (condition.name == "relative_humidity" && condition.value == 0.0) {
    effects.bridge_length = 0.0;
  } else if (condition.name == "target_thickness") {
    effects.contact.plate_mobility = 0.0;  // 5 cm: nothing comes back in time
  } else if (condition.name == "neutralised" && condition.value > 0.0) {
    effects.surface_field = 0.0;
  } else if (condition.name == "surface_rms_roughness") {
    effects.asperity_energy = 0.0;
  } else if (condition.name == "probe_height") {
    effects.plane_height = 0.0;
  } else if (condition.name == "velocities_calibrated" && condition.value > 0.0) {
    effects.velocity_error = 0.0;
    effects.height_error = 0.0;
  } else if (condition.name == "sizes_calibrated" && condition.value > 0.0) {
    effects.diameter_error = 0.0;
  } else if (condition.name == "sizes_equal" && condition.value > 0.0) {
    effects.size_spread = 0.0;
  }
  return effects;
}

}  // namespace recoil::hidden
