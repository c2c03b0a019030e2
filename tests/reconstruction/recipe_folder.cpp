#include "recipe_folder.hpp"

namespace recoil::recipes {

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

CopiedDatasets::CopiedDatasets() {
  for (const std::string& id : reconstruction_ids()) {
    fs::copy(dataset_folder(id), folder(id), fs::copy_options::recursive);
  }
}

}  // namespace recoil::recipes
