#include "estimate/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "data/text.hpp"
#include "data/toml_number.hpp"

namespace recoil {

Location TomlReader::at(const toml::source_region& region) const {
  return {file_, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

void TomlReader::fail(const toml::node& node, const std::string& problem, const std::string& why,
                      const std::string& suggestion) const {
  throw InputError(at(node.source()), problem, why, suggestion);
}

void TomlReader::wrong_type(const toml::node& node, const std::string& name,
                            const std::string& wanted, const std::string& example) const {
  std::ostringstream found;
  found << node.type();
  fail(node, fmt::format("'{}' is of the type {}", name, found.str()),
       fmt::format("it has to be {}", wanted), fmt::format("for example {}", example));
}

void TomlReader::allow_only(const toml::table& table, const std::string& name,
                            const std::vector<std::string>& known) const {
  for (const auto& [key, value] : table) {
    const std::string word(key.str());
    if (std::find(known.begin(), known.end(), word) != known.end()) continue;
    throw InputError(at(key.source()), fmt::format("unknown key {}", quote(word)),
                     fmt::format("{} would ignore it silently", name), did_you_mean(word, known));
  }
}

const toml::table* TomlReader::table(const toml::table& parent, const std::string& name) const {
  const toml::node* const node = parent.get(name);
  if (node == nullptr) return nullptr;
  if (!node->is_table()) wrong_type(*node, name, "a table", fmt::format("[{}]", name));
  return node->as_table();
}

std::string TomlReader::string(const toml::node& node, const std::string& name,
                               const std::string& example) const {
  if (!node.is_string()) wrong_type(node, name, "a string", example);
  return node.as_string()->get();
}

double TomlReader::number(const toml::node& node, const std::string& name) const {
  if (!node.is_number()) wrong_type(node, name, "a number", fmt::format("{} = 0.5", name));
  const std::optional<double> value = finite_number(node);
  if (!value) {
    fail(node, fmt::format("'{}' is {}", name, node.as_floating_point()->get()),
         "it has to be a finite number", "write a number");
  }
  return *value;
}

std::int64_t TomlReader::integer(const toml::node& node, const std::string& name) const {
  if (!node.is_integer()) {
    wrong_type(node, name, "a whole number", fmt::format("{} = 1999", name));
  }
  return node.as_integer()->get();
}

bool TomlReader::boolean(const toml::node& node, const std::string& name) const {
  if (!node.is_boolean()) {
    wrong_type(node, name, "true or false", fmt::format("{} = false", name));
  }
  return node.as_boolean()->get();
}

}  // namespace recoil
