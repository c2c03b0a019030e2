#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace recoil {

/// The tables of the manual that are made from the code. A page holds each between two comments:
///   <!-- made by ./run docs: units -->
///   ...
///   <!-- end -->
std::vector<std::string> reference_block_names();

/// @param page Markdown; what stands in its blocks is replaced
/// @param file for messages
/// @throws InputError for a block that has no end, or that nobody makes
std::string with_reference_blocks(const std::string& page, const std::string& file,
                                  const CLI::App& program);

}  // namespace recoil
