#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "document/document.hpp"

/// Documents as plain text, at most `terminal_columns` characters wide, in blocks with their name
/// in double brackets. Figures are not shown; what a page folds stands open.
namespace recoil {

inline constexpr std::size_t terminal_columns = 100;

/// `text` in lines of at most `width` characters (code points), broken at spaces, every line after
/// the first behind `indent` spaces; a word that is too long is cut.
std::string wrap(std::string_view text, std::size_t width, std::size_t indent);

std::string terminal_text(const Section& section);
/// Sections down to an importance, without those that are empty.
std::string terminal_text(const std::vector<Section>& sections,
                          Importance least = Importance::detail);
std::string terminal_text(const Table& table, std::size_t indent = 4);

}  // namespace recoil
