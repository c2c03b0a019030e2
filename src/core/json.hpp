#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/names.hpp"

namespace recoil {

/// Keys keep the order in which they are written, so that two files compare line by line.
using Json = nlohmann::ordered_json;

/// `format_version` of every JSON file. It is raised when a key is removed or changes its meaning,
/// but not when a key is added.
inline constexpr int format_version = 2;

/// Lists the members of a struct that JSON holds, in their order. The key of a member is its name:
///
///   struct NumberRange {
///     double lower = 0.0;
///     double upper = 0.0;
///     RECOIL_FIELDS(lower, upper)
///   };
///
/// `as_json` then writes {"lower": 0.0, "upper": 0.0}, and `read_json` reads it. A member may be
/// - a number, a truth value, a string, or Json itself,
/// - an enum with names: its name,
/// - std::optional: null where it is empty,
/// - `OrAbsent`: no key where it is empty,
/// - `OrReason`: null where it is empty, and the reason under the same key with "_why",
/// - std::vector, std::array, std::pair or std::tuple: a list,
/// - `Named` or std::map by string: an object,
/// - another struct with RECOIL_FIELDS: an object.
/// Numbers that are not finite are null, and null is read as NaN.
#define RECOIL_FIELDS(...)                                      \
  static constexpr std::string_view field_names = #__VA_ARGS__; \
  auto fields() { return std::tie(__VA_ARGS__); }               \
  auto fields() const { return std::tie(__VA_ARGS__); }

/// Values by name, in the order of the JSON object.
template <class Value>
using Named = std::vector<std::pair<std::string, Value>>;

/// A value whose key is omitted if it is empty.
template <class Value>
struct OrAbsent : std::optional<Value> {
  using std::optional<Value>::optional;
};

/// The member `format_version` of a result.
struct FormatVersion {};

/// A value, or the reason why there is none.
template <class Value>
struct OrReason {
  OrReason() = default;
  OrReason(std::optional<Value> stated, std::string reason)
      : value(std::move(stated)), why(std::move(reason)) {}

  std::optional<Value> value;
  std::string why;
};

/// The JSON has another type or shape than the value to be read.
class JsonMismatch : public std::runtime_error {
 public:
  /// @param expected "a number"
  JsonMismatch(const Json& found, const std::string& expected);

  /// Puts `step` ("parameters", "[3]") in front of the path to the value.
  void prepend(const std::string& step);
  /// "'parameters.C_H.value' is a string, not a number".
  const char* what() const noexcept override { return message_.c_str(); }

 private:
  std::string path_;
  std::string problem_;
  std::string message_;
};

/// How to write numbers that are not finite, for which JSON has no notation.
enum class NonFinite {
  null,  ///< null, for results
  word   ///< "inf", "-inf" or "nan", for intermediate results that are read back exactly
};

/// The JSON of a text, discarded (`is_discarded`) if it is none, or nested more deeply than
/// `deepest_json`. Every JSON of a user's file comes through here or through JsonDocument.
Json parse_json(std::string_view text);
inline constexpr int deepest_json = 64;

/// A number as JSON; minus zero becomes zero.
Json number_or_null(double value);

/// The JSON of `value`, as RECOIL_FIELDS describes it.
template <class Value>
Json as_json(const Value& value, NonFinite non_finite = NonFinite::null);

/// Reads JSON that `as_json` has written. A missing key leaves its member unchanged, because newer
/// versions add keys; unknown keys are ignored.
/// @throws JsonMismatch
template <class Value>
void read_json(const Json& json, Value& value);

template <class Value>
Value value_from(const Json& json) {
  Value value{};
  read_json(json, value);
  return value;
}

/// JSON on one line, without a newline at the end; bytes that are not UTF-8 are replaced.
std::string json_line(const Json& json);

/// The text of a JSON file: ends with a newline; bytes that are not UTF-8 are replaced.
/// @param indent spaces per level; -1: all in one line
std::string json_text(const Json& json, int indent = 2);

/// The text of a JSON file that contains `value`.
template <class Value>
std::string text_of(const Value& value, int indent = 2) {
  return json_text(as_json(value), indent);
}

namespace json_detail {

template <class T>
concept HasFields = requires(T& value) {
  T::field_names;
  value.fields();
};

template <class T, template <class...> class Template>
inline constexpr bool is_a = false;
template <template <class...> class Template, class... Args>
inline constexpr bool is_a<Template<Args...>, Template> = true;

template <class T>
inline constexpr bool is_named = false;
template <class Value>
inline constexpr bool is_named<std::vector<std::pair<std::string, Value>>> = true;
template <class Value>
inline constexpr bool is_named<std::map<std::string, Value>> = true;

template <class T>
concept IsTuple = requires {
  std::tuple_size<T>::value;
};

/// The names in "one, two, three".
std::vector<std::string> split_names(std::string_view names);

template <HasFields T>
const std::vector<std::string>& keys_of() {
  static const std::vector<std::string> keys = split_names(T::field_names);
  return keys;
}

Json number_to_json(double value, NonFinite non_finite);
double number_from_json(const Json& json);

/// Calls `visit(key, member)` for every member of a struct.
template <class T, class Visit>
void for_each_field(T& value, const Visit& visit) {
  const std::vector<std::string>& keys = keys_of<std::remove_const_t<T>>();
  std::apply(
      [&](auto&... members) {
        std::size_t index = 0;
        (visit(keys[index++], members), ...);
      },
      value.fields());
}

/// Runs `read`, and prepends `step` to the path of a mismatch.
template <class Step, class Read>
void read_within(const Step& step, const Read& read) {
  try {
    read();
  } catch (JsonMismatch& mismatch) {
    mismatch.prepend(step());
    throw;
  }
}

template <class Member>
void write_field(Json& object, const std::string& key, const Member& member, NonFinite non_finite) {
  if constexpr (is_a<Member, OrAbsent>) {
    if (member) object[key] = as_json(*member, non_finite);
  } else if constexpr (is_a<Member, OrReason>) {
    object[key] = as_json(member.value, non_finite);
    if (object[key].is_null()) object[key + "_why"] = member.why;
  } else {
    object[key] = as_json(member, non_finite);
  }
}

template <class Member>
void read_field(const Json& object, const std::string& key, Member& member) {
  const auto found = object.find(key);
  if (found == object.end()) return;
  read_within([&] { return key; },
              [&] {
                if constexpr (is_a<Member, OrAbsent>) {
                  typename Member::value_type read{};
                  read_json(*found, read);
                  member.emplace(std::move(read));
                } else if constexpr (is_a<Member, OrReason>) {
                  read_json(*found, member.value);
                  if (found->is_null()) read_field(object, key + "_why", member.why);
                } else {
                  read_json(*found, member);
                }
              });
}

template <class Tuple, std::size_t... I>
void read_tuple(const Json& json, Tuple& value, std::index_sequence<I...>) {
  (read_within([] { return "[" + std::to_string(I) + "]"; },
               [&] { read_json(json[I], std::get<I>(value)); }),
   ...);
}

}  // namespace json_detail

template <class Value>
Json as_json(const Value& value, NonFinite non_finite) {
  if constexpr (std::is_same_v<Value, Json> || std::is_integral_v<Value> ||
                std::is_convertible_v<const Value&, std::string_view>) {
    return value;
  } else if constexpr (std::is_same_v<Value, FormatVersion>) {
    return format_version;
  } else if constexpr (std::is_floating_point_v<Value>) {
    return json_detail::number_to_json(value, non_finite);
  } else if constexpr (NamedEnum<Value>) {
    return name_of(value);
  } else if constexpr (json_detail::is_a<Value, std::optional>) {
    return value ? as_json(*value, non_finite) : Json(nullptr);
  } else if constexpr (json_detail::HasFields<Value>) {
    Json object = Json::object();
    json_detail::for_each_field(value, [&](const std::string& key, const auto& member) {
      json_detail::write_field(object, key, member, non_finite);
    });
    return object;
  } else if constexpr (json_detail::is_named<Value>) {
    Json object = Json::object();
    for (const auto& [key, member] : value) object[key] = as_json(member, non_finite);
    return object;
  } else if constexpr (json_detail::IsTuple<Value>) {
    Json list = Json::array();
    std::apply([&](const auto&... items) { (list.push_back(as_json(items, non_finite)), ...); },
               value);
    return list;
  } else {
    Json list = Json::array();
    for (const auto& item : value) {
      list.push_back(as_json<typename Value::value_type>(item, non_finite));
    }
    return list;
  }
}

template <class Value>
void read_json(const Json& json, Value& value) {
  const auto expect = [&](bool right, const char* expected) {
    if (!right) throw JsonMismatch(json, expected);
  };
  if constexpr (std::is_same_v<Value, Json>) {
    value = json;
  } else if constexpr (std::is_same_v<Value, FormatVersion>) {
    expect(json == format_version, "the format_version that this program reads");
  } else if constexpr (std::is_same_v<Value, bool>) {
    expect(json.is_boolean(), "true or false");
    value = json.get<bool>();
  } else if constexpr (std::is_integral_v<Value>) {
    expect(json.is_number_integer(), "an integer");
    expect(json.is_number_unsigned() ? std::in_range<Value>(json.get<std::uint64_t>())
                                     : std::in_range<Value>(json.get<std::int64_t>()),
           "an integer of this size");
    value = json.get<Value>();
  } else if constexpr (std::is_floating_point_v<Value>) {
    value = json_detail::number_from_json(json);
  } else if constexpr (std::is_same_v<Value, std::string>) {
    expect(json.is_string(), "a string");
    value = json.get<std::string>();
  } else if constexpr (NamedEnum<Value>) {
    expect(json.is_string(), "a name");
    const auto named = value_named<Value>(json.get<std::string>());
    expect(named.has_value(), "one of the known names");
    value = *named;
  } else if constexpr (json_detail::is_a<Value, std::optional>) {
    value.reset();
    if (json.is_null()) return;
    typename Value::value_type read{};  // no emplace(): clang 14 has none for nested structs
    read_json(json, read);
    value = std::move(read);
  } else if constexpr (json_detail::HasFields<Value>) {
    expect(json.is_object(), "an object");
    json_detail::for_each_field(value, [&](const std::string& key, auto& member) {
      json_detail::read_field(json, key, member);
    });
  } else if constexpr (json_detail::is_named<Value>) {
    expect(json.is_object(), "an object");
    value.clear();
    for (const auto& entry : json.items()) {
      std::pair<std::string, typename Value::value_type::second_type> read{entry.key(), {}};
      json_detail::read_within([&] { return read.first; },
                               [&] { read_json(entry.value(), read.second); });
      value.insert(value.end(), std::move(read));
    }
  } else if constexpr (json_detail::IsTuple<Value>) {
    constexpr std::size_t size = std::tuple_size_v<Value>;
    expect(json.is_array() && json.size() == size, "a list of the right length");
    json_detail::read_tuple(json, value, std::make_index_sequence<size>());
  } else {
    expect(json.is_array(), "a list");
    value.clear();
    for (std::size_t i = 0; i < json.size(); ++i) {
      typename Value::value_type item{};
      json_detail::read_within([i] { return "[" + std::to_string(i) + "]"; },
                               [&] { read_json(json[i], item); });
      value.push_back(std::move(item));
    }
  }
}

}  // namespace recoil
