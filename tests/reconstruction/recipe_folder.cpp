#include "recipe_folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

namespace recoil::testing {

namespace fs = std::filesystem;

const std::vector<std::string>& reconstruction_ids() {
  static const std::vector<std::string> ids = {"wall1990-molybdenum",  "wall1990-silicon",
                                               "wall1990-mica",        "dahneke1975-quartz",
                                               "li1999-sst65-silicon", "li1999-sst125-silicon"};
  return ids;
}

fs::path dataset_folder(const std::string& id) {
  return fs::path(RECOIL_SOURCE_DIR) / "datasets" / id;
}

std::string text_of(const fs::path& path) {
  const std::ifstream in(path, std::ios::binary);
  EXPECT_TRUE(in) << path;
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

CopiedDatasets::CopiedDatasets() {
  static int count = 0;
  root_ = fs::temp_directory_path() /
          ("recoil-recipes-" + std::to_string(getpid()) + "-" + std::to_string(++count));
  for (const std::string& id : reconstruction_ids()) {
    fs::create_directories(root_ / id);
    fs::copy(dataset_folder(id), root_ / id, fs::copy_options::recursive);
  }
}

CopiedDatasets::~CopiedDatasets() {
  std::error_code ignored;
  fs::remove_all(root_, ignored);
}

void CopiedDatasets::replace(const std::string& id, const std::string& file,
                             const std::string& from, const std::string& to) const {
  std::string text = text_of(folder(id) / file);
  const auto at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  std::ofstream(folder(id) / file, std::ios::binary) << text;
}

}  // namespace recoil::testing
