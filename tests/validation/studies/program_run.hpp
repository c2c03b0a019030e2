#pragma once

#include <filesystem>
#include <limits>
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

/// A fit of the built command.
struct PlainFit {
  double chi2 = std::numeric_limits<double>::infinity();  ///< infinite where there is no fit
  double aicc = std::numeric_limits<double>::infinity();
  std::vector<double> predicted, residuals;            ///< e, and weighted [points]
  std::vector<double> sd, log_velocity, log_diameter;  ///< [points]
};

/// The fit file `fit` as it is, but with these mechanisms.
PlainFit plain_fit(const std::filesystem::path& fit, const std::vector<std::string>& mechanisms,
                   const std::filesystem::path& binary);

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
