#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace recoil {

/// The names of the values of an enum. Specialise it beside the enum with the names in the order of
/// the values, which count from 0 without a gap:
///
///   enum class IntervalKind { wald, profile };
///   template <>
///   struct NamesOf<IntervalKind> {
///     static constexpr std::array<std::string_view, 2> names = {"wald", "profile"};
///   };
template <class Enum>
struct NamesOf;

template <class Enum>
concept NamedEnum = requires {
  NamesOf<Enum>::names.size();
};

/// The number of values of `Enum`.
template <NamedEnum Enum>
inline constexpr std::size_t count_of = NamesOf<Enum>::names.size();

template <NamedEnum Enum>
constexpr std::string_view name_of(Enum value) {
  return NamesOf<Enum>::names.at(static_cast<std::size_t>(value));
}

template <NamedEnum Enum>
std::string to_string(Enum value) {
  return std::string(name_of(value));
}

/// Every value, in order.
template <NamedEnum Enum>
constexpr std::array<Enum, count_of<Enum>> values_of() {
  std::array<Enum, count_of<Enum>> values{};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<Enum>(i);
  return values;
}

/// Every name, in the order of the values.
template <NamedEnum Enum>
std::vector<std::string> all_names() {
  return {NamesOf<Enum>::names.begin(), NamesOf<Enum>::names.end()};
}

/// The value with this name; nullopt for an unknown name.
template <NamedEnum Enum>
constexpr std::optional<Enum> value_named(std::string_view name) {
  for (const Enum value : values_of<Enum>()) {
    if (name_of(value) == name) return value;
  }
  return std::nullopt;
}

/// One entry for every value of an enum.
template <NamedEnum Enum, class Entry>
class PerValue {
 public:
  Entry& operator[](Enum value) { return entries_.at(static_cast<std::size_t>(value)); }
  const Entry& operator[](Enum value) const { return entries_.at(static_cast<std::size_t>(value)); }

 private:
  std::array<Entry, count_of<Enum>> entries_{};
};

}  // namespace recoil
