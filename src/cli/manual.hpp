#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options.hpp"

namespace recoil {

/// A page of docs/, embedded in the program.
struct ManualPage {
  std::string_view topic;  ///< the name of its file without the extension
  std::string_view text;   ///< Markdown

  /// Its first line, without the mark of a heading.
  std::string_view title() const;
};

/// All pages in reading order.
std::span<const ManualPage> manual_pages();

/// The names of the manual's tables that the code makes. In a page, a table is between two
/// comments:
///   <!-- made by ./run docs: units -->
///   ...
///   <!-- end -->
std::vector<std::string> manual_table_names();

/// `page` with new text in all of its tables.
/// @param file its name in messages
/// @throws InputError for a table without an end, and for one that the code does not make
std::string with_manual_tables(const std::string& page, const std::string& file,
                               const Program& program);

}  // namespace recoil
