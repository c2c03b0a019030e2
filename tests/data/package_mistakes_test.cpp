#include <gtest/gtest.h>

#include "core/error.hpp"
#include "data/dataset.hpp"
#include "support/dataset_folder.hpp"

namespace example {
namespace {

using support::changed;
using support::expect_mistake;
using support::Mistake;

class PackageMistake : public testing::TestWithParam<Mistake> {};

TEST_P(PackageMistake, IsOneClearLine) {
  const Mistake& mistake = GetParam();
  const DatasetFolder folder(changed(package, mistake.old_text, mistake.new_text));
  folder.expect(mistake);
}

const Mistake package_mistakes[] = {
    // JSON itself.
    {"syntax", "\"title\":", "\"title\"", "datapackage.json:3:11: ", "colon is missing",
     "just before it"},
    {"comma_missing", "\"example-quartz\",", "\"example-quartz\"",
     "datapackage.json:3:3: ", "a comma or '}' is missing", "just before it"},
    {"list_not_closed", "\"https://example.org/paper\" }]", "\"https://example.org/paper\" }",
     "datapackage.json:5:13: ", "a comma or ']' is missing", "just before it"},
    {"word_without_quotes", "\"measured\"", "measured",
     "datapackage.json:22:19: ", "'measured' is not a value", "just before it"},
    {"number_of_two_points", "1050", "1.0.5", "datapackage.json:23:57: ", "'1.0.5' is not a value",
     "just before it"},
    {"string_of_two_lines", "Spheres on", "Spheres\non", "datapackage.json:3:12: ", "backslash",
     "just before it"},
    {"number_overflow", "1050", "1e999", "datapackage.json:23:57: ", "double precision",
     "just before it"},
    {"repeated_key", "\"title\"", "\"name\"",
     "datapackage.json:3:3: ", "the key 'name' appears twice", "remove one"},
    {"repeated_key_with_escapes", "\"title\"", R"("n\u0061me")",
     "datapackage.json:3:3: ", "the key 'name' appears twice", "remove one"},
    {"place_behind_an_escaped_mark", "Spheres on quartz\",", R"(a \" { \\", "name": 1,)",
     "datapackage.json:3:25: ", "the key 'name' appears twice", "remove one"},
    {"too_deep", "\"Spheres on quartz\"", std::string(200, '[') + std::string(200, ']'),
     "datapackage.json:3:76: ", "nested too deeply", "flatten"},
    {"not_utf8", "Spheres", "\xFF", "datapackage.json:3:13: ", "byte 0xFF is not UTF-8", "save"},
    // The package.
    {"name_with_slash", "example-quartz", "../x", "datapackage.json:2:11: ", "the name '../x'",
     "wall1990-mica"},
    {"title_is_a_number", "\"Spheres on quartz\"", "7",
     "datapackage.json:3:12: ", "'title' is a number", "a string"},
    {"sources_are_a_string",
     "[{ \"title\": \"A paper\", \"path\": \"https://example.org/paper\" }]", "\"paper\"",
     "datapackage.json:4:14: ", "'sources' is a string", "a list"},
    {"resources_missing", "\"resources\"", "\"resource\"",
     "datapackage.json:1:1: ", "'resources' is missing", "points.csv"},
    {"path_missing", "\"path\": \"points.csv\",", "",
     "datapackage.json:6:17: ", "'path' is missing in 'resources[0]'", "points.csv"},
    {"path_climbs", "points.csv", "a/../../points.csv", "datapackage.json:7:13: ", "names no file",
     "points.csv"},
    {"path_absolute", "points.csv", "/etc/passwd", "datapackage.json:7:13: ", "names no file",
     "points.csv"},
    {"path_address", "points.csv", "https://example.org/points.csv",
     "datapackage.json:7:13: ", "names no file", "points.csv"},
    {"path_list", "\"points.csv\"", "[\"points.csv\"]",
     "datapackage.json:7:13: ", "'resources[0].path' is an array", "a string"},
    {"delimiter_too_long", "\"path\": \"points.csv\",",
     "\"path\": \"points.csv\", \"dialect\": { \"delimiter\": \"ab\" },",
     "datapackage.json:7:53: ", "the delimiter is 'ab'", "commas"},
    {"encoding", "\"path\": \"points.csv\",", "\"path\": \"points.csv\", \"encoding\": \"latin1\",",
     "datapackage.json:7:39: ", "the encoding is 'latin1'", "save the points as UTF-8"},
    {"header_is_a_word", "\"path\": \"points.csv\",",
     "\"path\": \"points.csv\", \"dialect\": { \"header\": 1 },",
     "datapackage.json:7:50: ", "neither true nor false", "false if there is none"},
    {"comment_too_long", "\"path\": \"points.csv\",",
     "\"path\": \"points.csv\", \"dialect\": { \"commentChar\": \"//\" },",
     "datapackage.json:7:55: ", "commentChar is '//'", "write \"#\""},
    {"quotes_are_others", "\"path\": \"points.csv\",",
     "\"path\": \"points.csv\", \"dialect\": { \"quoteChar\": \"'\" },",
     "datapackage.json:7:53: ", "'quoteChar' is not supported", "remove it"},
    {"decimal_mark_is_a_digit", "\"number\", \"unit\": \"um\"",
     "\"number\", \"decimalChar\": \"1\", \"unit\": \"um\"",
     "datapackage.json:11:64: ", "decimalChar is '1'", "write"},
    {"decimal_and_group_mark_are_one", "\"number\", \"unit\": \"um\"",
     "\"number\", \"groupChar\": \".\", \"unit\": \"um\"",
     "datapackage.json:11:62: ", "groupChar and decimalChar are equal", "correct one"},
    {"schema_missing", "\"schema\"", "\"shema\"", "datapackage.json:6:17: ", "'schema' is missing",
     "name, type and unit"},
    // The fields.
    {"field_unknown", "\"velocity_sd\"", "\"velocity_std\"",
     "datapackage.json:15:19: ", "unknown field 'velocity_std'", "did you mean 'velocity_sd'?"},
    {"field_without_name", "\"name\": \"events\", ", "",
     "datapackage.json:16:9: ", "'name' is missing", "known: series"},
    {"field_repeated", "\"restitution_sd\"", "\"restitution\"",
     "datapackage.json:14:19: ", "'restitution' appears twice", "remove one"},
    {"field_missing", "{ \"name\": \"diameter\", \"type\": \"number\", \"unit\": \"um\" },", "",
     "datapackage.json:9:17: ", "the field 'diameter' is missing", "add it"},
    {"rebound_missing", "{ \"name\": \"restitution\", \"type\": \"number\", \"unit\": \"1\" },", "",
     "points.csv:1:35: ", "'restitution' is not in the schema", ""},  // counts need no rebound
    {"rebound_twice", "\"name\": \"velocity_sd\", \"type\": \"number\", \"unit\": \"cm/s\"",
     "\"name\": \"rebound_velocity\", \"type\": \"number\", \"unit\": \"m/s\"",
     "datapackage.json:15:19: ", "both 'restitution' and 'rebound_velocity'", "remove one"},
    {"type_missing", "\"diameter\", \"type\": \"number\"", "\"diameter\"",
     "datapackage.json:11:9: ", "'type' is missing", "\"number\""},
    {"type_wrong", "\"diameter\", \"type\": \"number\"", "\"diameter\", \"type\": \"string\"",
     "datapackage.json:11:39: ", "the type of 'diameter' is 'string'", "write number"},
    {"unit_missing", ", \"unit\": \"um\"", "", "datapackage.json:11:9: ", "'unit' is missing",
     "use um"},
    {"unit_unknown", "\"um\"", "\"furlong\"", "datapackage.json:11:57: ", "unknown unit 'furlong'",
     "use um"},
    {"unit_empty", "\"um\"", "\"\"", "datapackage.json:11:57: ", "unknown unit ''", "use um"},
    {"unit_of_another_dimension", "\"m/s\"", "\"um\"",
     "datapackage.json:12:66: ", "'incident_velocity' in 'um'", "use m/s, cm/s"},
    {"unit_of_a_count", "\"integer\", \"unit\": \"1\"", "\"integer\", \"unit\": \"%\"",
     "datapackage.json:16:56: ", "'events' in '%'", "use 1"},
    // The system.
    {"recoil_missing", "\"recoil\"", "\"recoils\"", "datapackage.json:1:1: ", "'recoil' is missing",
     "provenance"},
    {"recoil_unknown_key", "\"provenance\"", "\"stifness_K\": 1e9, \"provenance\"",
     "datapackage.json:22:5: ", "unknown key 'stifness_K'", "did you mean 'stiffness_K'?"},
    {"material_unknown_key", "\"density\"", "\"densitty\"",
     "datapackage.json:23:46: ", "unknown key 'densitty'", "did you mean 'density'?"},
    {"provenance_unknown", "\"measured\"", "\"measurd\"",
     "datapackage.json:22:19: ", "unknown provenance 'measurd'", "did you mean 'measured'?"},
    {"provenance_missing", "\"provenance\": \"measured\",", "",
     "datapackage.json:21:13: ", "'provenance' is missing", "reconstruction"},
    {"surface_missing", "\"surface\": {", "\"x-surface\": {",
     "datapackage.json:25:5: ", "unknown key 'x-surface'", "did you mean 'surface'?"},
    {"density_missing", "\"density\": 1050, ", "",
     "datapackage.json:23:17: ", "'density' is missing in 'recoil.particle'", "kg/m3"},
    {"density_in_g_cm3", "1050", "1.05",
     "datapackage.json:23:57: ", "recoil.particle.density = 1.05 kg/m3", "1 g/cm3"},
    {"density_negative", "1050", "-1050", "datapackage.json:23:57: ", "density = -1050", "kg/m3"},
    {"density_is_text", "1050", "\"1050\"",
     "datapackage.json:23:57: ", "'recoil.particle.density' is a string", "a number"},
    {"modulus_zero", "73e9", "0", "datapackage.json:25:58: ", "youngs_modulus = 0 Pa", "1 GPa"},
    {"modulus_in_gpa", "73e9", "73", "datapackage.json:25:58: ", "youngs_modulus = 73 Pa", "1 GPa"},
    {"modulus_missing", "\"youngs_modulus\": 73e9, ", "",
     "datapackage.json:25:16: ", "'youngs_modulus' is missing", "Pa"},
    {"poisson_too_large", "0.17", "0.51",
     "datapackage.json:25:81: ", "recoil.surface.poisson_ratio = 0.51", "0.3"},
    {"poisson_too_small", "0.17", "-1", "datapackage.json:25:81: ", "poisson_ratio = -1", "0.3"},
    {"error_without_value", "73e9", "{ \"sd\": 1e9 }", "datapackage.json:25:58: ",
     "'value' is missing in 'recoil.surface.youngs_modulus'", "add the value"},
    {"error_without_size", "73e9", "{ \"value\": 73e9 }",
     "datapackage.json:25:58: ", "an object without sd or relative_sd", "the number alone"},
    {"error_stated_twice", "73e9", R"({ "value": 73e9, "sd": 1e9, "relative_sd": 0.1 })",
     "datapackage.json:25:101: ", "both sd and relative_sd", "remove one"},
    {"error_negative", "73e9", R"({ "value": 73e9, "sd": -1e9 })",
     "datapackage.json:25:81: ", "recoil.surface.youngs_modulus.sd = -1e+09", "minus"},
    {"error_in_per_cent", "73e9", R"({ "value": 73e9, "relative_sd": 20 })",
     "datapackage.json:25:90: ", "relative_sd = 20", "written 0.2"},
    {"error_in_another_unit", "1050", R"({ "value": 1050, "sd": 1e4 })",
     "datapackage.json:23:80: ", "density.sd = 10000", "unit of the value"},
    {"error_of_nothing", "\"provenance\"",
     R"("adhesion_energy": { "value": 0, "sd": 0.1 }, "provenance")",
     "datapackage.json:22:", "times the value 0", "unit of the value"},
    {"error_misspelt", "73e9", R"({ "value": 73e9, "std": 1e9 })",
     "datapackage.json:25:75: ", "unknown key 'std'", "did you mean 'sd'?"},
    {"value_with_error_in_gpa", "73e9", R"({ "value": 73, "sd": 1 })",
     "datapackage.json:25:69: ", "youngs_modulus.value = 73 Pa", "1 GPa"},
    {"poisson_missing", ", \"poisson_ratio\": 0.17", "",
     "datapackage.json:25:16: ", "'poisson_ratio' is missing", "0.3"},
    {"surface_energy_negative", "0.17", "0.17, \"surface_energy\": -1",
     "datapackage.json:25:105: ", "surface_energy = -1 J/m2", "mJ/m2"},
    {"surface_energy_in_mj", "0.17", "0.17, \"surface_energy\": 33",
     "datapackage.json:25:105: ", "surface_energy = 33 J/m2", "1 mJ/m2"},
    {"stiffness_negative", "\"provenance\"", "\"stiffness_K\": -1, \"provenance\"",
     "datapackage.json:22:20: ", "stiffness_K = -1 Pa", "1 GPa"},
    {"pressure_in_bar", "\"provenance\"",
     "\"conditions\": { \"ambient_pressure\": 1e9 }, \"provenance\"",
     "datapackage.json:22:", "ambient_pressure = 1e+09 Pa", "1 atm is 101325 Pa"},
    {"adhesion_energy_negative", "\"provenance\"", "\"adhesion_energy\": -1, \"provenance\"",
     "datapackage.json:22:24: ", "adhesion_energy = -1 J/m2", "0 means no adhesion"},
    {"force_without_diameter", "\"provenance\"", "\"adhesion_force_f0\": 5.7, \"provenance\"",
     "datapackage.json:22:5: ", "without 'reference_diameter'", "add the diameter"},
    {"pressure_negative", "\"provenance\"",
     "\"conditions\": {\"ambient_pressure\": -1}, \"provenance\"",
     "datapackage.json:22:40: ", "ambient_pressure = -1 Pa", "0 is vacuum"},
    {"temperature_in_celsius", "\"provenance\"",
     "\"conditions\": {\"temperature\": 20}, \"provenance\"",
     "datapackage.json:22:35: ", "temperature = 20 K", "20 degrees Celsius is 293 K"},
    {"condition_unknown", "\"provenance\"", "\"conditions\": {\"presure\": 1}, \"provenance\"",
     "datapackage.json:22:20: ", "unknown key 'presure'", ""},
    {"reference_diameter_in_um", "\"provenance\"", "\"reference_diameter\": 4.9, \"provenance\"",
     "datapackage.json:22:27: ", "reference_diameter = 4.9 m", "1 um is 1e-6 m"},
};

INSTANTIATE_TEST_SUITE_P(Each, PackageMistake, testing::ValuesIn(package_mistakes),
                         support::name_of);

TEST(PackageFile, EmptyOrNoObject) {
  DatasetFolder(" \n").expect(
      {"", "", "", "datapackage.json:1:1: ", "the file is empty", "shipped dataset"});
  DatasetFolder("[]").expect(
      {"", "", "", "datapackage.json:1:1: ", "the document is an array", "an object"});
  DatasetFolder("{\n  \"name\": \"x")
      .expect({"", "", "", "datapackage.json:2:11: ", "never closed", "just before it"});
  DatasetFolder("{} {}").expect(
      {"", "", "", "datapackage.json:1:4: ", "after the end", "just before it"});
  DatasetFolder("{\n  \"name\": \"x\",")
      .expect(
          {"", "", "", "datapackage.json:2:15: ", "a key in quotes is missing", "just before it"});
}

TEST(PackageFile, NoFileOrNoRebound) {
  const std::size_t at = package.find("\"resources\": [") + 13;
  const std::size_t end = package.find("}],\n  \"recoil\"") + 2;
  DatasetFolder(package.substr(0, at) + "[]" + package.substr(end))
      .expect({"", "", "", "datapackage.json:6:16: ", "'resources' is empty", "points.csv"});
  std::string without = package;
  for (const char* name : {"restitution", "events"}) {
    const std::size_t line = without.find("        { \"name\": \"" + std::string(name) + "\"");
    without.erase(line, without.find('\n', line) + 1 - line);
  }
  DatasetFolder(without).expect({"", "", "", "datapackage.json:9:17: ",
                                 "neither 'restitution' nor 'rebound_velocity'", "add one"});
}

TEST(PackageFile, FolderOrFileIsNotThere) {
  const DatasetFolder folder;
  const auto error = [](const std::filesystem::path& path) {
    return support::error_of([&] { recoil::load_dataset(path); });
  };
  expect_mistake(error("no/such/folder"),
                 {"", "", "", "no/such/folder: ", "no such folder", "check the path"});
  const auto file = folder.path() / "points.csv";
  expect_mistake(error(file), {"", "", "", file.string(), "not a folder", "name the"});
  std::filesystem::remove(folder.path() / "datapackage.json");
  folder.expect({"", "", "", "datapackage.json: ", "no such file", "a shipped dataset"});
}

}  // namespace
}  // namespace example
