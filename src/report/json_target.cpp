#include "report/json_target.hpp"

#include "core/units.hpp"

namespace recoil {

void add_target(Json& entry, const TargetMaterial& material,
                const std::vector<ExperimentPlace>& places) {
  entry["target"] = {{"material", material.name},
                     {"youngs_modulus", material.youngs_modulus},
                     {"poisson_ratio", material.poisson_ratio},
                     {"density", material.density}};
  entry["points"] = Json::array();
  for (const ExperimentPlace& place : places) {
    entry["points"].push_back({{"diameter_um", place.diameter / units::um},
                               {"incident_velocity", place.velocity},
                               {"events", place.events}});
  }
}

}  // namespace recoil
