#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options.hpp"

namespace recoil {

/// A page of docs/, embedded in the program.
struct ManualPage {
  std::string_view topic;  ///< the name of its file without the ending
  std::string_view text;   ///< Markdown

  /// Its first line, without the mark of a heading.
  std::string_view title() const;
};

/// All pages, in the order in which one would read them.
std::span<const ManualPage> manual_pages();

/// The names of the tables of the manual that are made from the code. A page holds each between two
/// comments:
///   <!-- made by ./run docs: units -->
///   ...
///   <!-- end -->
std::vector<std::string> manual_table_names();

/// `page` with new text in all of its tables.
/// @param file for messages
/// @throws InputError for a table that has no end, or that the code does not make
std::string with_manual_tables(const std::string& page, const std::string& file,
                               const Program& program);

}  // namespace recoil
