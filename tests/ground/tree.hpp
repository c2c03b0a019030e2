#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Reading the project's own tree, for the tests of this folder.
namespace tree {

/// The project's root.
std::filesystem::path root();

/// The text of a file; fails the current test when it cannot be read.
std::string text_of(const std::filesystem::path& file);

/// A text cut at its line ends.
std::vector<std::string> lines_of(const std::string& text);

/// All files below `folder` that end in `.cpp` or `.hpp`, sorted.
std::vector<std::filesystem::path> cpp_files(const std::filesystem::path& folder);

/// What git tracks, and what it would track if it were added now. Without git (an unpacked
/// archive): everything but build/ and reports/.
std::vector<std::filesystem::path> project_files();

}  // namespace tree
