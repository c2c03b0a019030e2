#include "core/json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace recoil {

JsonMismatch::JsonMismatch(const Json& found, const std::string& expected)
    : std::runtime_error(expected),
      problem_(fmt::format("is {}, not {}", json_line(found).substr(0, 40), expected)),
      message_("the value " + problem_) {}

void JsonMismatch::prepend(const std::string& step) {
  const bool joined = path_.empty() || path_.starts_with('[');
  path_ = joined ? step + path_ : step + "." + path_;
  message_ = fmt::format("'{}' {}", path_, problem_);
}

Json parse_json(std::string_view text) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (in_string) {
      in_string = text[i] != '"';
      if (text[i] == '\\') ++i;  // and what it escapes
    } else if (text[i] == '"') {
      in_string = true;
    } else if (text[i] == '[' || text[i] == '{') {
      // The library parses any depth, but copies and compares it by recursion.
      if (++depth > deepest_json) return Json(Json::value_t::discarded);
    } else if (text[i] == ']' || text[i] == '}') {
      --depth;
    }
  }
  return Json::parse(text, nullptr, false);
}

Json number_or_null(double value) { return json_detail::number_to_json(value, NonFinite::null); }

std::string json_line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string json_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

namespace json_detail {

std::vector<std::string> split_names(std::string_view names) {
  std::vector<std::string> split;
  while (!names.empty()) {
    const std::size_t end = std::min(names.find(','), names.size());
    split.emplace_back(names.substr(0, end));
    names.remove_prefix(std::min(names.find_first_not_of(", ", end), names.size()));
  }
  return split;
}

Json number_to_json(double value, NonFinite non_finite) {
  if (std::isfinite(value)) return value == 0.0 && non_finite == NonFinite::null ? 0.0 : value;
  return non_finite == NonFinite::null ? Json(nullptr) : Json(fmt::format("{}", value));
}

double number_from_json(const Json& json) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (json.is_number()) return json.get<double>();
  if (json.is_null() || json == "nan" || json == "-nan") {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (json == "inf") return infinity;
  if (json == "-inf") return -infinity;
  throw JsonMismatch(json, "a number");
}

}  // namespace json_detail

}  // namespace recoil
