#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace recoil {

/// The result of running another program.
struct ChildOutcome {
  int failed = 0;  ///< errno of a start that failed
  bool timed_out = false;
  int status = -1;       ///< exit status; -1 where a signal ended it
  std::string out, err;  ///< standard output and error
};

/// Runs `words` (a program, searched in PATH, and its arguments; no shell) with `input` as standard
/// input, numbers in the C locale and names in UTF-8. Its files are in memory, so that no full disk
/// cuts them short. Ends it after `limit`. @throws CalledOff, after it has ended the program
ChildOutcome run_child(const std::vector<std::string>& words, const std::string& input,
                       std::chrono::milliseconds limit);

}  // namespace recoil
