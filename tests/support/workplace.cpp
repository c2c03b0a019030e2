#include "support/workplace.hpp"

namespace support {
namespace {

const char* const points =
    "series,diameter,incident_velocity,restitution,restitution_sd,events,captured\n"
    "small,2,1.6,0,0.015,20,20\n"
    "small,2,2.4,0.651,0.015,20,0\n"
    "small,2,5,0.842,0.015,20,0\n"
    "small,2,25,0.900,0.015,20,0\n"
    "large,4,0.8,0.505,0.015,20,0\n"
    "large,4,1.4,0.825,0.015,20,0\n"
    "large,4,5,0.937,0.015,20,0\n"
    "large,4,25,0.933,0.015,20,0\n";

const char* const package = R"({
  "name": "example",
  "title": "An example",
  "resources": [
    {
      "name": "points",
      "path": "points.csv",
      "schema": {
        "fields": [
          { "name": "series", "type": "string" },
          { "name": "diameter", "type": "number", "unit": "um" },
          { "name": "incident_velocity", "type": "number", "unit": "m/s" },
          { "name": "restitution", "type": "number", "unit": "1" },
          { "name": "restitution_sd", "type": "number", "unit": "1" },
          { "name": "events", "type": "integer", "unit": "1" },
          { "name": "captured", "type": "integer", "unit": "1" }
        ]
      }
    }
  ],
  "recoil": {
    "provenance": "synthetic",
    "particle": {
      "material": "polystyrene", "density": 1050, "youngs_modulus": 2.56e9, "poisson_ratio": 0.35
    },
    "surface": { "material": "silicon", "youngs_modulus": 131e9, "poisson_ratio": 0.28 }
  }
}
)";

const char* const fit = R"(dataset = "data"
[model]
adhesion_damping_phase = "rebound"
[parameters]
C_H = { initial = 3e-3, bounds = [0, 1] }
C_A = { initial = 3e-2, bounds = [0, 10] }
f0 = { free = false }
[uncertainty]
replicates = 39
level = 0.95
seed = 1
own_design = false
)";

}  // namespace

Workplace::Workplace() {
  write("data/datapackage.json", package);
  write("data/points.csv", points);
  write("fit.toml", fit);
}

Outcome Workplace::run(const std::vector<std::string>& arguments) const {
  return run_recoil(arguments, path());
}

}  // namespace support
