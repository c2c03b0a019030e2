#include "validation/recipe/toml_table.hpp"

#include <fmt/format.h>

namespace recoil {

Location TomlTable::where() const { return reader_.at(table_.source()); }

Location TomlTable::where(const std::string& key) const {
  const toml::node* node = table_.get(key);
  return node != nullptr ? reader_.at(node->source()) : where();
}

void TomlTable::fail(const std::string& key, const std::string& problem, const std::string& why,
                     const std::string& suggestion) const {
  throw InputError(where(key), problem, why, suggestion);
}

const toml::node& TomlTable::need(const std::string& key, const std::string& kind) {
  asked_.insert(key);
  const toml::node* node = table_.get(key);
  if (node == nullptr) {
    throw InputError(where(), fmt::format("the key '{}' is missing in {}", key, name_), "",
                     fmt::format("add it as {}", kind));
  }
  return *node;
}

double TomlTable::number(const std::string& key) {
  return reader_.number(need(key, "a number"), key);
}

double TomlTable::positive(const std::string& key) {
  const double value = number(key);
  if (!(value > 0.0)) {
    fail(key, fmt::format("{} = {:g}, but it has to be positive", key, value), "",
         "see the units in the comments");
  }
  return value;
}

double TomlTable::not_negative(const std::string& key) {
  const double value = number(key);
  if (!(value >= 0.0)) {
    fail(key, fmt::format("{} = {:g}, but it cannot be negative", key, value), "",
         "write 0 to leave it out");
  }
  return value;
}

std::optional<double> TomlTable::optional_positive(const std::string& key) {
  asked_.insert(key);
  if (!has(key)) return std::nullopt;
  return positive(key);
}

std::int64_t TomlTable::whole(const std::string& key, std::int64_t lowest) {
  const std::int64_t value = reader_.integer(need(key, "a whole number"), key);
  if (value < lowest) {
    fail(key, fmt::format("{} = {}", key, value),
         fmt::format("it has to be a whole number, {} or more", lowest), "correct it");
  }
  return value;
}

std::string TomlTable::text(const std::string& key) {
  const toml::node& node = need(key, "a text in quotes");
  std::string value = reader_.string(node, key, fmt::format("{} = \"...\"", key));
  if (value.empty()) fail(key, fmt::format("'{}' is empty", key), "", "write a text in quotes");
  return value;
}

std::optional<std::vector<std::string>> TomlTable::optional_texts(const std::string& key) {
  asked_.insert(key);
  if (!has(key)) return std::nullopt;
  const std::string example = fmt::format("{} = [\"...\", \"...\"]", key);
  std::vector<std::string> texts;
  for (const toml::node& item : reader_.array(*table_.get(key), key, example)) {
    texts.push_back(reader_.string(item, fmt::format("an entry of {}", key), example));
  }
  return texts;
}

std::optional<std::vector<double>> TomlTable::optional_positives(const std::string& key) {
  asked_.insert(key);
  if (!has(key)) return std::nullopt;
  const toml::array& list = reader_.array(*table_.get(key), key, fmt::format("{} = [1, 2]", key));
  if (list.empty()) fail(key, fmt::format("'{}' is an empty list", key), "", "write [1, 2]");
  std::vector<double> numbers;
  for (const toml::node& item : list) {
    numbers.push_back(reader_.number(item, key));
    if (numbers.back() > 0.0) continue;
    reader_.fail(
        item, fmt::format("{:g} in '{}', but every entry has to be positive", numbers.back(), key),
        "", "correct it");
  }
  return numbers;
}

TomlTable TomlTable::table(const std::string& key) {
  return {reader_.table(need(key, "a table"), key), reader_, fmt::format("[{}]", key)};
}

std::optional<TomlTable> TomlTable::optional_table(const std::string& key) {
  asked_.insert(key);
  if (!has(key)) return std::nullopt;
  return table(key);
}

std::vector<TomlTable> TomlTable::tables(const std::string& key) {
  const std::string example = fmt::format("[[{}]]", key);
  std::vector<TomlTable> inner;
  for (const toml::node& item : reader_.array(need(key, "a list of tables"), key, example)) {
    if (!item.is_table()) reader_.wrong_type(item, key, "a list of tables", example);
    inner.push_back(
        {*item.as_table(), reader_, fmt::format("{} number {}", example, inner.size() + 1)});
  }
  return inner;
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::string> names;
  for (const auto& [key, value] : table_) names.emplace_back(key.str());
  return names;
}

void TomlTable::finish() const {
  reader_.allow_only(table_, name_, {asked_.begin(), asked_.end()});
}

}  // namespace recoil
