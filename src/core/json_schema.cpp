#include "core/json_schema.hpp"

#include <fmt/format.h>

namespace recoil::json_detail {

Json or_null(Json schema) {
  if (schema.contains("enum")) schema["enum"].push_back(nullptr);
  if (schema.contains("type")) schema["type"] = {schema["type"], "null"};
  return schema;
}

void add_property(Json& object, const std::string& key, Json schema, bool required,
                  const Description& description) {
  if (!description.schema.empty()) schema.merge_patch(Json::parse(description.schema));
  schema["description"] = description.unit.empty()
                              ? std::string(description.meaning)
                              : fmt::format("{} [{}]", description.meaning, description.unit);
  object["properties"][key] = std::move(schema);
  if (required) object["required"].push_back(key);
}

}  // namespace recoil::json_detail
