#include "data/json_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "data/text.hpp"

namespace recoil {
namespace {

using nlohmann::json;

constexpr int deepest_nesting = 64;

/// Accepts everything and keeps the place of the first syntax error. (The exceptions of the library
/// carry a place only for some errors, not for a number that overflows.)
struct SyntaxCheck : nlohmann::json_sax<json> {
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t position, const std::string& last_token,
                   const json::exception& error) override {
    end = position;
    token = last_token;
    message = error.what();
    overflow = dynamic_cast<const json::out_of_range*>(&error) != nullptr;
    return false;
  }

  /// Where the token that could not be read begins.
  std::size_t offset(std::string_view text) const {
    const std::size_t stop = std::min(end, text.size());
    if (text.substr(0, stop).ends_with(token)) return stop - token.size();
    return stop > 0 ? stop - 1 : 0;
  }

  std::size_t end = 0;
  std::string token;
  std::string message;
  bool overflow = false;
};

/// What is wrong in "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error
/// ...; last read: '...'": neither the place, which the location says, nor the text itself, which
/// may be long.
std::string syntax_problem(const SyntaxCheck& check) {
  if (check.overflow) return "this number is too large for double precision";
  const std::string problem = check.message.substr(0, check.message.find("; last read:"));
  const std::size_t place = problem.find(": ");
  return place == std::string::npos ? problem : problem.substr(place + 2);
}

/// Walks over a text that is known to be JSON and notes where each value begins.
class PositionScan {
 public:
  PositionScan(std::string_view text, const std::string& file) : text_(text), file_(file) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  }

  JsonPositions root() {
    JsonPositions positions;
    value(positions, 0);
    return positions;
  }

 private:
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  void skip_blanks() {
    while (peek() == ' ' || peek() == '\t' || peek() == '\n' || peek() == '\r') ++at_;
  }

  std::string string_token() {
    const std::size_t start = at_++;
    while (peek() != '"') at_ += peek() == '\\' ? 2 : 1;
    ++at_;
    return json::parse(text_.substr(start, at_ - start)).get<std::string>();
  }

  void value(JsonPositions& positions, int depth) {
    skip_blanks();
    positions.value = at_;
    if (depth > deepest_nesting) {
      throw InputError(locate(text_, at_, file_), "lists or objects are nested too deeply",
                       fmt::format("at most {} levels are read", deepest_nesting),
                       "flatten this part");
    }
    if (peek() == '{' || peek() == '[') {
      container(positions, depth);
    } else if (peek() == '"') {
      string_token();
    } else {
      at_ = std::min(text_.find_first_of(",]} \t\r\n", at_), text_.size());
    }
  }

  void container(JsonPositions& positions, int depth) {
    const bool is_object = peek() == '{';
    std::set<std::string> seen;
    do {
      ++at_;  // past the bracket or the comma
      skip_blanks();
      if (peek() == '}' || peek() == ']') break;
      JsonPositions& child = positions.children.emplace_back();
      if (is_object) key(child, seen);
      value(child, depth + 1);
      skip_blanks();
    } while (peek() == ',');
    ++at_;
  }

  void key(JsonPositions& child, std::set<std::string>& seen) {
    child.key = at_;
    child.name = string_token();
    if (!seen.insert(child.name).second) {
      throw InputError(locate(text_, child.key, file_),
                       fmt::format("the key {} appears twice", quote(child.name)), "",
                       "remove one");
    }
    skip_blanks();
    ++at_;  // past the colon
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;
};

}  // namespace

JsonDocument::JsonDocument(std::string text, std::string file)
    : text_(std::move(text)), file_(std::move(file)) {
  SyntaxCheck check;
  if (!json::sax_parse(text_, &check)) {
    throw InputError(at(check.offset(text_)), syntax_problem(check), "the file is not valid JSON",
                     "look at this place and just before it");
  }
  positions_ = PositionScan(text_, file_).root();
  value_ = json::parse(text_);
}

Location JsonDocument::at(std::size_t offset) const { return locate(text_, offset, file_); }

std::optional<JsonNode> JsonNode::find(const std::string& key) const {
  expect(value_->is_object(), "an object { }");
  const auto& children = positions_->children;
  const auto found = std::find_if(children.begin(), children.end(),
                                  [&](const JsonPositions& child) { return child.name == key; });
  if (found == children.end()) return std::nullopt;
  return child(static_cast<std::size_t>(found - children.begin()));
}

JsonNode JsonNode::require(const std::string& key, const std::string& why,
                           const std::string& suggestion) const {
  if (auto member = find(key)) return *member;
  fail(name_.empty() ? fmt::format("the key '{}' is missing", key)
                     : fmt::format("the key '{}' is missing in '{}'", key, name_),
       why, suggestion);
}

std::vector<JsonNode> JsonNode::members() const {
  expect(value_->is_object(), "an object { }");
  std::vector<JsonNode> nodes;
  for (std::size_t i = 0; i < positions_->children.size(); ++i) nodes.push_back(child(i));
  return nodes;
}

std::vector<JsonNode> JsonNode::items() const {
  expect(value_->is_array(), "a list [ ]");
  std::vector<JsonNode> nodes;
  for (std::size_t i = 0; i < positions_->children.size(); ++i) nodes.push_back(child(i));
  return nodes;
}

std::string JsonNode::string() const {
  expect(value_->is_string(), "a string");
  return value_->get<std::string>();
}

double JsonNode::number() const {
  expect(value_->is_number(), "a number");
  return value_->get<double>();
}

void JsonNode::allow_only(const std::vector<std::string>& known) const {
  for (const JsonNode& member : members()) {
    if (std::find(known.begin(), known.end(), member.key()) != known.end()) continue;
    throw InputError(member.where_key(),
                     fmt::format("unknown key {} in '{}'", quote(member.key()), name_), "",
                     did_you_mean(member.key(), known));
  }
}

Location JsonNode::where() const { return document_->at(positions_->value); }

Location JsonNode::where_key() const { return document_->at(positions_->key); }

void JsonNode::fail(const std::string& problem, const std::string& why,
                    const std::string& suggestion) const {
  throw InputError(where(), problem, why, suggestion);
}

JsonNode JsonNode::child(std::size_t index) const {
  const JsonPositions& place = positions_->children[index];
  if (value_->is_array()) {
    return {*document_, value_->at(index), place, fmt::format("{}[{}]", name_, index)};
  }
  return {*document_, value_->at(place.name), place,
          name_.empty() ? place.name : fmt::format("{}.{}", name_, place.name)};
}

void JsonNode::expect(bool right_type, const std::string& type) const {
  if (right_type) return;
  fail(fmt::format("{} is {} {}", name_.empty() ? "the document" : fmt::format("'{}'", name_),
                   value_->is_array() || value_->is_object() ? "an" : "a", value_->type_name()),
       "", fmt::format("write {}", type));
}

}  // namespace recoil
