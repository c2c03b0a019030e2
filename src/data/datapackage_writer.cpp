#include "data/datapackage_writer.hpp"

#include "core/files.hpp"
#include "data/folder_names.hpp"
#include "data/json_document.hpp"

namespace recoil {

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c;
    if (c == '"') quoted += c;
  }
  return quoted + "\"";
}

Json package_field(const std::string& name, const std::string& type, const std::string& unit,
                   const std::string& description) {
  Json field = {{"name", name}, {"type", type}};
  if (!unit.empty()) field["unit"] = unit;
  if (!description.empty()) field["description"] = description;
  return field;
}

Json csv_resource(const std::string& name, const std::string& path, const Json& fields) {
  return {{"name", name},        {"path", path},
          {"format", "csv"},     {"mediatype", "text/csv"},
          {"encoding", "utf-8"}, {"schema", {{"fields", fields}}}};
}

Json stated_system(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / package_file_name;
  const std::string text = read_text_file(file);
  const JsonDocument document(text, file.string());
  document.root()
      .require("recoil", "it holds the materials",
               "name the folder of a dataset with the same materials")
      .members();
  Json system = Json::parse(text)["recoil"];
  for (const char* own : {"provenance", "conditions", "method", "mixed_sizes"}) system.erase(own);
  return system;
}

std::string package_text(const Json& package) {
  return package.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace recoil
