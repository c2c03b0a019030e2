#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "document/html.hpp"
#include "report/figures.hpp"

namespace recoil {

/// Escaped prose in which the symbols of the model (C_H, C_A, f0, W_A, V_a, V*) are set as such,
/// "um" and "+/-" as characters.
std::string prose_html(std::string_view text);

/// A parameter's label as a symbol: "C_A[x]" becomes C with subscript A and (x).
std::string parameter_html(const std::string& label);

/// A table that scrolls inside its own box on a narrow screen.
struct HtmlTable {
  std::string caption;                         ///< plain text, may be empty
  std::vector<std::string> head;               ///< HTML
  std::vector<std::vector<std::string>> rows;  ///< HTML cells; the first of a row is its heading
  std::vector<std::size_t> words;              ///< columns of prose: left-aligned, wrapped
  bool compact = false;                        ///< small type, for many rows
};
std::string table_html(const HtmlTable& table);

/// A grid of figures with their captions, drawn together: two columns on a wide screen, one on a
/// phone.
/// @throws ComputationError when gnuplot cannot be run.
std::string figures_html(std::vector<Figure> figures);

/// The banner that says where the points come from, one per (label, sentence).
std::string provenance_html(const std::vector<std::pair<std::string, std::string>>& provenances);

/// `<section>` with a heading; `body` is HTML.
std::string section_html(const std::string& id, const std::string& heading,
                         const std::string& body);

/// The whole file: head with the style sheet, `body`, and a foot line with the version.
std::string page_html(const std::string& title, const std::string& body);

}  // namespace recoil
