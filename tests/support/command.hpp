#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace support {

/// What one run of a program left behind.
struct Outcome {
  int status = -1;  ///< exit status; 128 + signal when it was killed
  std::string out;
  std::string err;
};

/// Runs `words` (a program and its arguments, no shell) in `folder`, standard input empty.
Outcome run_command(std::vector<std::string> words, const std::filesystem::path& folder);

/// Runs the `recoil` that was built with these tests.
Outcome run_recoil(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

}  // namespace support
