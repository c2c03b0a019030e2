#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "options/option_type.hpp"

namespace recoil {

/// Stands for the default of an option that has to be given.
inline constexpr std::string_view required = "(required)";

/// One option of one or several commands, or an argument without a name ("FIT"). The command line
/// with its help, the keyword arguments of Python with their docstrings, and the manual's tables
/// are made from such rows.
struct OptionRow {
  std::string_view commands;  ///< "fit report"
  std::string_view name;      ///< "--size-edges", or "FIT" for an argument
  OptionType type;
  std::string_view meaning;         ///< empty: not in help and manual
  std::string_view standard = "";   ///< the default; empty: none
  std::string_view functions = "";  ///< the functions of Python that take it: "fit coverage"
  std::string_view python = "";     ///< its name there

  bool is_argument() const { return !name.starts_with('-'); }
  bool is_required() const { return standard == required; }
  bool is_hidden() const { return meaning.empty(); }
  /// The default; empty if there is none.
  std::string_view default_text() const { return is_required() ? "" : standard; }
};

/// Is `word` among words separated by blanks?
bool has_word(std::string_view words, std::string_view word);

/// Every option of every command, in the order of help and manual.
const std::vector<OptionRow>& option_rows();

std::vector<const OptionRow*> options_of(std::string_view command);

/// The options that are keyword arguments of a function of Python.
std::vector<const OptionRow*> arguments_of(std::string_view function);

/// The meaning with "(required)" or the default.
std::string meaning_words(const OptionRow& row);

}  // namespace recoil
