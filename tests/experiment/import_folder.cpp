#include "import_folder.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>
#include <sstream>

#include "core/error.hpp"

namespace import_folder {

namespace fs = std::filesystem;

Place::Place() {
  std::string place = (fs::temp_directory_path() / "recoil-import-XXXXXX").string();
  EXPECT_NE(mkdtemp(place.data()), nullptr);
  folder_ = place;
}

Place::~Place() { fs::remove_all(folder_); }

void Place::write(const std::string& name, const std::string& text) const {
  fs::create_directories((folder_ / name).parent_path());
  std::ofstream(folder_ / name) << text;
}

std::string Place::read(const std::string& name) const {
  std::ostringstream text;
  text << std::ifstream(folder_ / name).rdbuf();
  return text.str();
}

bool Place::has(const std::string& name) const { return fs::exists(folder_ / name); }

recoil::ImportRequest Place::request(const std::string& text, recoil::ImportFormat format) const {
  write("input.csv", text);
  recoil::ImportRequest request;
  request.file = folder_ / "input.csv";
  request.format = format;
  request.into = folder_ / "made";
  request.diameters = {"2um"};
  request.particle = "material=polystyrene,density=1050,youngs_modulus=2.56e9,poisson_ratio=0.35";
  request.surface = "material=silicon,youngs_modulus=131e9,poisson_ratio=0.28";
  request.provenance = "measured";
  request.sources = {"A test"};
  return request;
}

std::string complaint(const recoil::ImportRequest& request) {
  try {
    recoil::import_points(request);
  } catch (const recoil::InputError& error) {
    return error.what();
  }
  return "no complaint";
}

}  // namespace import_folder
