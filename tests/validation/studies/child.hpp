#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace recoil {

/// The result of running another program.
struct ChildOutcome {
  int failed = 0;  ///< errno if the program could not be started, else 0
  bool timed_out = false;
  int status = -1;       ///< exit status; -1 if a signal ended the program
  std::string out, err;  ///< standard output and error
};

/// Runs a program without a shell, in the locale C.UTF-8. Its standard input, output and error are
/// files in memory, so that a full disk cannot truncate them.
/// @param words the program, searched in PATH, and its arguments
/// @param limit the program is killed after this time
/// @throws ComputationError without memory for these files; CalledOff, after killing the program
ChildOutcome run_child(const std::vector<std::string>& words, const std::string& input,
                       std::chrono::milliseconds limit);

}  // namespace recoil
