#include "data/datapackage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/units.hpp"
#include "data/json_document.hpp"
#include "data/system.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

/// A field name of the format. `dimension` has no meaning for `series`, which is text.
struct KnownField {
  std::string_view name;
  Quantity quantity;
  Dimension dimension;
};

constexpr std::array<KnownField, 10> known_fields = {{
    {"series", Quantity::series, Dimension::count},
    {"diameter", Quantity::diameter, Dimension::length},
    {"incident_velocity", Quantity::incident_velocity, Dimension::velocity},
    {"restitution", Quantity::restitution, Dimension::ratio},
    {"rebound_velocity", Quantity::rebound_velocity, Dimension::velocity},
    {"restitution_sd", Quantity::restitution_sd, Dimension::ratio},
    {"velocity_sd", Quantity::velocity_sd, Dimension::velocity},
    {"diameter_sd", Quantity::diameter_sd, Dimension::length},
    {"events", Quantity::events, Dimension::count},
    {"captured", Quantity::captured, Dimension::count},
}};

std::vector<std::string> field_names() {
  std::vector<std::string> names;
  for (const KnownField& known : known_fields) names.emplace_back(known.name);
  return names;
}

bool is_count(Quantity quantity) {
  return quantity == Quantity::events || quantity == Quantity::captured;
}

/// Frictionless `type` of a field. @returns whether it asks for whole numbers.
bool read_type(const JsonNode& field, const KnownField& known) {
  const JsonNode type =
      field.require("type", "the schema says what the cells are",
                    known.quantity == Quantity::series ? "write \"string\"" : "write \"number\"");
  const std::string word = type.string();
  std::vector<std::string> allowed = {"number", "integer"};
  if (known.quantity == Quantity::series) allowed = {"string"};
  if (known.quantity == Quantity::captured) allowed.emplace_back("boolean");
  if (std::find(allowed.begin(), allowed.end(), word) == allowed.end()) {
    type.fail(fmt::format("the type {} does not fit the field '{}'", quote(word), known.name),
              "the cells are converted by it", fmt::format("write {}", join(allowed)));
  }
  return word == "integer" || is_count(known.quantity);
}

void read_unit(const JsonNode& field, const KnownField& known, Column& column) {
  const std::vector<std::string> names = unit_names(known.dimension);
  const std::optional<JsonNode> stated = field.find("unit");
  if (!stated && is_count(known.quantity)) return;  // impacts are counted in no other unit
  const JsonNode node =
      field.require("unit", fmt::format("the cells of '{}' are converted by it", known.name),
                    fmt::format("known: {}", join(names)));
  column.unit = node.string();
  if (const auto factor = unit_factor(known.dimension, column.unit)) {
    column.factor = *factor;
    return;
  }
  for (const Dimension other :
       {Dimension::length, Dimension::velocity, Dimension::ratio, Dimension::count}) {
    if (unit_factor(other, column.unit)) {
      node.fail(fmt::format("'{}' in {}", known.name, quote(column.unit)),
                "this unit measures something else", fmt::format("use {}", join(names)));
    }
  }
  node.fail(fmt::format("unknown unit {}", quote(column.unit)),
            fmt::format("'{}' could not be converted", known.name),
            fmt::format("use {}", join(names)));
}

Column read_field(const JsonNode& field) {
  const JsonNode name = field.require("name", "it ties the field to a column",
                                      fmt::format("known: {}", join(field_names())));
  Column column;
  column.name = name.string();
  const auto known = std::find_if(known_fields.begin(), known_fields.end(),
                                  [&](const KnownField& k) { return k.name == column.name; });
  if (known == known_fields.end()) {
    name.fail(fmt::format("unknown field {}", quote(column.name)),
              "its column would be ignored silently", did_you_mean(column.name, field_names()));
  }
  column.quantity = known->quantity;
  column.integer = read_type(field, *known);
  if (column.quantity != Quantity::series) read_unit(field, *known, column);
  return column;
}

const Column* find_column(const std::vector<Column>& columns, Quantity quantity) {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const Column& c) { return c.quantity == quantity; });
  return found == columns.end() ? nullptr : &*found;
}

void check_completeness(const JsonNode& fields, const std::vector<Column>& columns) {
  for (const KnownField& known : known_fields) {
    const bool needed = known.quantity == Quantity::series ||
                        known.quantity == Quantity::diameter ||
                        known.quantity == Quantity::incident_velocity;
    if (needed && find_column(columns, known.quantity) == nullptr) {
      fields.fail(fmt::format("the field '{}' is missing", known.name), "every point needs it",
                  "add it to the schema and the CSV file");
    }
  }
  if (find_column(columns, Quantity::restitution) == nullptr &&
      find_column(columns, Quantity::rebound_velocity) == nullptr) {
    fields.fail("neither 'restitution' nor 'rebound_velocity' is there",
                "the rebound is what is fitted", "add one of them");
  }
}

std::vector<Column> read_fields(const JsonNode& fields) {
  std::vector<Column> columns;
  for (const JsonNode& field : fields.items()) {
    const Column column = read_field(field);
    const auto name_fails = [&](const std::string& problem, const std::string& why) {
      field.find("name")->fail(problem, why, "remove one");
    };
    if (find_column(columns, column.quantity) != nullptr) {
      name_fails(fmt::format("the field '{}' stands here twice", column.name),
                 "only one could count");
    }
    columns.push_back(column);
    if (find_column(columns, Quantity::restitution) != nullptr &&
        find_column(columns, Quantity::rebound_velocity) != nullptr) {
      name_fails("both 'restitution' and 'rebound_velocity'", "they could contradict each other");
    }
  }
  check_completeness(fields, columns);
  return columns;
}

/// The points have to travel with their folder, so the path stays inside of it.
std::string read_path(const JsonNode& node) {
  const std::string text = node.string();
  const std::filesystem::path path(text);
  const bool climbs = std::find(path.begin(), path.end(), "..") != path.end();
  if (text.empty() || path.is_absolute() || climbs || !path.has_filename() ||
      text.find("://") != std::string::npos || printable(text) != text) {
    node.fail(fmt::format("the path {} leaves the dataset's folder or names no file", quote(text)),
              "a dataset is one folder that can be copied", "write the file's name: points.csv");
  }
  return text;
}

char read_delimiter(const JsonNode& resource) {
  const auto dialect = resource.find("dialect");
  const auto node = dialect ? dialect->find("delimiter") : std::nullopt;
  if (!node) return ',';
  const std::string text = node->string();
  constexpr std::string_view allowed = ",;|\t";
  if (text.size() != 1 || allowed.find(text[0]) == std::string_view::npos) {
    node->fail(fmt::format("the delimiter is {}", quote(text)),
               "comma, semicolon, bar and tab are read", "save the points with commas");
  }
  return text[0];
}

void read_resource(const JsonNode& root, Package& package) {
  const JsonNode resources = root.require("resources", "it names the file with the points",
                                          "add [{\"path\": \"points.csv\", \"schema\": ...}]");
  const std::vector<JsonNode> items = resources.items();
  if (items.empty()) {
    resources.fail("'resources' is empty", "it names the file with the points",
                   "add {\"path\": \"points.csv\", \"schema\": ...}");
  }
  const JsonNode& resource = items.front();
  const JsonNode path =
      resource.require("path", "it names the file with the points", "write \"points.csv\"");
  package.points_path = read_path(path);
  package.points_where = path.where();
  package.delimiter = read_delimiter(resource);
  const JsonNode schema = resource.require("schema", "it says what the columns are and their units",
                                           "list the fields with name, type and unit");
  if (const auto missing = schema.find("missingValues")) {
    for (const JsonNode& word : missing->items()) package.missing_values.push_back(word.string());
  }
  package.columns = read_fields(schema.require("fields", "it says what the columns are",
                                               "list the fields with name, type and unit"));
}

/// Frictionless: a name is fit for a file name.
std::string read_id(const JsonNode& node) {
  const std::string id = node.string();
  const bool plain = std::all_of(id.begin(), id.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  });
  if (id.empty() || id.front() == '.' || !plain) {
    node.fail(fmt::format("the name {}", quote(id)),
              "it becomes part of file names: letters, digits, '.', '_' and '-'",
              "choose one like wall1990-mica");
  }
  return id;
}

std::vector<std::string> read_sources(const JsonNode& root) {
  std::vector<std::string> lines;
  const auto sources = root.find("sources");
  if (!sources) return lines;
  for (const JsonNode& source : sources->items()) {
    std::string line;
    for (const char* key : {"title", "path", "email"}) {
      const auto part = source.find(key);
      if (!part) continue;
      if (!line.empty()) line += line.ends_with('.') ? " " : ", ";
      line += printable(part->string());
    }
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

}  // namespace

Package read_package(const std::string& text, const std::string& file,
                     const std::string& fallback_id) {
  require_text(text, file);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw InputError({file, 1, 1}, "the file is empty", "it describes the dataset",
                     "start from the datapackage.json of a shipped dataset");
  }
  const JsonDocument document(text, file);
  const JsonNode root = document.root();
  Package package;
  const auto name = root.find("name");
  package.id = name ? read_id(*name) : fallback_id;
  const auto title = root.find("title");
  package.title = title ? printable(title->string()) : package.id;
  package.sources = read_sources(root);
  const JsonNode recoil =
      root.require("recoil", "it states the provenance and the two materials",
                   "add {\"provenance\": ..., \"particle\": {...}, \"surface\": {...}}");
  package.system = read_system(recoil);
  package.provenance = read_provenance(recoil);
  read_resource(root, package);
  return package;
}

}  // namespace recoil
