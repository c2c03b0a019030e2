#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "document/document.hpp"

/// Documents as self-contained HTML pages, with style sheet, scripts and pictures embedded.
namespace recoil {

/// Escapes `text` for the content or an attribute of an HTML element.
std::string escape_html(std::string_view text);

/// A sentence as inline HTML, with markup for symbols and units.
std::string html_of(const Sentence& sentence);

/// Blocks as HTML, without the page. `labels`: cells of wide tables have labels, which only the
/// style sheet of a page hides.
std::string html_of(const Blocks& blocks, bool labels = true);

/// Sections as HTML for a notebook: without the page and labels. Titles are headings of the third
/// level.
std::string html_of(const std::vector<Section>& sections);

/// A complete HTML file. Pictures are drawn.
std::string html_page(const Document& document);

/// The style sheet of every page: light and dark, screen, phone and paper.
std::string_view style_sheet();

/// The JavaScript of every page with pictures (save.js). It adds links that save a picture as SVG,
/// PNG or PDF and its data as CSV.
std::string_view save_script();

}  // namespace recoil
