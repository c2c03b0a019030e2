#pragma once

#include <optional>
#include <span>
#include <string_view>

/// What Li, X., Dunn, P. F. & Brach, R. M. (1999), J. Aerosol Sci. 30, 439-449, state in Table 1,
/// in Figures 3 to 12 and in the text about them.
namespace recoil::paper {

/// A table or figure of the paper: a section of the page.
struct Part {
  std::string_view id;       ///< "fig-7"
  std::string_view name;     ///< "Fig. 7"
  std::string_view subject;  ///< what it shows
};

/// How a statement is compared.
enum class Kind {
  number,    ///< the paper prints a number
  claim,     ///< the paper says something in words, which holds or not
  obstacle,  ///< it cannot be compared: `words` say what is missing
};

/// One statement of the paper. Symbols and units in its words are in braces, as `say` reads them.
struct Statement {
  std::string_view part;   ///< Part::id
  std::string_view id;     ///< name of the finding that it is compared with
  std::string_view label;  ///< a few words
  Kind kind = Kind::claim;
  std::string_view words;    ///< the claim; or why nothing can be compared
  double printed = 0.0;      ///< the number, in `unit`
  std::string_view unit;     ///< "1": a pure number
  double tolerance = 0.0;    ///< largest |ratio - 1| that still agrees [1]: the digits of the paper
  bool is_built_in = false;  ///< the points were reconstructed so that it holds
};

std::span<const Part> parts();
std::span<const Statement> statements();

/// Does `found` agree with the printed number?
bool agrees(const Statement& statement, double found);

}  // namespace recoil::paper
