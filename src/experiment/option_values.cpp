#include "experiment/option_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

/// The number at the start of a word and what follows it.
std::optional<std::pair<double, std::string>> number_and_rest(const std::string& word) {
  const std::string_view text = trimmed(word);
  for (std::size_t length = text.size(); length > 0; --length) {
    if (const auto value = parse_number(std::string_view(text).substr(0, length))) {
      return std::pair{*value, std::string(trimmed(text.substr(length)))};
    }
  }
  return std::nullopt;
}

}  // namespace

double value_with_unit(const std::string& word, Dimension dimension, const std::string& option) {
  const std::vector<std::string> names = unit_names(dimension);
  if (const auto parts = number_and_rest(word)) {
    const bool plain = dimension == Dimension::ratio && parts->second.empty();
    const auto factor = plain ? 1.0 : unit_factor(dimension, parts->second);
    if (factor) return parts->first * *factor;
  }
  throw InputError({}, fmt::format("{} {} is not a number with a unit", option, quote(word)),
                   fmt::format("units are {}", join(names)),
                   fmt::format("write for example 4.9{}", names.front()));
}

StatedError stated_error(const std::string& word, Dimension dimension, const std::string& option) {
  StatedError error;
  if (word.empty()) return error;
  const auto parts = number_and_rest(word);
  if (parts && parts->second == "%") {
    error.relative = parts->first / 100.0;
  } else {
    error.absolute = value_with_unit(word, dimension, option);
  }
  if (error.relative < 0.0 || error.absolute < 0.0 || !error.stated()) {
    throw InputError({}, fmt::format("{} {} is not positive", option, quote(word)),
                     "it is a standard deviation", "leave the option out if it is not known");
  }
  return error;
}

std::vector<std::string> split_list(std::string_view text) {
  std::vector<std::string> parts;
  std::string part;
  bool quoted = false;
  for (const char c : text) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      parts.emplace_back(trimmed(part));
      part.clear();
    } else {
      part += c;
    }
  }
  parts.emplace_back(trimmed(part));
  std::erase(parts, "");
  return parts;
}

std::optional<std::pair<std::string, std::string>> split_pair(const std::string& word) {
  const std::size_t at = word.find('=');
  if (at == std::string::npos) return std::nullopt;
  return std::pair{std::string(trimmed(std::string_view(word).substr(0, at))),
                   std::string(trimmed(std::string_view(word).substr(at + 1)))};
}

}  // namespace recoil
