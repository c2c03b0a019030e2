#pragma once

#include <string>
#include <string_view>

namespace recoil {

/// The Markdown of the manual as text for a terminal: paragraphs and lists filled, tables aligned,
/// code indented, links written out. Of Markdown it knows what docs/ uses: headings, paragraphs,
/// lists, tables with pipes, fenced or indented code, links, emphasis, comments.
std::string terminal_markdown(std::string_view markdown);

}  // namespace recoil
