#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hidden {

/// Runs a program as a user does, stdin empty.
struct ProgramRun {
  int status = -1;  ///< exit status; -1 where it could not be started, or a signal ended it
  double seconds = 0.0;
  std::string complaint;  ///< what it wrote on stderr
};
ProgramRun run_program(const std::vector<std::string>& command);

/// A folder of its own below the system's temporary one, removed at the end.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace hidden
