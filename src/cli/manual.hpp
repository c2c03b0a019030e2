#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace recoil {

/// A page of docs/, carried along in the program.
struct ManualPage {
  std::string_view topic;  ///< the file's name without its ending
  std::string_view text;   ///< Markdown

  /// What its first line says, without the mark of a heading.
  std::string_view title() const;
};

/// In the order in which one would read them.
std::span<const ManualPage> manual_pages();

/// The page `topic`; null when there is none.
const ManualPage* find_manual_page(std::string_view topic);

std::vector<std::string> manual_topics();

}  // namespace recoil
