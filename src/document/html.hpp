#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "document/document.hpp"

/// Documents as self-contained pages: style sheet and pictures inside, no script, no network.
namespace recoil {

/// `text` with the characters that mean something to HTML replaced, in content and attributes.
std::string escape_html(std::string_view text);

/// The words alone, symbols and units set as such.
std::string html_of(const Sentence& sentence);

/// Blocks without a page around them.
std::string html_of(const std::vector<Block>& blocks);

/// The whole file, its pictures drawn.
std::string html_page(const Document& document);

/// The style sheet of every page: light and dark, screen, phone and paper.
std::string_view style_sheet();

/// The JavaScript of every page with pictures: beside each of them links that save it as SVG and
/// its data as CSV. save.js, embedded when the program is built.
std::string_view save_script();

}  // namespace recoil
