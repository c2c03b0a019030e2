#include "studies/synthetic/circumstances.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "studies/synthetic/case.hpp"
#include "studies/synthetic/observed_mean.hpp"
#include "studies/synthetic/purpose.hpp"

namespace hidden {
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

struct Seen {
  int rebounds = 0;
  int captured = 0;
  double sum = 0.0;  ///< of the readings
};

/// Each impact by itself: it comes back, stays, or comes back too slowly to be seen.
Seen impacts_seen(const Design& design, const Effects& effects, const Point& point,
                  recoil::RandomStream& random) {
  Seen seen;
  const auto typical = shared_square(design.base, effects, point.velocity, point.diameter);
  for (int i = 0; i < point.events; ++i) {
    const Reading one = read_impact(design.base, effects, design.scatter, point.velocity,
                                    point.diameter, typical, random);
    seen.captured += one.captured ? 1 : 0;
    seen.rebounds += one.seen ? 1 : 0;
    seen.sum += one.restitution;
  }
  return seen;
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
  }
  return effects;
}

void take_further(Case& made, const FurtherImpacts& further, std::uint64_t round) {
  recoil::RandomStream random(made.order.experiment_seed() + 7919 * (round + 1), hidden_purpose,
                              99);
  Design& design = made.design;
  const auto row = std::find_if(design.rows.begin(), design.rows.end(), [&](const Row& r) {
    return std::abs(r.diameter / further.diameter - 1.0) < 1e-6;
  });
  Point point;
  point.row = static_cast<std::size_t>(row - design.rows.begin());
  if (row == design.rows.end()) {
    Row added;
    added.name = fmt::format("{:.3g} um", 1e6 * further.diameter);
    added.diameter = further.diameter;
    design.rows.push_back(added);
    if (!made.effects.series_offset.empty()) {  // another batch, with an error of its own
      double square = 0.0;
      for (const double offset : made.effects.series_offset) square += offset * offset;
      const double sd = std::sqrt(square / static_cast<double>(made.effects.series_offset.size()));
      made.effects.series_offset.push_back(sd * random.normal());
    }
  }
  point.diameter = further.diameter;
  point.velocity = further.velocity;
  point.events = further.events;
  point.changed = further.changed;
  point.setting = 900000 + static_cast<std::size_t>(round);
  const Effects effects = under(further.changed, made.effects);
  const Seen seen = impacts_seen(design, effects, point, random);
  if (seen.rebounds + seen.captured == 0) return;  // too slow to be seen, all of them
  point.events = seen.rebounds + seen.captured;
  point.captured = seen.captured;
  const double e = seen.rebounds > 0 ? seen.sum / seen.rebounds : 0.0;
  point.restitution = e;
  // What an experimenter knows of the scatter: that of the other points.
  point.sd = design.scatter.of(std::max(e, 0.1)) / std::sqrt(std::max(seen.rebounds, 1));
  made.points.push_back(point);
  made.readings.push_back(
      e > 0.0 && !effects.series_offset.empty() ? e + effects.series_offset[point.row] : e);
}

}  // namespace hidden
