#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "document/document.hpp"

/// Documents as plain text, at most `columns` characters wide. Titles of sections are in double
/// brackets. Figures are omitted.
namespace recoil {

inline constexpr std::size_t terminal_columns = 80;
inline constexpr std::size_t most_columns = 100;  ///< of a wide terminal, and of a pipe

/// The width of standard output: that of the variable COLUMNS or of the terminal, limited to 60 to
/// `most_columns`, which is also that of a pipe.
std::size_t output_columns();

/// Wraps `text` at spaces into lines of at most `width` code points. All lines but the first are
/// indented by `indent` spaces. A word that is too long is cut.
std::string wrap(std::string_view text, std::size_t width, std::size_t indent);

std::vector<std::string> lines_of(std::string_view text);

std::string terminal_text(const Section& section, std::size_t columns = terminal_columns);
/// The sections that are at least as important as `least`, without empty ones.
std::string terminal_text(const std::vector<Section>& sections,
                          Importance least = Importance::detail,
                          std::size_t columns = terminal_columns);
std::string terminal_text(const Table& table, std::size_t indent = 4,
                          std::size_t columns = terminal_columns);

}  // namespace recoil
