#include "data/datapackage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "core/files.hpp"
#include "data/contact.hpp"
#include "data/dataset.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

bool is_count(Quantity quantity) { return dimension_of(quantity) == Dimension::count; }

std::vector<std::string> read_words(const JsonNode& list) {
  std::vector<std::string> words;
  for (const JsonNode& word : list.items()) words.push_back(word.string());
  return words;
}

/// Refuses the key unless its value is `usual`, which is what the reader does.
void require_usual(const JsonNode& parent, const char* key, const nlohmann::json& usual) {
  const auto node = parent.find(key);
  if (!node || node->scalar() == usual) return;
  node->fail(fmt::format("{} is not supported with this value", quote(key)),
             "recoil would read the cells differently",
             fmt::format("remove it, or write {}", usual.dump()));
}

/// Reads decimalChar and groupChar of Table Schema.
void read_number_format(const JsonNode& field, NumberFormat& format) {
  require_usual(field, "bareNumber", true);
  const auto read = [&](const char* key, std::string& mark) {
    const auto node = field.find(key);
    if (!node) return;
    mark = node->string();
    const bool right = !mark.empty() && mark.find_first_of("0123456789eE+-") == std::string::npos;
    if (!right) node->fail(fmt::format("{} is {}", key, quote(mark)), "", "write \".\" or \",\"");
  };
  read("decimalChar", format.decimal);
  read("groupChar", format.group);
  if (format.decimal != format.group) return;
  field.find("groupChar")->fail("groupChar and decimalChar are equal", "", "correct one of them");
}

void read_constraints(const JsonNode& field, Column& column) {
  const auto constraints = field.find("constraints");
  if (!constraints) return;
  const bool text = dimension_of(column.quantity) == Dimension::text;
  const std::vector<std::string> known =
      text || column.boolean ? std::vector<std::string>{"required"}
                             : std::vector<std::string>{"required", "minimum", "maximum"};
  for (const JsonNode& member : constraints->members()) {
    if (std::ranges::find(known, member.key()) != known.end()) continue;
    member.fail(fmt::format("the constraint {} is not checked", quote(member.key())), "",
                fmt::format("remove it; checked: {}", join(known)));
  }
  if (const auto node = constraints->find("required")) column.required = node->scalar() == true;
  if (const auto node = constraints->find("minimum")) column.minimum = node->number();
  if (const auto node = constraints->find("maximum")) column.maximum = node->number();
}

/// Reads the Frictionless `type` of a field and the keys that depend on it.
void read_type(const JsonNode& field, Column& column) {
  const Quantity quantity = column.quantity;
  const bool text = dimension_of(quantity) == Dimension::text;
  const JsonNode type = field.require("type", "it states how to read the cells",
                                      text ? "write \"string\"" : "write \"number\"");
  const std::string word = type.string();
  std::vector<std::string> allowed = {"number", "integer"};
  if (text) allowed = {"string"};
  // A flag, or a count that is 0 or 1 for a single impact.
  if (is_count(quantity) && quantity != Quantity::events) allowed.emplace_back("boolean");
  if (std::ranges::find(allowed, word) == allowed.end()) {
    type.fail(fmt::format("the type of '{}' is {}", name_of(quantity), quote(word)), "",
              fmt::format("write {}", join(allowed)));
  }
  column.integer = word == "integer" || is_count(quantity);
  column.boolean = word == "boolean";
  require_usual(field, "format", "default");
  column.yes = {"true", "True", "TRUE", "1"};
  column.no = {"false", "False", "FALSE", "0"};
  if (const auto words = field.find("trueValues")) column.yes = read_words(*words);
  if (const auto words = field.find("falseValues")) column.no = read_words(*words);
  if (!text && !column.boolean) read_number_format(field, column.format);
  if (const auto words = field.find("missingValues")) column.missing_values = read_words(*words);
  read_constraints(field, column);
}

void read_unit(const JsonNode& field, Column& column) {
  const Dimension dimension = dimension_of(column.quantity);
  if (!field.find("unit") && is_count(column.quantity)) return;  // counted in no other unit
  const JsonNode node = field.require("unit", "values are converted by it",
                                      fmt::format("use {}", join(unit_names(dimension))));
  column.unit = node.string();
  column.scale =
      known_scale(dimension, column.unit, fmt::format("'{}'", column.name), node.where());
}

Column read_field(const JsonNode& field) {
  const JsonNode name =
      field.require("name", "it links the field to a column",
                    "known: series, diameter, incident_velocity, restitution, ... (docs/data.md)");
  Column column;
  column.name = name.string();
  const auto quantity = value_named<Quantity>(column.name);
  if (!quantity) {
    name.fail(fmt::format("unknown field {}", quote(column.name)), "its column would be ignored",
              did_you_mean(column.name, all_names<Quantity>()));
  }
  column.quantity = *quantity;
  read_type(field, column);
  if (dimension_of(*quantity) != Dimension::text) read_unit(field, column);
  return column;
}

bool has_column(const std::vector<Column>& columns, Quantity quantity) {
  return std::ranges::find(columns, quantity, &Column::quantity) != columns.end();
}

void check_completeness(const JsonNode& fields, const std::vector<Column>& columns) {
  const auto there = [&](Quantity quantity) { return has_column(columns, quantity); };
  for (const Quantity needed :
       {Quantity::series, Quantity::diameter, Quantity::incident_velocity}) {
    if (there(needed)) continue;
    fields.fail(fmt::format("the field '{}' is missing", name_of(needed)), "every point needs it",
                "add it to the schema and the CSV file");
  }
  if (!there(Quantity::restitution) && !there(Quantity::rebound_velocity) &&
      !(there(Quantity::events) && there(Quantity::captured))) {
    fields.fail("neither 'restitution' nor 'rebound_velocity' is there",
                "the rebound is what is fitted",
                "add one of them, or 'events' and 'captured' for bounced fractions");
  }
  const auto tangential =
      std::ranges::find(columns, Quantity::tangential_restitution, &Column::quantity);
  if (tangential != columns.end() && !there(Quantity::incidence_angle)) {
    fields.items()[static_cast<std::size_t>(tangential - columns.begin())].find("name")->fail(
        "'tangential_restitution' is there without 'incidence_angle'",
        "the angle gives the tangential velocity",
        "add the column incidence_angle, from the normal, with the unit deg");
  }
}

std::vector<Column> read_fields(const JsonNode& fields) {
  std::vector<Column> columns;
  for (const JsonNode& field : fields.items()) {
    const Column column = read_field(field);
    const auto name_fails = [&](const std::string& problem, const std::string& why) {
      field.find("name")->fail(problem, why, "remove one");
    };
    if (has_column(columns, column.quantity)) {
      name_fails(fmt::format("the field '{}' appears twice", column.name), "");
    }
    columns.push_back(column);
    if (has_column(columns, Quantity::restitution) &&
        has_column(columns, Quantity::rebound_velocity)) {
      name_fails("both 'restitution' and 'rebound_velocity' are there",
                 "they could contradict each other");
    }
  }
  check_completeness(fields, columns);
  return columns;
}

/// Reads a path inside the dataset's folder, because a dataset is copied as one folder.
std::string read_path(const JsonNode& node) {
  const std::string text = node.string();
  const std::filesystem::path path(text);
  const bool climbs = std::ranges::find(path, "..") != path.end();
  if (text.empty() || path.is_absolute() || climbs || !path.has_filename() ||
      text.find("://") != std::string::npos || printable(text) != text) {
    node.fail(fmt::format("the path {} names no file in the dataset's folder", quote(text)),
              "a dataset is one folder that can be copied",
              "write the file's name, such as points.csv");
  }
  return text;
}

char read_delimiter(const JsonNode& dialect) {
  const auto node = dialect.find("delimiter");
  if (!node) return ',';
  const std::string text = node->string();
  constexpr std::string_view allowed = ",;|\t";
  if (text.size() != 1 || allowed.find(text[0]) == std::string_view::npos) {
    node->fail(fmt::format("the delimiter is {}", quote(text)),
               "only comma, semicolon, vertical bar and tab are read",
               "save the points with commas");
  }
  return text[0];
}

/// Reads CSV Dialect and Table Dialect of Frictionless, which state how a file is split into cells.
void read_dialect(const JsonNode& resource, Package& package) {
  require_usual(resource, "compression", "");
  if (const auto node = resource.find("encoding")) {
    std::string word = node->string();
    std::erase(word, '-');
    for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (word != "utf8") {
      node->fail(fmt::format("the encoding is {}", quote(node->string())), "only UTF-8 is read",
                 "save the points as UTF-8 and write \"utf-8\"");
    }
  }
  const auto dialect = resource.find("dialect");
  if (!dialect) return;
  package.delimiter = read_delimiter(*dialect);
  if (const auto node = dialect->find("header")) {
    if (node->scalar() != true && node->scalar() != false) {
      node->fail("'header' is neither true nor false", "", "write false if there is none");
    }
    package.header = node->scalar() == true;
  }
  if (const auto node = dialect->find("commentChar")) {
    const std::string mark = node->string();
    if (mark.size() != 1) {
      node->fail(fmt::format("commentChar is {}", quote(mark)), "it is one character",
                 "write \"#\"");
    }
    package.comment = mark[0];
  }
  require_usual(*dialect, "quoteChar", "\"");
  require_usual(*dialect, "doubleQuote", true);
  const std::vector<std::string> changing = {
      "escapeChar", "nullSequence", "headerRows", "headerJoin", "commentRows", "itemType",
      "itemKeys",   "sheetNumber",  "sheetName",  "property",   "table"};
  for (const JsonNode& member : dialect->members()) {
    if (std::ranges::find(changing, member.key()) == changing.end()) continue;
    member.fail(fmt::format("{} is not supported", quote(member.key())),
                "recoil would read the cells differently",
                "remove it; supported: delimiter, header, commentChar, quoteChar, doubleQuote, "
                "lineTerminator, skipInitialSpace, caseSensitiveHeader, csvddfVersion");
  }
}

/// Reads "sha256:9f86..."; a hash without a prefix is md5 (Frictionless).
void read_hash(const JsonNode& node, Package& package) {
  std::string text = node.string();
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const std::size_t colon = text.find(':');
  package.points_hash_algorithm = colon == std::string::npos ? "md5" : text.substr(0, colon);
  package.points_hash = text.substr(colon == std::string::npos ? 0 : colon + 1);
  if (hash_hex(package.points_hash_algorithm, "").empty()) {
    node.fail(fmt::format("a hash by {}", quote(package.points_hash_algorithm)), "",
              "known: md5, sha1, sha256, sha512");
  }
}

void read_resource(const JsonNode& root, Package& package) {
  const JsonNode resources = root.require("resources", "it names the file with the points",
                                          "add [{\"path\": \"points.csv\", \"schema\": ...}]");
  const std::vector<JsonNode> items = resources.items();
  if (items.empty()) {
    resources.fail("'resources' is empty", "it has to name the file with the points",
                   "add {\"path\": \"points.csv\", \"schema\": ...}");
  }
  const JsonNode& resource = items.front();
  const JsonNode path =
      resource.require("path", "it names the file with the points", "write \"points.csv\"");
  package.points_path = read_path(path);
  package.points_where = path.where();
  if (const auto bytes = resource.find("bytes")) package.points_bytes = bytes->number();
  if (const auto hash = resource.find("hash")) read_hash(*hash, package);
  read_dialect(resource, package);
  const JsonNode schema = resource.require("schema", "it states the columns and their units",
                                           "list the fields with name, type and unit");
  package.columns = read_fields(schema.require("fields", "it states the columns",
                                               "list the fields with name, type and unit"));
  if (const auto missing = schema.find("missingValues")) {
    for (Column& column : package.columns) {
      if (column.missing_values.empty()) column.missing_values = read_words(*missing);
    }
  }
}

/// Reads the package's name, which has to be usable as the name of a file (Frictionless).
std::string read_id(const JsonNode& node) {
  const std::string id = node.string();
  constexpr const char* plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-";
  if (id.empty() || id.front() == '.' || id.find_first_not_of(plain) != std::string::npos) {
    node.fail(fmt::format("the name {} cannot be the name of a file", quote(id)), "",
              "use letters, digits, '.', '_' and '-', as in wall1990-mica");
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

/// nullopt if a key is unknown or a value is impossible.
std::optional<ImpactSystem> readable_system(const Json& system) {
  try {
    const JsonDocument document(json_line(system), "");
    return read_system(document.root());
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

Dimension dimension_of(Quantity quantity) {
  using enum Dimension;
  static constexpr std::array dimensions = {
      text,        length, velocity, ratio,    velocity, ratio, velocity, length,   length,
      count,       count,  text,     velocity, text,     angle, ratio,    pressure, ratio,
      temperature, length, length,   count,    length,   count, count,    length,   count};
  static_assert(dimensions.size() == count_of<Quantity>);
  return dimensions[static_cast<std::size_t>(quantity)];
}

Quantity quantity_of(Condition condition) {
  return static_cast<Quantity>(static_cast<std::size_t>(Quantity::ambient_pressure) +
                               static_cast<std::size_t>(condition));
}

std::optional<JsonNode> find_resource(const JsonNode& root, const std::string& path) {
  const auto resources = root.find("resources");
  for (const JsonNode& resource : resources ? resources->items() : std::vector<JsonNode>{}) {
    const auto place = resource.find("path");
    if (place && place->string() == path) return resource;
  }
  return std::nullopt;
}

std::map<std::string, std::string> field_units(const JsonNode& resource) {
  std::map<std::string, std::string> units;
  const auto schema = resource.find("schema");
  const auto fields = schema ? schema->find("fields") : std::nullopt;
  for (const JsonNode& field : fields ? fields->items() : std::vector<JsonNode>{}) {
    const auto name = field.find("name");
    const auto unit = field.find("unit");
    if (name && unit) units[name->string()] = unit->string();
  }
  return units;
}

Package read_package(const std::string& text, const std::string& file,
                     const std::string& fallback_id) {
  require_text(text, file);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw InputError({file, 1, 1}, "the file is empty", "it has to describe the dataset",
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
  if (const auto sizes = recoil.find("mixed_sizes")) {
    package.mixed_sizes = read_path(*sizes);
    package.mixed_sizes_where = sizes->where();
  }
  read_resource(root, package);
  return package;
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
  Json system = parse_json(text)["recoil"];
  for (const char* own : {"provenance", "conditions", "method", "mixed_sizes"}) system.erase(own);
  return system;
}

std::vector<LeftOverride> leave_out_contradictions(Json& system,
                                                   const std::vector<std::string>& own) {
  std::vector<LeftOverride> left;
  std::optional<ImpactSystem> kept = readable_system(system);
  if (!kept) return left;
  // Only the derived f0 depends on the diameter, and a stated f0 comes with one.
  const double diameter = kept->reference_diameter.value_or(1e-6);
  const auto leave_out = [&](const char* key, std::optional<double> ImpactSystem::*stated,
                             double ContactProperties::*derived) {
    const std::optional<double> value = (*kept).*stated;
    const double other = derive_contact(*kept, diameter).*derived;
    if (std::ranges::find(own, key) != own.end()) return false;
    if (!value || *value == 0.0 || !contradicts(*value, other)) return false;
    left.push_back({key, *value, other});
    system.erase(key);
    ((*kept).*stated).reset();
    return true;
  };
  leave_out("stiffness_K", &ImpactSystem::stiffness_K, &ContactProperties::stiffness_derived);
  leave_out("adhesion_energy", &ImpactSystem::adhesion_energy,
            &ContactProperties::adhesion_energy_derived);
  if (leave_out("adhesion_force_f0", &ImpactSystem::adhesion_force_f0,
                &ContactProperties::adhesion_force_derived)) {
    system.erase("reference_diameter");
  }
  return left;
}

}  // namespace recoil
