#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

#include "core/json_result.hpp"

namespace recoil {

/// The JSON Schema (draft 2020-12) of what `as_json` writes of a `Value`. It allows no other key.
/// Every key has a description, "meaning [unit]".
template <class Value>
Json schema_of();

namespace json_detail {

/// `schema`, and null.
inline Json or_null(Json schema) {
  if (schema.contains("enum")) schema["enum"].push_back(nullptr);
  if (schema.contains("type")) schema["type"] = {schema["type"], "null"};
  return schema;
}

/// Adds a property to the schema of an object.
inline void add_property(Json& object, const std::string& key, Json schema, bool required,
                         const Description& description) {
  if (!description.schema.empty()) schema.merge_patch(Json::parse(description.schema));
  schema["description"] = description.unit.empty()
                              ? std::string(description.meaning)
                              : fmt::format("{} [{}]", description.meaning, description.unit);
  object["properties"][key] = std::move(schema);
  if (required) object["required"].push_back(key);
}

template <class Member>
void add_field(Json& object, const std::string& key, const Description& description) {
  if constexpr (is_a<Member, OrAbsent>) {
    add_property(object, key, schema_of<typename Member::value_type>(), false, description);
  } else if constexpr (is_a<Member, OrReason>) {
    add_property(object, key, schema_of<decltype(Member::value)>(), true, description);
    add_property(object, key + "_why", schema_of<std::string>(), false,
                 {"the reason, if there is no value"});
  } else {
    add_property(object, key, schema_of<Member>(), true, description);
  }
}

template <HasFields Value>
Json object_schema() {
  Json object = {{"type", "object"},
                 {"properties", Json::object()},
                 {"required", Json::array()},
                 {"additionalProperties", false}};
  const Value value{};
  std::size_t index = 0;
  for_each_field(value, [&](const std::string& key, const auto& member) {
    add_field<std::remove_cvref_t<decltype(member)>>(object, key, Value::descriptions[index++]);
  });
  return object;
}

}  // namespace json_detail

template <class Value>
Json schema_of() {
  if constexpr (std::is_same_v<Value, Json>) {
    return Json::object();
  } else if constexpr (std::is_same_v<Value, FormatVersion>) {
    return {{"const", format_version}};
  } else if constexpr (std::is_same_v<Value, bool>) {
    return {{"type", "boolean"}};
  } else if constexpr (std::is_integral_v<Value>) {
    return {{"type", "integer"}, {"minimum", 0}};
  } else if constexpr (std::is_floating_point_v<Value>) {
    return {{"type", "number"}};
  } else if constexpr (std::is_same_v<Value, std::string>) {
    return {{"type", "string"}};
  } else if constexpr (NamedEnum<Value>) {
    return {{"enum", all_names<Value>()}};
  } else if constexpr (json_detail::is_a<Value, std::optional>) {
    return json_detail::or_null(schema_of<typename Value::value_type>());
  } else if constexpr (json_detail::HasFields<Value>) {
    return json_detail::object_schema<Value>();
  } else if constexpr (json_detail::is_named<Value>) {
    using Entry = typename Value::value_type::second_type;
    return {{"type", "object"}, {"additionalProperties", schema_of<Entry>()}};
  } else {
    Json list = {{"type", "array"}, {"items", schema_of<typename Value::value_type>()}};
    if constexpr (json_detail::IsTuple<Value>) {
      list["minItems"] = std::tuple_size_v<Value>;
      list["maxItems"] = std::tuple_size_v<Value>;
    }
    return list;
  }
}

}  // namespace recoil
