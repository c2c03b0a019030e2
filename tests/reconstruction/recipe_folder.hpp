#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace recoil::testing {

/// The committed reconstructions.
const std::vector<std::string>& reconstruction_ids();

/// Their folder in the project.
std::filesystem::path dataset_folder(const std::string& id);

/// All committed reconstructions copied to a place where they may be damaged; removed at the end.
class CopiedDatasets {
 public:
  CopiedDatasets();
  ~CopiedDatasets();
  CopiedDatasets(const CopiedDatasets&) = delete;
  CopiedDatasets& operator=(const CopiedDatasets&) = delete;

  std::filesystem::path folder(const std::string& id) const { return root_ / id; }

  /// Replaces the first `from` in a file of the dataset; fails the test when it is not there.
  void replace(const std::string& id, const std::string& file, const std::string& from,
               const std::string& to) const;

 private:
  std::filesystem::path root_;
};

/// The whole text of a file.
std::string text_of(const std::filesystem::path& path);

}  // namespace recoil::testing
