#pragma once

#include <filesystem>
#include <vector>

namespace recoil {

/// While one of these lives, no other process of recoil works on the same result: two would mix
/// their files, and take from each other what is finished. The mark is a locked file
/// "RESULT.lock" beside it, which ends with the process, however that ends. Where the file system
/// has no locks, nothing is claimed.
class Claim {
 public:
  /// Makes the folder when it is missing.
  /// @throws InputError when another process has it, or the place cannot be written
  explicit Claim(const std::filesystem::path& result);
  /// Removes the mark, and the folders that were made for it where nothing was put into them.
  ~Claim();
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;

 private:
  void let_go();

  std::filesystem::path mark_;
  std::vector<std::filesystem::path> made_;  // the innermost first
  int file_ = -1;
};

}  // namespace recoil
