#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace recoil::recipes {

/// The committed reconstructions.
const std::vector<std::string>& reconstruction_ids();

/// Their folder in the project.
std::filesystem::path dataset_folder(const std::string& id);

/// All committed reconstructions copied to a place where they may be damaged.
class CopiedDatasets : public support::TemporaryFolder {
 public:
  CopiedDatasets();

  std::filesystem::path folder(const std::string& id) const { return path() / id; }
};

}  // namespace recoil::recipes
