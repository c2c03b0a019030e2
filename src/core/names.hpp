#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace recoil {

template <class... Names>
constexpr std::array<std::string_view, sizeof...(Names)> name_list(Names... names) {
  return {names...};
}

/// An enum whose values have names: beside it stands a function `names_of_values` that returns them
/// in the order of the values, which count from 0 without a gap.
///
///   constexpr auto names_of_values(MechanismKind) { return name_list("physics", "measurement"); }
template <class Enum>
concept NamedEnum = requires(Enum value) {
  names_of_values(value).size();
};

template <NamedEnum Enum>
inline constexpr std::size_t count_of = names_of_values(Enum{}).size();

template <NamedEnum Enum>
constexpr std::string_view name_of(Enum value) {
  return names_of_values(value).at(static_cast<std::size_t>(value));
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
  constexpr auto names = names_of_values(Enum{});
  return {names.begin(), names.end()};
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
