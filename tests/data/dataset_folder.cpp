#include "dataset_folder.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>
#include <regex>

#include "core/error.hpp"
#include "data/dataset.hpp"

namespace example {

namespace fs = std::filesystem;

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

std::string changed(std::string text, const std::string& old_text, const std::string& new_text) {
  const std::size_t at = text.find(old_text);
  if (at == std::string::npos) {
    ADD_FAILURE() << "the example has no '" << old_text << "'";
    return text;
  }
  return text.replace(at, old_text.size(), new_text);
}

DatasetFolder::DatasetFolder(const std::string& package_text, const std::string& points_text) {
  std::string name = (fs::temp_directory_path() / "recoil-data-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
  write("datapackage.json", package_text);
  write("points.csv", points_text);
}

DatasetFolder::~DatasetFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void DatasetFolder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
}

std::string DatasetFolder::failure() const {
  try {
    recoil::load_dataset(path_);
  } catch (const recoil::InputError& error) {
    std::string text = error.what();
    const std::string prefix = path_.string() + "/";
    if (text.starts_with(prefix)) text.erase(0, prefix.size());
    return text;
  }
  return "loaded";
}

void expect_message(const std::string& message, const Mistake& mistake) {
  EXPECT_TRUE(message.starts_with(mistake.begin)) << message << "\nshould begin " << mistake.begin;
  EXPECT_NE(message.find(mistake.word), std::string::npos) << message;
  EXPECT_NE(message.find(mistake.hint), std::string::npos) << message;
  EXPECT_EQ(message.find_first_of("\n\r\t"), std::string::npos) << message;
  EXPECT_LT(message.size(), 300U) << message;
  static const std::regex grammar(R"([^:]+(:\d+:\d+)?: .+ \(.+\) .+)");
  EXPECT_TRUE(std::regex_match(message, grammar)) << message;
}

}  // namespace example
