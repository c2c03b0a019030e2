#pragma once

#include <string>
#include <string_view>
#include <tuple>

#include "core/json.hpp"

/// Results that describe themselves: the JSON Schema and the manual's tables of keys follow from
/// the declaration of their members.
namespace recoil {

/// Declares the members of a struct, as RECOIL_FIELDS lists them, and describes each of them:
/// type, name, meaning, and where they are needed its unit and a part of its JSON Schema:
///
///   struct Goodness {
///     RECOIL_RESULT(
///       (int, dof, "degrees of freedom"),
///       (OrNull<double>, rmse, "root mean square of e - e_model", "1"),
///       (std::string, unit, "unit of the value", "", R"({"const": "m/s"})"))
///   };
///
/// Every member begins as `{}`. The part of the schema adds to what follows from the type: an
/// integer is at least 0, a number is not null, and an enum has its names. A null in it removes a
/// keyword (RFC 7396).
#define RECOIL_RESULT(...)                                                                        \
  RECOIL_EACH(RECOIL_RESULT_MEMBER, __VA_ARGS__)                                                  \
  static constexpr std::string_view field_names = RECOIL_EACH(RECOIL_RESULT_KEY, __VA_ARGS__);    \
  static constexpr json_detail::Description descriptions[] = {                                    \
      RECOIL_EACH(RECOIL_RESULT_TEXT, __VA_ARGS__)};                                              \
  auto fields() { return json_detail::tie_after(0 RECOIL_EACH(RECOIL_RESULT_TIE, __VA_ARGS__)); } \
  auto fields() const {                                                                           \
    return json_detail::tie_after(0 RECOIL_EACH(RECOIL_RESULT_TIE, __VA_ARGS__));                 \
  }

#define RECOIL_RESULT_MEMBER(type, name, ...) type name{};
#define RECOIL_RESULT_KEY(type, name, ...) #name ", "
#define RECOIL_RESULT_TEXT(type, name, ...) {__VA_ARGS__},
#define RECOIL_RESULT_TIE(type, name, ...) , name

/// `macro` of every argument, which is a list in parentheses; at most 64 arguments.
#define RECOIL_EACH(macro, ...) RECOIL_SCAN_64(RECOIL_EACH_FROM(macro, __VA_ARGS__))
#define RECOIL_EACH_FROM(macro, first, ...) \
  macro first __VA_OPT__(RECOIL_EACH_NEXT RECOIL_NO_ARGUMENTS(macro, __VA_ARGS__))
#define RECOIL_EACH_NEXT() RECOIL_EACH_FROM
#define RECOIL_NO_ARGUMENTS ()
#define RECOIL_SCAN_64(...) \
  RECOIL_SCAN_16(RECOIL_SCAN_16(RECOIL_SCAN_16(RECOIL_SCAN_16(__VA_ARGS__))))
#define RECOIL_SCAN_16(...) RECOIL_SCAN_4(RECOIL_SCAN_4(RECOIL_SCAN_4(RECOIL_SCAN_4(__VA_ARGS__))))
#define RECOIL_SCAN_4(...) RECOIL_SCAN(RECOIL_SCAN(RECOIL_SCAN(RECOIL_SCAN(__VA_ARGS__))))
#define RECOIL_SCAN(...) __VA_ARGS__

/// A value that may be null.
template <class Value>
using OrNull = std::optional<Value>;

/// The JSON Schema (draft 2020-12) of what `as_json` writes of a `Value`. It allows no other key.
/// Every key has a description, "meaning [unit]".
template <class Value>
Json schema_of();

namespace json_detail {

/// What the type of a member does not say.
struct Description {
  std::string_view meaning;
  std::string_view unit = {};
  std::string_view schema = {};
};

template <class... Members>
auto tie_after(int, Members&... members) {
  return std::tie(members...);
}

/// `schema`, and null.
Json or_null(Json schema);

/// Adds a property to the schema of an object.
void add_property(Json& object, const std::string& key, Json schema, bool required,
                  const Description& description);

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
