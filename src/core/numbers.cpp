#include "core/numbers.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <string>
#include <type_traits>

namespace recoil {
namespace {

/// As std::from_chars. libc++ has none for double yet; its strtod also reads blanks and hexadecimal
/// digits.
template <class Number>
std::from_chars_result read_number(const char* first, const char* last, Number& value) {
#ifndef __cpp_lib_to_chars
  if constexpr (std::is_same_v<Number, double>) {
    const std::string text(first, last);
    char* end = nullptr;
    if (text.find_first_not_of("+-.0123456789eE") == std::string::npos && !text.starts_with('+')) {
      value = std::strtod(text.c_str(), &end);
    }
    if (end == nullptr || end == text.c_str()) return {first, std::errc::invalid_argument};
    return {first + (end - text.c_str()), std::errc{}};
  } else
#endif
    return std::from_chars(first, last, value);
}

/// The number that is the whole of `text`, which may begin with a plus sign.
template <class Number>
std::optional<Number> parse_all(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, failed] = read_number(text.data(), end, value);
  if (failed != std::errc{} || stop != end) return std::nullopt;
  return value;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const auto drop = [&](std::string_view blank) {
    const bool before = text.starts_with(blank);
    const bool after = !before && text.ends_with(blank);
    if (before) text.remove_prefix(blank.size());
    if (after) text.remove_suffix(blank.size());
    return before || after;
  };
  const auto letter = [](char c) { return c > ' ' && c < '\x7f'; };  // no byte of a blank
  while (!text.empty() && !(letter(text.front()) && letter(text.back())) &&
         std::ranges::any_of(blanks, drop)) {
  }
  return text;
}

std::optional<double> parse_number(std::string_view text) {
  const std::optional<double> value = parse_all<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::int64_t> parse_whole_number(std::string_view text) {
  return parse_all<std::int64_t>(text);
}

std::optional<std::int64_t> parse_clock_time(std::string_view text) {
  static const std::regex clock("([0-9]{1,4}):([0-5][0-9]):([0-5][0-9])");
  std::cmatch part;
  if (!std::regex_match(text.begin(), text.end(), part, clock)) return std::nullopt;
  const auto number = [&](std::size_t i) { return parse_whole_number(part[i].str()).value(); };
  return 3600 * number(1) + 60 * number(2) + number(3);
}

}  // namespace recoil
