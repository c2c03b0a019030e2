#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace recoil {

/// A value of a JSON text and its place.
struct JsonValue {
  nlohmann::json scalar;            ///< {} or [] for an object or a list
  std::string key;                  ///< of a member; empty for list items and the root
  std::size_t key_at = 0;           ///< offset of the key [bytes]
  std::size_t at = 0;               ///< offset of the value [bytes]
  std::vector<JsonValue> children;  ///< members or items, in the order of the file
};

class JsonDocument;

/// Typed access to one value of a JsonDocument. Every error has line and column. The document has
/// to outlive it.
class JsonNode {
 public:
  JsonNode(const JsonDocument& document, const JsonValue& value, std::string name)
      : document_(&document), value_(&value), name_(std::move(name)) {}

  /// The member `key`, if there is one. @throws InputError if this is not an object
  std::optional<JsonNode> find(const std::string& key) const;

  /// The member `key`. @throws InputError with `why` and `suggestion` if it is missing
  JsonNode require(const std::string& key, const std::string& why,
                   const std::string& suggestion) const;

  /// All members of an object in the order of the file. @throws InputError if this is not an object
  std::vector<JsonNode> members() const;

  /// All items of a list. @throws InputError if this is not a list
  std::vector<JsonNode> items() const;

  bool is_object() const { return value_->scalar.is_object(); }
  /// A string, a number, true, false or null; empty for a list or an object.
  const nlohmann::json& scalar() const { return value_->scalar; }

  /// @throws InputError if this is not a string (a number)
  std::string string() const;
  double number() const;

  /// Refuses members outside `known`, naming the nearest known one. @throws InputError
  void allow_only(const std::vector<std::string>& known) const;

  const std::string& key() const { return value_->key; }
  /// The path to this value from the root: "recoil.particle.density".
  const std::string& name() const { return name_; }
  Location where() const;
  Location where_key() const;

  [[noreturn]] void fail(const std::string& problem, const std::string& why,
                         const std::string& suggestion) const;

 private:
  JsonNode child(std::size_t index) const;
  std::vector<JsonNode> children() const;
  void expect(bool right_type, const std::string& type) const;

  const JsonDocument* document_;
  const JsonValue* value_;
  std::string name_;
};

/// A JSON text (RFC 8259) with the place of every value. It refuses a key that appears twice in an
/// object, because one of the two would be ignored.
class JsonDocument {
 public:
  /// @throws InputError with line and column when the text is not JSON or nested too deeply.
  JsonDocument(std::string text, std::string file);
  JsonDocument(const JsonDocument&) = delete;
  JsonDocument& operator=(const JsonDocument&) = delete;

  JsonNode root() const { return {*this, root_, ""}; }
  Location at(std::size_t offset) const;

 private:
  std::string text_;
  std::string file_;
  JsonValue root_;
};

}  // namespace recoil
