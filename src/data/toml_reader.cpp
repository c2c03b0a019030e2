#include "data/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "data/text.hpp"

namespace recoil {
namespace {

constexpr int longest_key = 16;  // parts of a dotted key

/// The place of the last quotation mark of the string that begins at `begin`.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
  const std::string three(3, text[begin]);
  const bool of_lines = text.substr(begin).starts_with(three);
  const bool escapes = text[begin] == '"';
  for (std::size_t i = begin + (of_lines ? 3 : 1); i < text.size(); ++i) {
    if (escapes && text[i] == '\\') {
      ++i;
    } else if (of_lines ? text.substr(i).starts_with(three) : text[i] == text[begin]) {
      return i + (of_lines ? 2 : 0);
    } else if (!of_lines && text[i] == '\n') {
      return i;  // never closed, which the parser reports
    }
  }
  return text.size();
}

/// Refuses long dotted keys. Every part of a key nests the tables deeper, and the TOML library
/// destroys tables by recursion, so that 40,000 parts would overflow the stack. The library limits
/// the nesting of lists and tables in brackets.
void refuse_long_keys(std::string_view text, const std::string& file) {
  int parts = 1;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '#') i = std::min(text.find('\n', i), text.size() - 1);
    if (text[i] == '"' || text[i] == '\'') i = end_of_string(text, i);
    if (i >= text.size()) return;
    if (text[i] == '.') ++parts;
    if (std::string_view("=,[]{}\n").find(text[i]) != std::string_view::npos) parts = 1;
    if (parts <= longest_key) continue;
    throw InputError(locate(text, i, file), "a dotted key is nested too deeply",
                     fmt::format("at most {} parts are read", longest_key), "shorten the key");
  }
}

/// The name of a type of TOML in messages.
const char* type_name(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_array()) return "a list";
  if (node.is_string()) return "a text";
  if (node.is_number()) return "a number";
  return node.is_boolean() ? "true or false" : "a date or time";
}

}  // namespace

Location TomlReader::at(const toml::source_region& region) const {
  return {file_, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

toml::table TomlReader::parse(const std::string& text) const {
  require_text(text, file_);
  refuse_long_keys(text, file_);
  try {
    return toml::parse(text, file_);
  } catch (const toml::parse_error& error) {
    throw InputError(at(error.source()), shortened(printable(error.description()), 120),
                     "the file is not valid TOML", "correct this line");
  }
}

void TomlReader::fail(const toml::node& node, const std::string& problem, const std::string& why,
                      const std::string& suggestion) const {
  throw InputError(at(node.source()), problem, why, suggestion);
}

void TomlReader::wrong_type(const toml::node& node, const std::string& name,
                            const std::string& wanted, const std::string& example) const {
  fail(node, fmt::format("'{}' is {}, not {}", name, type_name(node), wanted), "",
       fmt::format("write for example {}", example));
}

void TomlReader::allow_only(const toml::table& table, const std::string& name,
                            const std::vector<std::string>& known) const {
  for (const auto& [key, value] : table) {
    const std::string word(key.str());
    if (std::ranges::find(known, word) != known.end()) continue;
    throw InputError(at(key.source()), fmt::format("unknown key {} in {}", quote(word), name), "",
                     did_you_mean(word, known));
  }
}

const toml::table* TomlReader::table(const toml::table& parent, const std::string& name) const {
  const toml::node* const node = parent.get(name);
  return node == nullptr ? nullptr : &table(*node, name);
}

const toml::table& TomlReader::table(const toml::node& node, const std::string& name) const {
  if (!node.is_table()) wrong_type(node, name, "a table", fmt::format("[{}]", name));
  return *node.as_table();
}

const toml::array& TomlReader::array(const toml::node& node, const std::string& name,
                                     const std::string& example) const {
  if (!node.is_array()) wrong_type(node, name, "a list", example);
  return *node.as_array();
}

std::string TomlReader::string(const toml::node& node, const std::string& name,
                               const std::string& example) const {
  if (!node.is_string()) wrong_type(node, name, "a text in quotes", example);
  return node.as_string()->get();
}

double TomlReader::number(const toml::node& node, const std::string& name) const {
  if (!node.is_number()) wrong_type(node, name, "a number", fmt::format("{} = 0.5", name));
  if (const auto* whole = node.as_integer()) return static_cast<double>(whole->get());
  const double value = node.as_floating_point()->get();
  if (!std::isfinite(value)) {
    fail(node, fmt::format("'{}' is {}, not a finite number", name, value), "", "write a number");
  }
  return value;
}

double TomlReader::number_in(const toml::node& node, const std::string& name, double lower,
                             double upper, const std::string& suggestion) const {
  const double value = number(node, name);
  if (value < lower || value > upper) {
    fail(node, fmt::format("{} = {:g}", name, value),
         fmt::format("it has to lie between {:g} and {:g}", lower, upper), suggestion);
  }
  return value;
}

std::string TomlReader::one_of(const toml::node& node, const std::string& name,
                               const std::string& what,
                               const std::vector<std::string>& known) const {
  const std::string word = string(node, name, fmt::format("{} = \"{}\"", name, known.front()));
  if (std::ranges::find(known, word) == known.end()) {
    fail(node, fmt::format("unknown {} {}", what, quote(word)), "", did_you_mean(word, known));
  }
  return word;
}

std::int64_t TomlReader::integer(const toml::node& node, const std::string& name) const {
  if (!node.is_integer()) wrong_type(node, name, "a whole number", fmt::format("{} = 1999", name));
  return node.as_integer()->get();
}

bool TomlReader::boolean(const toml::node& node, const std::string& name) const {
  if (!node.is_boolean()) wrong_type(node, name, "true or false", fmt::format("{} = false", name));
  return node.as_boolean()->get();
}

}  // namespace recoil
