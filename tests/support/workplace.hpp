#pragma once

#include <string>
#include <vector>

#include "support/command.hpp"
#include "support/temporary_folder.hpp"

namespace support {

/// The words of a command line.
using Words = std::vector<std::string>;

inline Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// A folder to work in as a user does, with a valid dataset `data/` (two sizes, a captured point)
/// and a valid `fit.toml` in it.
class Workplace : public TemporaryFolder {
 public:
  Workplace();

  /// Runs `recoil` in this folder.
  Outcome run(const std::vector<std::string>& arguments) const;
};

}  // namespace support
