#include "core/numbers.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <regex>

namespace recoil {
namespace {

/// The number that is the whole of `text`, which may begin with a plus sign.
template <class Number>
std::optional<Number> parse_all(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, failed] = std::from_chars(text.data(), end, value);
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
  while (std::ranges::any_of(blanks, drop)) {
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
