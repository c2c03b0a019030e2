#include "validation/studies/program_run.hpp"

#include <stdlib.h>

#include <chrono>
#include <stdexcept>

#include "core/child.hpp"

namespace hidden {

ProgramRun run_program(const std::vector<std::string>& command) {
  const auto start = std::chrono::steady_clock::now();
  const recoil::ChildOutcome outcome = recoil::run_child(command, "", std::chrono::hours(24));
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  if (outcome.failed != 0) return {-1, 0.0, "cannot be started"};
  return {outcome.status, time.count(), outcome.err};
}

ScratchFolder::ScratchFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "impacts-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace hidden
