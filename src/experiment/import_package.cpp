#include "experiment/import_package.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/units.hpp"
#include "data/csv.hpp"
#include "data/datapackage.hpp"
#include "data/dataset.hpp"
#include "data/text.hpp"
#include "experiment/option_values.hpp"

namespace recoil {
namespace {

// How the titles and sources of the shipped reconstructions say what they are.
constexpr const char* title_claim = ": a reconstruction";
constexpr const char* source_claim = "; its points were not available";
constexpr const char* recipe_claim = "the recipe's truth";

void remove_words(std::string& text, const std::string& words) {
  if (const std::size_t at = text.find(words); at != std::string::npos)
    text.erase(at, words.size());
}

Json parse_json(const std::string& text, const std::filesystem::path& file) {
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) {
    throw InputError({file.string()}, "this is not a JSON object", "",
                     "write {\"material\": ..., \"youngs_modulus\": ..., ...}");
  }
  return json;
}

/// "material=steel,density=7900,..." or a JSON file.
Json material(const std::string& words, const std::string& option) {
  std::error_code failed;
  if (words.find('=') == std::string::npos || std::filesystem::exists(words, failed)) {
    return parse_json(read_text_file(words), words);
  }
  Json json;
  for (const std::string& part : split_list(words)) {
    const auto pair = split_pair(part);
    if (!pair) {
      throw InputError({}, fmt::format("{}: {} is not of the form key=value", option, quote(part)),
                       "",
                       "write material=steel,density=7900,youngs_modulus=193e9,poisson_ratio=0.3");
    }
    const auto number = parse_number(pair->second);
    json[pair->first] = number && pair->first != "material" ? Json(*number) : Json(pair->second);
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
      return Provenance::measured;
    case ImportFormat::csv:
      break;
  }
  if (existing && existing->provenance == Provenance::reconstruction) return Provenance::digitised;
  if (existing) return existing->provenance;
  throw InputError({}, "the provenance of these points is not known", "every result states it",
                   "give --provenance measured, or digitised if they were read off a figure");
}

/// Conditions that are stated, and those that the flights are reduced with.
void put_conditions(const ImportRequest& request, Json& system) {
  const bool flights =
      request.format == ImportFormat::heights || request.format == ImportFormat::intervals;
  const auto put = [&](const char* key, const std::optional<double>& stated, double otherwise) {
    if (stated) {
      system["conditions"][key] = *stated;
    } else if (flights && !(system.contains("conditions") && system["conditions"].contains(key))) {
      system["conditions"][key] = otherwise;
    }
  };
  put("ambient_pressure", request.ambient_pressure, Air().pressure);
  put("temperature", request.temperature, Air().temperature);
}

/// Fit for a Frictionless name.
std::string name_for(const std::filesystem::path& folder) {
  const std::filesystem::path plain = std::filesystem::absolute(folder).lexically_normal();
  std::string name = (plain.has_filename() ? plain : plain.parent_path()).filename().string();
  for (char& c : name) {
    const bool fine =
        std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '_' || c == '-';
    if (!fine) c = '-';
  }
  while (!name.empty() && (name.front() == '.' || name.front() == '-')) name.erase(0, 1);
  return name.empty() ? "dataset" : name;
}

/// "without air", or how the air was taken out.
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
          "Points read off a figure, imported from {}.{}", request.file.filename().string(),
          request.reading_error.empty()
              ? ""
              : fmt::format(" Error of the reading: {} of an axis.", request.reading_error));
    case ImportFormat::heights:
      return fmt::format(
          "Drop and rebound heights, imported from {}: e = sqrt(h2 / h1), V = sqrt(2 "
          "g h1) with g = {} m/s2, {}.",
          request.file.filename().string(), request.gravity, air_words(air));
    case ImportFormat::intervals:
      return fmt::format(
          "Times between bounces, imported from {}: e is the ratio of successive "
          "intervals, V = g t / 2 with g = {} m/s2, {}.",
          request.file.filename().string(), request.gravity, air_words(air));
    case ImportFormat::csv:
      break;
  }
  return fmt::format("Points imported from {}.", request.file.filename().string());
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
  sources.push_back({{"title", fmt::format("{}, imported; who made it is not stated",
                                           request.file.filename().string())}});
  return sources;
}

std::string number_text(double value) { return fmt::format("{:.9g}", value); }

}  // namespace

std::optional<ExistingPackage> existing_package(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / package_file_name;
  std::error_code failed;
  if (!std::filesystem::exists(file, failed)) return std::nullopt;
  const std::string text = read_text_file(file);
  const Package package = read_package(text, file.string(), name_for(folder));
  ExistingPackage existing;
  existing.json = parse_json(text, file);
  existing.provenance = package.provenance;
  existing.points_path = package.points_path;
  for (const Column& column : package.columns) {
    existing.map.push_back(
        fmt::format("{}={}{}", column.name, column.name,
                    column.unit.empty() || column.unit == "1" ? "" : ":" + column.unit));
  }
  return existing;
}

PointsText points_text(const std::vector<ImportedPoint>& points) {
  struct Output {
    const char* name;
    std::string unit;
    double factor;
    std::optional<double> (*value)(const ImportedPoint&);
  };
  const bool large = std::all_of(points.begin(), points.end(), [](const ImportedPoint& p) {
    return p.diameter.value_or(0.0) >= units::mm;
  });
  const double length = large ? units::mm : units::um;
  const std::string length_name = large ? "mm" : "um";
  const bool rebound = std::any_of(points.begin(), points.end(), [](const ImportedPoint& p) {
    return p.rebound_velocity.has_value();
  });
  const std::vector<Output> outputs = {
      {"diameter", length_name, length, [](const ImportedPoint& p) { return p.diameter; }},
      {"incident_velocity", "m/s", 1.0,
       [](const ImportedPoint& p) { return std::optional<double>(p.velocity); }},
      {rebound ? "rebound_velocity" : "restitution", rebound ? "m/s" : "1", 1.0,
       rebound ? +[](const ImportedPoint& p) { return p.rebound_velocity; }
               : +[](const ImportedPoint& p) { return p.restitution; }},
      {"restitution_sd", "1", 1.0, [](const ImportedPoint& p) { return p.restitution_sd; }},
      {"velocity_sd", "m/s", 1.0, [](const ImportedPoint& p) { return p.velocity_sd; }},
      {"diameter_sd", length_name, length, [](const ImportedPoint& p) { return p.diameter_sd; }},
      {"events", "", 1.0, [](const ImportedPoint& p) { return p.events; }},
      {"captured", "", 1.0, [](const ImportedPoint& p) { return p.captured; }},
  };
  PointsText text;
  text.fields.push_back(package_field("series", "string", ""));
  text.csv = "series";
  std::vector<const Output*> used;
  for (const Output& output : outputs) {
    const bool any = std::any_of(points.begin(), points.end(), [&](const ImportedPoint& p) {
      return output.value(p).has_value();
    });
    const bool always = std::string_view(output.name).starts_with("re") && output.factor == 1.0 &&
                        std::string_view(output.name) != "restitution_sd";
    if (!any && !always) continue;
    used.push_back(&output);
    text.csv += fmt::format(",{}", output.name);
    text.fields.push_back(
        package_field(output.name, output.unit.empty() ? "integer" : "number", output.unit));
  }
  const bool settings = std::any_of(points.begin(), points.end(),
                                    [](const ImportedPoint& p) { return !p.setting.empty(); });
  if (settings) {
    text.csv += ",setting";
    text.fields.push_back(package_field("setting", "string", ""));
  }
  std::vector<Condition> conditions;  // that are stated of some point
  for (const Condition condition : values_of<Condition>()) {
    if (std::any_of(points.begin(), points.end(),
                    [&](const ImportedPoint& p) { return p.conditions.of(condition); })) {
      conditions.push_back(condition);
      text.csv += fmt::format(",{}", name_of(condition));
      text.fields.push_back(package_field(std::string(name_of(condition)), "number",
                                          std::string(info_of(condition).unit)));
    }
  }
  text.csv += '\n';
  for (const ImportedPoint& point : points) {
    text.csv += csv_cell(point.series);
    for (const Output* output : used) {
      const auto value = output->value(point);
      text.csv += value ? "," + number_text(*value / output->factor) : std::string(",");
    }
    if (settings) text.csv += "," + csv_cell(point.setting);
    for (const Condition condition : conditions) {
      const auto value = point.conditions.of(condition);
      text.csv += value ? "," + number_text(*value) : std::string(",");
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
  stated.erase("mixed_sizes");  // of the points that were there
  if (!request.particle.empty()) stated["particle"] = material(request.particle, "--particle");
  if (!request.surface.empty()) stated["surface"] = material(request.surface, "--surface");
  for (const char* body : {"particle", "surface"}) {
    if (stated.contains(body)) continue;
    const bool sphere = std::string(body) == "particle";
    throw InputError(
        {}, fmt::format("the {} is not known", sphere ? "sphere's material" : "surface's material"),
        "",
        fmt::format("give --{0} FILE.json, --{0} material=...,{1}youngs_modulus=...,poisson_ratio="
                    "..., or --like DIR",
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
  if (request.format == ImportFormat::heights) stated["method"] = name_of(Method::drop_heights);
  if (request.format == ImportFormat::intervals) {
    stated["method"] = name_of(Method::bounce_intervals);
  }
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
  const Json resource =
      csv_resource("points", existing ? existing->points_path : "points.csv", points.fields);
  if (existing) {
    package["resources"][0] = resource;
  } else {
    package["resources"] = Json::array({resource});
  }
  package["recoil"] = system;
  return package_text(package);
}

}  // namespace recoil
