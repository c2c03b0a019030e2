#pragma once

#include <string>
#include <string_view>
#include <tuple>

#include "core/json.hpp"

/// Results that describe themselves: the JSON Schemas and the manual's tables of keys
/// (docs/tables) follow from the declaration of their members.
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

template <class Value>
using OrNull = std::optional<Value>;

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

}  // namespace json_detail

}  // namespace recoil
