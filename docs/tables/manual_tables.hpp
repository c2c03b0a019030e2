#pragma once

#include <string>

#include "cli/program.hpp"

namespace recoil {

/// A page of the manual or a Python file with a new text in all parts that the code makes. In a
/// page, such a part is between two comments,
///   <!-- made by ./run docs: units -->
///   ...
///   <!-- end -->
/// and in Python between `# made by ./run docs: arguments of pair` and `# end`.
/// @param file its name in messages
/// @throws InputError for a part without an end, and for one that the code does not make
std::string with_made_parts(const std::string& text, const std::string& file,
                            const Program& program);

/// The man page of the program: every command with its options.
std::string man_page(const Program& program);

/// The completion of commands, options and words for bash.
std::string bash_completion(const Program& program);

}  // namespace recoil
