#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

/// The README and the pages of docs/, as what they promise: files to write, commands to run, output
/// to see.
namespace page {

/// A fenced block.
struct Block {
  std::string language;
  std::string text;
  std::string file;     ///< named in backticks by a paragraph before it that ends with a colon
  bool run = true;      ///< not preceded by <!-- not run: why -->
  int exit_status = 0;  ///< or as <!-- fails: 2 --> before it says
};

std::vector<Block> blocks_of(const std::filesystem::path& markdown);

/// The rows of every table whose header begins with `header`, cells trimmed, without the header.
std::vector<std::vector<std::string>> table_of(const std::filesystem::path& markdown,
                                               const std::string& header);

/// Which column of the first such table has this title.
std::size_t column_of(const std::filesystem::path& markdown, const std::string& header,
                      const std::string& title);

/// A folder of its own with build/release/recoil and build/release/python, datasets and fits,
/// removed at the end.
class Sandbox {
 public:
  Sandbox();

  const std::filesystem::path& folder() const { return folder_.path(); }
  void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }

  struct Outcome {
    int status = -1;
    std::string output;  ///< stdout and stderr
  };
  Outcome run(const std::string& script) const;

  struct Counts {
    int files = 0;
    int scripts = 0;
    std::string output;  ///< of all scripts
  };
  /// Writes the files that the blocks name, runs every `sh` block in order, and expects its exit
  /// status and, where a `text` block follows, the lines of that in its output.
  Counts follow(const std::vector<Block>& blocks) const;

 private:
  support::TemporaryFolder folder_;
};

}  // namespace page
