#include "tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace tree {

namespace fs = std::filesystem;

fs::path root() { return RECOIL_SOURCE_DIR; }

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  EXPECT_TRUE(stream) << "cannot read " << file;
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<fs::path> cpp_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    if (entry.is_regular_file() && (ending == ".cpp" || ending == ".hpp")) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<fs::path> project_files() {
  std::vector<fs::path> files;
  // A clone that belongs to another user is still only read.
  const std::string command = "git -C '" + root().string() +
                              "' -c safe.directory='*' ls-files --cached --others "
                              "--exclude-standard 2>/dev/null";
  if (std::FILE* pipe = popen(command.c_str(), "r")) {
    std::string listing;
    char buffer[4096];
    for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) {
      listing.append(buffer, n);
    }
    pclose(pipe);
    for (const std::string& line : lines_of(listing)) {
      if (fs::is_regular_file(root() / line)) files.push_back(root() / line);
    }
  }
  if (!files.empty()) return files;
  for (auto entry = fs::recursive_directory_iterator(root());
       entry != fs::recursive_directory_iterator(); ++entry) {
    const std::string name = fs::relative(entry->path(), root()).string();
    if (name == "build" || name == "reports" || name == ".git") {
      entry.disable_recursion_pending();
    } else if (entry->is_regular_file()) {
      files.push_back(entry->path());
    }
  }
  return files;
}

}  // namespace tree
