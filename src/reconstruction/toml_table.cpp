#include "reconstruction/toml_table.hpp"

#include <fmt/format.h>

#include "data/toml_number.hpp"

namespace recoil {

Location TomlTable::locate(const toml::node& node) const {
  const toml::source_position begin = node.source().begin;
  return {file_, static_cast<int>(begin.line), static_cast<int>(begin.column)};
}

Location TomlTable::where() const { return locate(table_); }

Location TomlTable::where(const std::string& key) const {
  const toml::node* node = table_.get(key);
  return node != nullptr ? locate(*node) : where();
}

void TomlTable::fail(const std::string& key, const std::string& why,
                     const std::string& suggestion) const {
  throw InputError(where(key), fmt::format("bad value of '{}' in {}", key, name_), why, suggestion);
}

const toml::node& TomlTable::need(const std::string& key, const std::string& kind) {
  asked_.insert(key);
  const toml::node* node = table_.get(key);
  if (node == nullptr) {
    throw InputError(where(), fmt::format("'{}' is missing in {}", key, name_),
                     "a recipe has no hidden defaults", fmt::format("add it as {}", kind));
  }
  return *node;
}

double TomlTable::number(const std::string& key) {
  const std::optional<double> value = finite_number(need(key, "a number"));
  if (!value) fail(key, "it is not a finite number", "write a number");
  return *value;
}

double TomlTable::positive(const std::string& key) {
  const double value = number(key);
  if (!(value > 0.0)) fail(key, "it must be above zero", "see the units in the comments");
  return value;
}

double TomlTable::not_negative(const std::string& key) {
  const double value = number(key);
  if (!(value >= 0.0)) fail(key, "it must not be negative", "use 0 to leave it out");
  return value;
}

std::optional<double> TomlTable::optional_positive(const std::string& key) {
  asked_.insert(key);
  if (!has(key)) return std::nullopt;
  return positive(key);
}

std::int64_t TomlTable::whole(const std::string& key, std::int64_t lowest) {
  const auto value = need(key, "a whole number").value_exact<std::int64_t>();
  if (!value || *value < lowest) {
    fail(key, fmt::format("it must be a whole number from {} on", lowest), "correct it");
  }
  return *value;
}

std::string TomlTable::text(const std::string& key) {
  const auto value = need(key, "a text in quotes").value_exact<std::string>();
  if (!value || value->empty()) fail(key, "it is not a text", "write it in quotes");
  return *value;
}

std::optional<std::vector<std::string>> TomlTable::optional_texts(const std::string& key) {
  asked_.insert(key);
  if (!has(key)) return std::nullopt;
  const toml::array* list = table_.get(key)->as_array();
  if (list == nullptr) fail(key, "it is not a list", "write [\"...\", \"...\"]");
  std::vector<std::string> texts;
  for (const toml::node& item : *list) {
    const auto value = item.value_exact<std::string>();
    if (!value) {
      throw InputError(locate(item), fmt::format("bad entry of '{}' in {}", key, name_),
                       "it is not a text", "write it in quotes");
    }
    texts.push_back(*value);
  }
  return texts;
}

std::optional<std::vector<double>> TomlTable::optional_numbers(const std::string& key) {
  asked_.insert(key);
  if (!has(key)) return std::nullopt;
  const toml::array* list = table_.get(key)->as_array();
  if (list == nullptr || list->empty()) fail(key, "it is not a list of numbers", "write [1, 2]");
  std::vector<double> numbers;
  for (const toml::node& item : *list) {
    const std::optional<double> value = finite_number(item);
    if (!value || !(*value > 0.0)) {
      throw InputError(locate(item), fmt::format("bad entry of '{}' in {}", key, name_),
                       "every entry must be a number above zero", "correct it");
    }
    numbers.push_back(*value);
  }
  return numbers;
}

TomlTable TomlTable::table(const std::string& key) {
  const toml::table* inner = need(key, "a table").as_table();
  if (inner == nullptr) fail(key, "it is not a table", fmt::format("write [{}]", key));
  return {*inner, file_, fmt::format("[{}]", key)};
}

std::optional<TomlTable> TomlTable::optional_table(const std::string& key) {
  asked_.insert(key);
  if (!has(key)) return std::nullopt;
  return table(key);
}

std::vector<TomlTable> TomlTable::tables(const std::string& key) {
  const toml::array* list = need(key, "a list of tables").as_array();
  if (list == nullptr) fail(key, "it is not a list of tables", fmt::format("write [[{}]]", key));
  std::vector<TomlTable> inner;
  for (const toml::node& item : *list) {
    const toml::table* one = item.as_table();
    if (one == nullptr) fail(key, "an entry is not a table", fmt::format("write [[{}]]", key));
    inner.push_back({*one, file_, fmt::format("[[{}]] number {}", key, inner.size() + 1)});
  }
  return inner;
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::string> names;
  for (const auto& [key, value] : table_) names.emplace_back(key.str());
  return names;
}

void TomlTable::finish() const {
  for (const auto& [key, value] : table_) {
    const std::string name(key.str());
    if (asked_.contains(name)) continue;
    const std::string near = nearest_word(name, {asked_.begin(), asked_.end()});
    const toml::source_position begin = key.source().begin;
    throw InputError({file_, static_cast<int>(begin.line), static_cast<int>(begin.column)},
                     fmt::format("unknown key '{}' in {}", name, name_),
                     "a misspelt key must not pass as a default",
                     near.empty() ? "remove it" : fmt::format("did you mean '{}'?", near));
  }
}

}  // namespace recoil
