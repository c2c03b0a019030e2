#include "data/json_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "core/json.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

using nlohmann::json;

/// Parses objects and lists and records the place of every value. The JSON library parses strings,
/// numbers and words.
class Parser {
 public:
  Parser(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  JsonValue document() {
    JsonValue root;
    read_value(root, 0);
    skip_blanks();
    if (at_ < text_.size()) fail(at_, "there is text after the end of the JSON value");
    return root;
  }

 private:
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  void skip_blanks() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()); }

  void read_value(JsonValue& value, int depth) {
    skip_blanks();
    value.at = at_;
    if (depth > deepest_json) {
      throw InputError(locate(text_, at_, file_), "lists or objects are nested too deeply",
                       fmt::format("at most {} levels are read", deepest_json),
                       "flatten this part");
    }
    if (peek() == '{' || peek() == '[') {
      read_container(value, depth);
    } else {
      value.scalar = token();
    }
  }

  void read_container(JsonValue& container, int depth) {
    const bool is_object = peek() == '{';
    const char closing = is_object ? '}' : ']';
    container.scalar = is_object ? json::object() : json::array();
    ++at_;
    skip_blanks();
    std::set<std::string> keys;
    for (bool more = peek() != closing; more; more = peek() == ',') {
      if (!container.children.empty()) ++at_;  // past the comma
      JsonValue& child = container.children.emplace_back();
      if (is_object) read_key(child, keys);
      read_value(child, depth + 1);
      skip_blanks();
    }
    if (peek() != closing) fail(at_, fmt::format("a comma or '{}' is missing here", closing));
    ++at_;
  }

  void read_key(JsonValue& child, std::set<std::string>& keys) {
    skip_blanks();
    child.key_at = at_;
    if (peek() != '"') fail(at_, "a key in quotes is missing here");
    child.key = token().get<std::string>();
    if (!keys.insert(child.key).second) {
      throw InputError(locate(text_, child.key_at, file_),
                       fmt::format("the key {} appears twice", quote(child.key)), "", "remove one");
    }
    skip_blanks();
    if (peek() != ':') fail(at_, "a colon is missing here");
    ++at_;
  }

  /// A string, a number, true, false or null.
  json token() {
    const std::size_t begin = at_;
    if (begin == text_.size()) fail(begin, "the text ends where a value is missing");
    if (peek() == '"') {
      do {
        at_ += peek() == '\\' ? 2 : 1;
      } while (at_ < text_.size() && peek() != '"');
      if (at_ >= text_.size()) fail(begin, "this string is never closed");
      ++at_;
    } else {
      at_ = std::min(text_.find_first_of(",:[]{}\" \t\r\n", begin), text_.size());
    }
    const std::string_view word = text_.substr(begin, at_ - begin);
    json value = json::parse(word, nullptr, false);
    if (!value.is_discarded()) return value;
    fail(begin, word.starts_with('"')
                    ? "a character of this string has to be written with a backslash"
                    : fmt::format("{} is not a value: a string in quotes, a number in double "
                                  "precision, true, false or null",
                                  quote(word)));
  }

  [[noreturn]] void fail(std::size_t at, const std::string& problem) const {
    throw InputError(locate(text_, at, file_), problem, "the file is not valid JSON",
                     "look at this place and just before it");
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;
};

}  // namespace

JsonDocument::JsonDocument(std::string text, std::string file)
    : text_(std::move(text)), file_(std::move(file)), root_(Parser(text_, file_).document()) {}

Location JsonDocument::at(std::size_t offset) const { return locate(text_, offset, file_); }

std::optional<JsonNode> JsonNode::find(const std::string& key) const {
  expect(value_->scalar.is_object(), "an object { }");
  for (std::size_t i = 0; i < value_->children.size(); ++i) {
    if (value_->children[i].key == key) return child(i);
  }
  return std::nullopt;
}

JsonNode JsonNode::require(const std::string& key, const std::string& why,
                           const std::string& suggestion) const {
  if (auto member = find(key)) return *member;
  fail(name_.empty() ? fmt::format("the key '{}' is missing", key)
                     : fmt::format("the key '{}' is missing in '{}'", key, name_),
       why, suggestion);
}

std::vector<JsonNode> JsonNode::members() const {
  expect(value_->scalar.is_object(), "an object { }");
  return children();
}

std::vector<JsonNode> JsonNode::items() const {
  expect(value_->scalar.is_array(), "a list [ ]");
  return children();
}

std::string JsonNode::string() const {
  expect(value_->scalar.is_string(), "a string");
  return value_->scalar.get<std::string>();
}

double JsonNode::number() const {
  expect(value_->scalar.is_number(), "a number");
  return value_->scalar.get<double>();
}

void JsonNode::allow_only(const std::vector<std::string>& known) const {
  for (const JsonNode& member : members()) {
    if (std::ranges::find(known, member.key()) != known.end()) continue;
    throw InputError(member.where_key(),
                     fmt::format("unknown key {} in '{}'", quote(member.key()), name_), "",
                     did_you_mean(member.key(), known));
  }
}

Location JsonNode::where() const { return document_->at(value_->at); }

Location JsonNode::where_key() const { return document_->at(value_->key_at); }

void JsonNode::fail(const std::string& problem, const std::string& why,
                    const std::string& suggestion) const {
  throw InputError(where(), problem, why, suggestion);
}

JsonNode JsonNode::child(std::size_t index) const {
  const JsonValue& value = value_->children[index];
  if (value_->scalar.is_array()) return {*document_, value, fmt::format("{}[{}]", name_, index)};
  return {*document_, value, name_.empty() ? value.key : fmt::format("{}.{}", name_, value.key)};
}

std::vector<JsonNode> JsonNode::children() const {
  std::vector<JsonNode> nodes;
  for (std::size_t i = 0; i < value_->children.size(); ++i) nodes.push_back(child(i));
  return nodes;
}

void JsonNode::expect(bool right_type, const std::string& type) const {
  if (right_type) return;
  fail(fmt::format("{} is {} {}", name_.empty() ? "the document" : fmt::format("'{}'", name_),
                   value_->scalar.is_array() || value_->scalar.is_object() ? "an" : "a",
                   value_->scalar.type_name()),
       "", fmt::format("write {}", type));
}

}  // namespace recoil
