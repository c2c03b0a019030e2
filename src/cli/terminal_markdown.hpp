#pragma once

#include <string>
#include <string_view>

namespace recoil {

/// The Markdown of the manual as text for a terminal: paragraphs and lists filled, tables aligned,
/// code indented, links written out. Of Markdown it knows what docs/ uses: headings, paragraphs,
/// lists, tables with pipes, fenced or indented code, links, emphasis, comments.
/// @param width columns that no line exceeds, code apart
std::string terminal_text(std::string_view markdown, std::size_t width = 100);

}  // namespace recoil
