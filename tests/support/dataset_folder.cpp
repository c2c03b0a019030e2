#include "support/dataset_folder.hpp"

#include "data/dataset.hpp"

namespace example {

const std::string package = R"({
  "name": "example-quartz",
  "title": "Spheres on quartz",
  "sources": [{ "title": "A paper", "path": "https://example.org/paper" }],
  "licenses": [{ "name": "CC0-1.0" }],
  "resources": [{
    "path": "points.csv",
    "schema": {
      "fields": [
        { "name": "series", "type": "string" },
        { "name": "diameter", "type": "number", "unit": "um" },
        { "name": "incident_velocity", "type": "number", "unit": "m/s" },
        { "name": "restitution", "type": "number", "unit": "1" },
        { "name": "restitution_sd", "type": "number", "unit": "%" },
        { "name": "velocity_sd", "type": "number", "unit": "cm/s" },
        { "name": "events", "type": "integer", "unit": "1" },
        { "name": "captured", "type": "integer" }
      ]
    }
  }],
  "recoil": {
    "provenance": "measured",
    "particle": { "material": "polystyrene", "density": 1050, "youngs_modulus": 2.56e9,
                  "poisson_ratio": 0.35 },
    "surface": { "material": "quartz", "youngs_modulus": 73e9, "poisson_ratio": 0.17 }
  }
}
)";

const std::string points =
    "series,diameter,incident_velocity,restitution,restitution_sd,velocity_sd,events,captured\n"
    "small,1.27,2.5,0.71,1.5,4,40,3\n"
    "small,1.27,1.25,,,,20,20\n"
    "\"large, coated\",4.9,12.5,0.912,,7.5,,\n"
    "small,1.27,35,0.95,1.5,,40,0\n";

DatasetFolder::DatasetFolder(const std::string& package_text, const std::string& points_text) {
  write("datapackage.json", package_text);
  write("points.csv", points_text);
}

std::optional<recoil::InputError> DatasetFolder::error() const {
  return support::error_of([&] { recoil::load_dataset(path()); });
}

void DatasetFolder::expect(const support::Mistake& mistake) const {
  support::expect_mistake(error(), mistake, path().string() + "/");
}

}  // namespace example
