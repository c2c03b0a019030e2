#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "document/document.hpp"

/// Documents as plain text, at most `columns` characters wide, in blocks with their name in double
/// brackets. Figures are not shown; what a page folds stands open.
namespace recoil {

inline constexpr std::size_t terminal_columns = 100;  ///< at most, and wherever nothing is known

/// The width for standard output: that of the terminal or of the variable COLUMNS, from 60 to
/// `terminal_columns`.
std::size_t output_columns();

/// `text` in lines of at most `width` characters (code points), broken at spaces, every line after
/// the first behind `indent` spaces; a word that is too long is cut.
std::string wrap(std::string_view text, std::size_t width, std::size_t indent);

/// The lines of a text.
std::vector<std::string> lines_of(std::string_view text);

std::string terminal_text(const Section& section, std::size_t columns = terminal_columns);
/// Sections down to an importance, without those that are empty.
std::string terminal_text(const std::vector<Section>& sections,
                          Importance least = Importance::detail,
                          std::size_t columns = terminal_columns);
std::string terminal_text(const Table& table, std::size_t indent = 4,
                          std::size_t columns = terminal_columns);

}  // namespace recoil
