#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>

#include "core/files.hpp"
#include "data/material_table.hpp"
#include "data/text.hpp"
#include "experiment/import_formats.hpp"

namespace recoil {
namespace {

// Phrases in the titles and sources of the shipped reconstructions that state what they are.
constexpr const char* title_claim = ": a reconstruction";
constexpr const char* source_claim = "; its points were not available";
constexpr const char* recipe_claim = "the recipe's truth";

void remove_words(std::string& text, const std::string& words) {
  if (const std::size_t at = text.find(words); at != std::string::npos)
    text.erase(at, words.size());
}

/// The imported file in descriptions.
std::string source_name(const ImportRequest& request) {
  return descriptor_named(request.file) ? "a pipe" : request.file.filename().string();
}

Json parse_object(const std::string& text, const std::filesystem::path& file) {
  Json json = parse_json(text);
  if (!json.is_object()) {
    throw InputError({file.string()}, "this is not a JSON object", "",
                     "write {\"material\": ..., \"youngs_modulus\": ..., ...}");
  }
  return json;
}

/// A constant that key=value states.
struct MaterialConstant {
  std::string_view key;
  Dimension dimension;
};

constexpr MaterialConstant constants[] = {{"density", Dimension::density},
                                          {"youngs_modulus", Dimension::pressure},
                                          {"poisson_ratio", Dimension::ratio},
                                          {"surface_energy", Dimension::energy_per_area},
                                          {"hardness", Dimension::pressure},
                                          {"yield_strength", Dimension::pressure},
                                          {"relative_permittivity", Dimension::ratio},
                                          {"diameter", Dimension::length},
                                          {"temperature", Dimension::temperature}};

/// A material from "material=steel,density=7900,...", from a name of the table,
/// "steel,density=7900" (whatever is called like it in the working folder), or from a JSON file.
Json material(const std::string& words, const std::string& option) {
  std::error_code failed;
  if (words.ends_with(".json") ||
      (source_of_tabled(words).empty() && std::filesystem::is_regular_file(words, failed))) {
    return parse_object(read_text_file(words), words);
  }
  Json json;
  std::vector<std::string> parts = split_list(words);
  if (!parts.empty() && !split_pair(parts.front())) {
    json = tabled_material(parts.front(), option);
    parts.erase(parts.begin());
  }
  for (const std::string& part : parts) {
    const auto pair = split_pair(part);
    if (!pair) {
      throw InputError({}, fmt::format("{}: {} is not of the form key=value", option, quote(part)),
                       "",
                       "write material=steel,density=7900,youngs_modulus=193e9,poisson_ratio=0.3");
    }
    const auto& [key, value] = *pair;
    const auto known = std::ranges::find(constants, key, &MaterialConstant::key);
    json[key] = known == std::end(constants)
                    ? Json(value)
                    : Json(parse_quantity(value, known->dimension, si_unit(known->dimension),
                                          fmt::format("{} {}", option, key)));
  }
  return json;
}

Provenance provenance_for(const ImportRequest& request,
                          const std::optional<ExistingPackage>& existing) {
  if (request.provenance) return *request.provenance;
  switch (request.format) {
    case ImportFormat::webplotdigitizer:
      return Provenance::digitised;
    case ImportFormat::heights:
    case ImportFormat::intervals:
    case ImportFormat::track:
    case ImportFormat::rest:
    case ImportFormat::tops:
    case ImportFormat::blocks:
    case ImportFormat::recording:
      return Provenance::measured;
    case ImportFormat::csv:
      break;
  }
  if (existing && existing->provenance == Provenance::reconstruction) return Provenance::digitised;
  if (existing) return existing->provenance;
  throw InputError({}, "the provenance of these points is not known", "every result states it",
                   "give --provenance measured, or digitised if they were read off a figure");
}

/// Writes the stated conditions. Flights without any are through standard air.
void put_conditions(const ImportRequest& request, Json& system) {
  const bool flights =
      request.format != ImportFormat::webplotdigitizer && request.format != ImportFormat::csv;
  const auto put_if_missing = [&](const char* key, double otherwise) {
    if (system.contains("conditions") && system["conditions"].contains(key)) return;
    system["conditions"][key] = otherwise;
  };
  if (flights) put_if_missing("ambient_pressure", Air().pressure);
  if (flights) put_if_missing("temperature", Air().temperature);
  for (const std::string& word : split_lists(request.conditions)) {
    const auto pair = split_pair(word);
    const auto condition = value_named<Condition>(pair ? pair->first : "");
    if (!condition) {
      throw InputError({}, fmt::format("--condition {} names no condition", quote(word)), "",
                       did_you_mean(pair ? pair->first : word, all_names<Condition>()));
    }
    const Dimension dimension = dimension_of(quantity_of(*condition));
    system["conditions"][pair->first] = parse_quantity(pair->second, dimension, si_unit(dimension),
                                                       fmt::format("--condition {}", pair->first));
  }
}

/// The name of the folder as a Frictionless name.
std::string name_for(const std::filesystem::path& folder) {
  std::string name = name_of_folder(std::filesystem::absolute(folder));
  for (char& c : name) {
    const bool fine =
        std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '_' || c == '-';
    if (!fine) c = '-';
  }
  while (!name.empty() && (name.front() == '.' || name.front() == '-')) name.erase(0, 1);
  return name.empty() ? "dataset" : name;
}

/// How the effect of air was corrected, as a phrase.
std::string air_words(const Air& air) {
  if (!air_acts(air)) return "without air";
  return fmt::format(
      "with the drag of air at {:g} Pa and {:g} K (C_d of Brown & Lawler 2003) taken out",
      air.pressure, air.temperature);
}

std::string description_of(const ImportRequest& request, const Air& air) {
  switch (request.format) {
    case ImportFormat::webplotdigitizer:
      return fmt::format(
          "Points read off a figure, imported from {}.{}", source_name(request),
          request.reading_error.empty()
              ? ""
              : fmt::format(" Error of the reading: {} of an axis.", request.reading_error));
    case ImportFormat::heights:
      return fmt::format(
          "Drop and rebound heights, imported from {}: e = sqrt(h2 / h1), V = sqrt(2 "
          "g h1) with g = {} m/s2, {}.",
          source_name(request), request.gravity, air_words(air));
    case ImportFormat::intervals:
    case ImportFormat::recording:
      return fmt::format(
          "Times between bounces, imported from {}: e is the ratio of successive "
          "intervals, V = g t / 2 with g = {} m/s2, {}.",
          source_name(request), request.gravity, air_words(air));
    case ImportFormat::track:
      return fmt::format(
          "Tracks of falling spheres, imported from {}: e and V where the flights before and after "
          "an impact meet, {}{}.",
          source_name(request), air_words(air),
          request.scale.empty() ? "" : fmt::format("; a pixel is {}", request.scale));
    case ImportFormat::rest:
      return fmt::format(
          "Drop heights and times to rest, imported from {}: e = (T - t) / (T + t) with the time "
          "of "
          "the fall t = sqrt(2 h / g), V = g t with g = {} m/s2, {}.",
          source_name(request), request.gravity, air_words(air));
    case ImportFormat::tops:
      return fmt::format(
          "Heights of successive tops, imported from {}: e = sqrt(h2 / h1), V = sqrt(2 g h1) with "
          "g "
          "= {} m/s2, {}.",
          source_name(request), request.gravity, air_words(air));
    case ImportFormat::blocks:
      return fmt::format(
          "Times of several bounces together, imported from {}: one e for two successive blocks, V "
          "between them, with g = {} m/s2, {}.",
          source_name(request), request.gravity, air_words(air));
    case ImportFormat::csv:
      break;
  }
  return fmt::format("Points imported from {}.", source_name(request));
}

Json sources_of(const ImportRequest& request, const std::optional<ExistingPackage>& existing,
                std::vector<ImportNote>& notes) {
  Json sources = Json::array();
  for (const std::string& source : request.sources) sources.push_back({{"title", source}});
  if (!sources.empty()) return sources;
  notes.push_back({ImportRemark::no_source});
  if (existing && existing->json.contains("sources")) {
    for (Json source : existing->json["sources"]) {
      if (source.contains("title") && source["title"].is_string()) {
        std::string title = source["title"];
        if (title.find(recipe_claim) != std::string::npos) continue;
        remove_words(title, source_claim);
        source["title"] = title;
      }
      sources.push_back(source);
    }
  }
  sources.push_back(
      {{"title", fmt::format("{}, imported; its author is not stated", source_name(request))}});
  return sources;
}

/// A column of points.csv.
struct PointsColumn {
  Quantity quantity;
  std::string type;
  std::string unit;     ///< empty for counts and texts
  double factor = 1.0;  ///< to SI
};

/// The column of a quantity. @param millimetres diameters are in mm, otherwise in um
PointsColumn column_of(Quantity quantity, bool millimetres) {
  for (const Condition condition : values_of<Condition>()) {
    if (quantity_of(condition) != quantity) continue;
    return {quantity, "number", std::string(info_of(condition).unit)};
  }
  const Dimension dimension = dimension_of(quantity);
  switch (dimension) {
    case Dimension::text:
      return {quantity, "string", ""};
    case Dimension::count:
      return {quantity, "integer", ""};
    case Dimension::length:
      return {quantity, "number", millimetres ? "mm" : "um", millimetres ? units::mm : units::um};
    case Dimension::angle:
      return {quantity, "number", "deg", *unit_factor(dimension, "deg")};
    default:
      return {quantity, "number", unit_names(dimension).front()};
  }
}

/// The text of a point; null for a number.
const std::string* text_of(const ImportedPoint& point, Quantity quantity) {
  if (quantity == Quantity::series) return &point.series;
  if (quantity == Quantity::setting) return &point.setting;
  return quantity == Quantity::launch ? &point.launch : nullptr;
}

void add_cell(const ImportedPoint& point, const PointsColumn& column, std::string& line) {
  if (const std::string* const text = text_of(point, column.quantity)) {
    line += csv_cell(*text);
  } else if (const auto value = point.value[column.quantity]) {
    fmt::format_to(std::back_inserter(line), "{:.12g}", *value / column.factor);
  }
}

}  // namespace

std::optional<ExistingPackage> existing_package(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / package_file_name;
  std::error_code failed;
  if (!std::filesystem::exists(file, failed)) return std::nullopt;
  const std::string text = read_text_file(file);
  const Package package = read_package(text, file.string(), name_for(folder));
  ExistingPackage existing;
  existing.json = parse_object(text, file);
  existing.provenance = package.provenance;
  existing.points_path = package.points_path;
  for (const Column& column : package.columns) existing.units[column.name] = column.unit;
  return existing;
}

FieldUnits usual_units() {
  FieldUnits units;
  for (const Quantity quantity : values_of<Quantity>()) {
    if (dimension_of(quantity) == Dimension::angle) continue;
    units[to_string(quantity)] = column_of(quantity, false).unit;
  }
  return units;
}

PointsText points_text(const std::vector<ImportedPoint>& points) {
  const bool millimetres = std::ranges::all_of(points, [](const ImportedPoint& point) {
    return point.value[Quantity::diameter].value_or(0.0) >= units::mm;
  });
  const auto any = [&](Quantity quantity) {
    return std::ranges::any_of(points, [&](const ImportedPoint& point) {
      const std::string* const text = text_of(point, quantity);
      return text != nullptr ? !text->empty() : point.value[quantity].has_value();
    });
  };
  PointsText text;
  std::vector<PointsColumn> columns;
  for (const Quantity quantity : values_of<Quantity>()) {
    const bool always = quantity == Quantity::series ||
                        (quantity == Quantity::restitution && !any(Quantity::rebound_velocity));
    if (!always && !any(quantity)) continue;
    const PointsColumn column = column_of(quantity, millimetres);
    text.fields.push_back(package_field(to_string(quantity), column.type, column.unit));
    text.csv += fmt::format("{}{}", columns.empty() ? "" : ",", name_of(quantity));
    columns.push_back(column);
  }
  text.csv += '\n';
  for (const ImportedPoint& point : points) {
    for (const PointsColumn& column : columns) {
      if (column.quantity != Quantity::series) text.csv += ',';
      add_cell(point, column, text.csv);
    }
    text.csv += '\n';
  }
  return text;
}

Json imported_system(const ImportRequest& request, const std::optional<ExistingPackage>& existing,
                     std::vector<ImportNote>& notes) {
  Json block;
  block["provenance"] = to_string(provenance_for(request, existing));
  Json stated = existing ? existing->json["recoil"] : Json::object();
  if (!request.like.empty()) stated = stated_system(request.like);
  stated.erase("mixed_sizes");  // it belongs to the replaced points
  if (!request.particle.empty()) stated["particle"] = material(request.particle, "--particle");
  if (!request.surface.empty()) stated["surface"] = material(request.surface, "--surface");
  for (const char* body : {"particle", "surface"}) {
    if (stated.contains(body)) continue;
    const bool sphere = std::string(body) == "particle";
    throw InputError(
        {}, fmt::format("the {} is not known", sphere ? "sphere's material" : "surface's material"),
        "",
        fmt::format("give --{0} FILE.json, --{0} material=...,{1}youngs_modulus=...,poisson_ratio="
                    "..., --{0} NAME (recoil materials), or --like DIR",
                    body, sphere ? "density=...," : ""));
  }
  std::vector<std::string> own;
  if (request.adhesion_energy) {
    own = {"adhesion_energy"};
    stated[own.front()] = *request.adhesion_energy;
  }
  ImportNote left{ImportRemark::overrides_left_out};
  left.left_out = leave_out_contradictions(stated, own);
  if (!left.left_out.empty()) notes.push_back(left);
  put_conditions(request, stated);
  if (request.format == ImportFormat::heights || request.format == ImportFormat::tops) {
    stated["method"] = name_of(Method::drop_heights);
  }
  if (request.format == ImportFormat::intervals || request.format == ImportFormat::rest ||
      request.format == ImportFormat::blocks || request.format == ImportFormat::recording) {
    stated["method"] = name_of(Method::bounce_intervals);
  }
  if (request.format == ImportFormat::track) stated["method"] = name_of(Method::video);
  if (!request.method.empty()) stated["method"] = request.method;
  for (const auto& [key, value] : stated.items()) {
    if (key != "provenance") block[key] = value;
  }
  return block;
}

SphereInAir sphere_in_air(const Json& system) {
  SphereInAir sphere;
  const auto number = [](const Json& object, const char* key, double otherwise) {
    const Json stated = object.is_object() ? object.value(key, Json()) : Json();
    const Json value = stated.is_object() ? stated.value("value", Json()) : stated;
    return value.is_number() ? value.get<double>() : otherwise;
  };
  const Json conditions = system.value("conditions", Json::object());
  sphere.air.pressure = number(conditions, "ambient_pressure", 0.0);
  sphere.air.temperature = number(conditions, "temperature", sphere.air.temperature);
  sphere.density = number(system.at("particle"), "density", 0.0);
  return sphere;
}

std::string imported_package(const ImportRequest& request, const Json& system,
                             const PointsText& points,
                             const std::optional<ExistingPackage>& existing,
                             std::vector<ImportNote>& notes) {
  const bool was_reconstruction = existing && existing->provenance == Provenance::reconstruction;
  Json package = existing ? existing->json : Json::object();
  if (!package.contains("name")) package["name"] = name_for(request.into);
  std::string title = request.title;
  if (title.empty() && package.contains("title") && package["title"].is_string()) {
    title = package["title"];
    if (was_reconstruction) remove_words(title, title_claim);
  }
  package["title"] = title.empty() ? package["name"].get<std::string>() : title;
  package["description"] = description_of(request, sphere_in_air(system).air);
  if (was_reconstruction && package.contains("licenses")) {
    package.erase("licenses");
    notes.push_back({ImportRemark::licence_removed});
  }
  package["sources"] = sources_of(request, existing, notes);
  for (const auto& [body, words] :
       {std::pair{"sphere", &request.particle}, std::pair{"surface", &request.surface}}) {
    const std::vector<std::string> parts = split_list(*words);
    const std::string_view source = parts.empty() ? "" : source_of_tabled(parts.front());
    if (source.empty()) continue;
    package["sources"].push_back(
        {{"title", fmt::format("{}. Constants of the {}, {}.", source, body, parts.front())}});
  }
  const Json resource =
      csv_resource("points", existing ? existing->points_path : "points.csv", points.fields);
  if (existing) {
    package["resources"][0] = resource;
  } else {
    package["resources"] = Json::array({resource});
  }
  package["recoil"] = system;
  return json_text(package);
}

}  // namespace recoil
