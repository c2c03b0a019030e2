#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/toml_reader.hpp"
#include "validation/recipe/recipe.hpp"

/// Strict reading of structs with RECOIL_FIELDS from TOML: every key of a table is a member and
/// every member but an optional one or a map is there. A member `where` is given the table's place.
namespace recoil {

template <class Value>
void read_toml(const TomlReader& reader, const toml::node& node, const std::string& name,
               Value& value);

template <int lowest>
void read_toml(const TomlReader& reader, const toml::node& node, const std::string& name,
               AtLeast<lowest>& value) {
  const std::int64_t read = reader.integer(node, name);
  value.value = static_cast<int>(read);
  if (read >= lowest && read == value.value) return;
  reader.fail(node, fmt::format("{} = {}", name, read),
              fmt::format("it has to be a whole number, {} or more", lowest), "correct it");
}

template <class Value>
void read_toml(const TomlReader& reader, const toml::node& node, const std::string& name,
               std::optional<Value>& value) {
  Value read{};
  read_toml(reader, node, name, read);
  value = std::move(read);
}

template <class Value>
void read_toml(const TomlReader& reader, const toml::node& node, const std::string& name,
               std::vector<Value>& value) {
  for (const toml::node& item : reader.array(node, name, fmt::format("{} = [..]", name))) {
    read_toml(reader, item, fmt::format("{} number {}", name, value.size() + 1),
              value.emplace_back());
  }
}

template <class Value>
void read_toml(const TomlReader& reader, const toml::node& node, const std::string& name,
               std::map<std::string, Value>& value) {
  for (const auto& [key, item] : reader.table(node, name)) {
    read_toml(reader, item, std::string(key.str()), value[std::string(key.str())]);
  }
}

template <class Value>
void read_toml(const TomlReader& reader, const toml::node& node, const std::string& name,
               Value& value) {
  if constexpr (json_detail::HasFields<Value>) {
    const toml::table& table = reader.table(node, name);
    reader.allow_only(table, name, json_detail::keys_of<Value>());
    if constexpr (requires { value.where; }) value.where = reader.at(table.source());
    json_detail::for_each_field(value, [&](const std::string& key, auto& member) {
      if (const toml::node* own = table.get(key)) {
        read_toml(reader, *own, key, member);
      } else if (!json_detail::is_a<std::decay_t<decltype(member)>, std::optional> &&
                 !json_detail::is_named<std::decay_t<decltype(member)>>) {
        throw InputError(reader.at(table.source()),
                         fmt::format("the key '{}' is missing in {}", key, name), "", "add it");
      }
    });
  } else if constexpr (std::is_same_v<Value, std::string>) {
    value = reader.string(node, name, fmt::format("{} = \"...\"", name));
    if (value.empty()) reader.fail(node, fmt::format("'{}' is empty", name), "", "write a text");
  } else if constexpr (std::is_same_v<Value, double>) {
    value = reader.number(node, name);
  } else {
    value.value = reader.number(node, name);
    constexpr bool positive = std::is_same_v<Value, Positive>;
    if (positive ? value > 0.0 : value >= 0.0) return;
    reader.fail(node,
                fmt::format("{} = {:g}, but it {}", name, value.value,
                            positive ? "has to be positive" : "cannot be negative"),
                "", "see the units in the comments");
  }
}

}  // namespace recoil
