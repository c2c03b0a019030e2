// The manual says what the program does: its tables are those that the program makes, its examples
// run, and the keys of the result files that it lists are the keys that they have.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "page.hpp"
#include "tree.hpp"

namespace {

namespace fs = std::filesystem;

std::vector<std::string> page_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(tree::root() / "docs")) {
    if (entry.path().extension() == ".md") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

TEST(Manual, TablesAreThoseThatTheProgramMakes) {
  const page::Sandbox sandbox;
  fs::copy(tree::root() / "docs", sandbox.folder() / "docs");
  const page::Sandbox::Outcome outcome =
      sandbox.run("build/release/recoil help --write-docs docs\n");
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  for (const std::string& name : page_names()) {
    const std::string file = "docs/" + name + ".md";
    EXPECT_EQ(tree::text_of(sandbox.folder() / file), tree::text_of(tree::root() / file))
        << "the tables of " << file << " are not up to date: ./run docs";
  }
}

TEST(Manual, HelpPrintsEveryPage) {
  const page::Sandbox sandbox;
  const page::Sandbox::Outcome list = sandbox.run("build/release/recoil help\n");
  EXPECT_EQ(list.status, 0);
  for (const std::string& name : page_names()) {
    if (name == "README") continue;
    EXPECT_NE(list.output.find("  " + name + " "), std::string::npos)
        << "src/cli/CMakeLists.txt does not list the page " << name;
    const page::Sandbox::Outcome text = sandbox.run("build/release/recoil help " + name + "\n");
    EXPECT_EQ(text.status, 0) << text.output;
    EXPECT_GT(text.output.size(), 300U) << name;
    EXPECT_EQ(text.output.find("](/"), std::string::npos) << "a link of " << name;
    EXPECT_EQ(text.output.find("<!--"), std::string::npos) << "a comment of " << name;
  }
}

/// The sources that a page names in code: `fit.cpp`, `src/core/units.cpp`, `result_json_*.cpp`.
/// Names in capitals stand for others (`src/mechanism/ID.cpp`), and scripts belong to the user.
std::set<std::string> sources_named_in(const std::string& text) {
  static const std::regex code("`([^`\n]+)`");
  static const std::regex source(R"([\w*./-]*\w*\.(?:cpp|hpp|js)\b)");
  static const std::regex stands_for_others(R"((^|/)[A-Z]+\.)");
  std::set<std::string> names;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), code); at != std::sregex_iterator();
       ++at) {
    const std::string words = (*at)[1];
    for (auto it = std::sregex_iterator(words.begin(), words.end(), source);
         it != std::sregex_iterator(); ++it) {
      const std::string name = it->str();
      if (name.front() != '.' && !std::regex_search(name, stands_for_others)) names.insert(name);
    }
  }
  return names;
}

TEST(Manual, NamesSourcesThatExist) {
  std::vector<std::string> files;
  for (const fs::path& file : tree::project_files()) files.push_back("/" + file.string());
  std::size_t named = 0;
  std::vector<std::string> pages = page_names();
  for (std::string& page : pages) page = "docs/" + page + ".md";
  pages.insert(pages.end(), {"README.md", "CONTRIBUTING.md"});
  for (const std::string& page : pages) {
    for (const std::string& name : sources_named_in(tree::text_of(tree::root() / page))) {
      ++named;
      const std::string pattern = std::regex_replace(
          std::regex_replace(name, std::regex("\\."), "\\."), std::regex("\\*"), "[^/]*");
      const std::regex ends(".*/" + pattern);
      EXPECT_TRUE(
          std::any_of(files.begin(), files.end(),
                      [&](const std::string& file) { return std::regex_match(file, ends); }))
          << page << " names " << name << ", which does not exist";
    }
  }
  EXPECT_GE(named, 20U) << "the search itself seems broken";
}

/// How often `heading` is a line of the pages whose names begin with `pages`.
std::size_t times_headed(const std::string& pages, const std::string& heading) {
  std::size_t count = 0;
  for (const std::string& name : page_names()) {
    if (name.rfind(pages, 0) != 0) continue;
    for (const std::string& line :
         tree::lines_of(tree::text_of(tree::root() / "docs" / (name + ".md")))) {
      if (line == heading || line.rfind(heading + " ", 0) == 0) ++count;
    }
  }
  return count;
}

TEST(Manual, EveryCommandAndMechanismStandsOnOnePage) {
  const page::Sandbox sandbox;
  const std::string help = sandbox.run("build/release/recoil --help\n").output;
  static const std::regex command(R"re(\n  ([a-z]+)  +)re");
  const std::string list = help.substr(help.find("Subcommands:"));
  std::size_t commands = 0;
  for (auto it = std::sregex_iterator(list.begin(), list.end(), command);
       it != std::sregex_iterator(); ++it, ++commands) {
    EXPECT_EQ(times_headed("commands", "## recoil " + (*it)[1].str()), 1U) << (*it)[1];
  }
  EXPECT_GE(commands, 15U) << "the search itself seems broken";
  const auto mechanisms = page::table_of(tree::root() / "docs/mechanisms.md", "| id |");
  EXPECT_GE(mechanisms.size(), 20U);
  for (const auto& row : mechanisms) {
    const std::string id = row.at(0).substr(1, row.at(0).size() - 2);
    EXPECT_EQ(times_headed("mechanisms-", "## " + id), 1U) << id;
  }
}

TEST(Manual, HelpForACommandWithoutAPageIsItsOptions) {
  const page::Sandbox sandbox;
  const page::Sandbox::Outcome outcome = sandbox.run("build/release/recoil help check\n");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.output.find("DIR"), std::string::npos);
}

TEST(Manual, AnUnknownPageNamesTheNearest) {
  const page::Sandbox sandbox;
  const page::Sandbox::Outcome outcome = sandbox.run("build/release/recoil help nois\n");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.output.find("noise"), std::string::npos) << outcome.output;
}

class Examples : public testing::TestWithParam<std::string> {};

TEST_P(Examples, RunAndPrintWhatThePageShows) {
  const page::Sandbox sandbox;
  sandbox.follow(page::blocks_of(tree::root() / "docs" / (GetParam() + ".md")));
}

std::vector<std::string> pages_with_examples() {
  std::vector<std::string> names;
  for (const std::string& name : page_names()) {
    const std::vector<page::Block> blocks = page::blocks_of(tree::root() / "docs" / (name + ".md"));
    const bool any = std::any_of(blocks.begin(), blocks.end(), [](const page::Block& block) {
      return block.language == "sh" && block.run;
    });
    if (any) names.push_back(name);
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(Manual, Examples, testing::ValuesIn(pages_with_examples()),
                         [](const testing::TestParamInfo<std::string>& page) {
                           return std::regex_replace(page.param, std::regex("-"), "_");
                         });

// ---- keys ------------------------------------------------------------------------------------

/// Objects whose keys are names: of parameters, datasets, outcomes.
bool has_names_as_keys(const std::string& path) {
  static const std::set<std::string> last = {
      "parameters",       "covariance",       "correlation",    "spread",
      "exponents",        "relative_sd",      "ended",          "two_point_by_dataset",
      "full_by_dataset",  "two_point_failed", "intervals_note", "covariance.NAME",
      "correlation.NAME", "constants"};
  for (const std::string& name : last) {
    if (path == name ||
        (path.size() > name.size() &&
         path.compare(path.size() - name.size() - 1, std::string::npos, "." + name) == 0)) {
      return true;
    }
  }
  return false;
}

/// Why a value is null: `why`, `value_why`.
bool is_reason(const std::string& key) {
  const std::string ending = "why";
  return key.size() >= ending.size() &&
         key.compare(key.size() - ending.size(), std::string::npos, ending) == 0;
}

/// The paths of all values; of a list, those of its entries; a reason (`why`, `..._why`) is left
/// out.
void collect(const nlohmann::json& value, const std::string& path, std::set<std::string>& paths) {
  if (value.is_object() && !value.empty()) {
    const bool names = has_names_as_keys(path);
    for (const auto& [key, inner] : value.items()) {
      if (!names && is_reason(key)) continue;
      collect(inner, (path.empty() ? "" : path + ".") + (names ? "NAME" : key), paths);
    }
    return;
  }
  if (value.is_array() && !value.empty() && value.front().is_object()) {
    for (const nlohmann::json& inner : value) collect(inner, path + "[]", paths);
    return;
  }
  paths.insert(path);
}

/// "a.{b, c}[].d" as its paths; NAME, DATASET, STATUS alike.
std::vector<std::string> expanded(const std::string& text) {
  const std::size_t open = text.find('{');
  if (open == std::string::npos) {
    return {std::regex_replace(text, std::regex("DATASET|STATUS|KIND"), "NAME")};
  }
  const std::size_t close = text.find('}', open);
  std::vector<std::string> paths;
  std::size_t begin = open + 1;
  while (begin <= close) {
    const std::size_t end = std::min(text.find(',', begin), close);
    for (const std::string& path : expanded(text.substr(0, open) + text.substr(begin, end - begin) +
                                            text.substr(close + 1))) {
      paths.push_back(path);
    }
    begin = text.find_first_not_of(' ', end + 1);
  }
  return paths;
}

/// The paths that the tables "| key | meaning |" of a page list.
std::set<std::string> listed_keys(const std::string& name) {
  static const std::regex code(R"re(`([^`]+)`)re");
  std::set<std::string> paths;
  for (const auto& row : page::table_of(tree::root() / "docs" / name, "| key | meaning |")) {
    const std::string& cell = row.at(0);
    for (auto it = std::sregex_iterator(cell.begin(), cell.end(), code);
         it != std::sregex_iterator(); ++it) {
      for (const std::string& path : expanded((*it)[1].str())) paths.insert(path);
    }
  }
  return paths;
}

/// `path` is described: itself, or what it consists of (a value that is null here).
bool describes(const std::set<std::string>& listed, const std::string& path) {
  if (listed.count(path) > 0) return true;
  return std::any_of(listed.begin(), listed.end(), [&](const std::string& key) {
    return key.rfind(path + ".", 0) == 0 || key.rfind(path + "[]", 0) == 0;
  });
}

constexpr const char* impacts_that_differ =
    R"(series,diameter,incident_velocity,restitution,events,captured
a,4,0.65,0,20,20
a,4,0.8,0.505,20,8
a,4,1,0.705,20,2
a,4,1.4,0.825,20,0
a,4,2.4,0.909,20,0
a,4,5,0.937,20,0
a,4,12,0.911,20,0
a,4,25,0.933,20,0
)";

constexpr const char* its_package = R"({
  "name": "counted", "resources": [{ "name": "points", "path": "points.csv", "schema": { "fields": [
    { "name": "series", "type": "string" },
    { "name": "diameter", "type": "number", "unit": "um" },
    { "name": "incident_velocity", "type": "number", "unit": "m/s" },
    { "name": "restitution", "type": "number", "unit": "1" },
    { "name": "events", "type": "integer" },
    { "name": "captured", "type": "integer" } ] } }],
  "recoil": { "provenance": "synthetic",
    "particle": { "density": 1050, "youngs_modulus": { "value": 2.56e9, "sd": 0.5e9 },
      "poisson_ratio": 0.35, "surface_energy": { "value": 0.04, "relative_sd": 0.3 } },
    "surface": { "youngs_modulus": 131e9, "poisson_ratio": 0.28 } } }
)";

TEST(Manual, EveryKeyOfFitJsonIsDescribed) {
  const page::Sandbox sandbox;
  sandbox.write("counted/points.csv", impacts_that_differ);
  sandbox.write("counted/datapackage.json", its_package);
  sandbox.write("counted.toml", "dataset = \"counted\"\n[uncertainty]\nposterior = true\n");
  sandbox.write("dry/points.csv", impacts_that_differ);
  sandbox.write("dry/datapackage.json",
                std::regex_replace(its_package, std::regex("\"provenance\""),
                                   "\"adhesion_energy\": 0, \"provenance\""));
  sandbox.write("dry.toml", "dataset = \"dry\"\n");
  const page::Sandbox::Outcome outcome = sandbox.run(
      "build/release/recoil fit counted.toml --replicates 39 --out one\n"
      "build/release/recoil fit dry.toml --replicates 0 --out dry\n"
      "build/release/recoil fit fits/wall1990-mica.toml --replicates 19 --out two\n");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  std::set<std::string> listed = listed_keys("fit-json.md");
  listed.merge(listed_keys("fit-json-points.md"));
  std::set<std::string> found;
  for (const char* name : {"one", "two", "dry"}) {
    collect(nlohmann::json::parse(tree::text_of(sandbox.folder() / name / "fit.json")), "", found);
  }
  for (std::string path : found) {
    path = std::regex_replace(path, std::regex("^(two_point|full)_by_dataset(\\.NAME)?"), "$1");
    EXPECT_TRUE(describes(listed, path)) << "docs/fit-json.md does not describe " << path;
  }
  for (const std::string& key : listed) {
    if (is_reason(key) || key.rfind("bootstrap.failures.", 0) == 0) continue;  // not always there
    EXPECT_TRUE(found.count(key) > 0) << "no fit.json has " << key;
  }
}

TEST(Manual, EveryKeyOfDiagnosisJsonIsDescribed) {
  const page::Sandbox sandbox;
  const page::Sandbox::Outcome outcome =
      sandbox.run("build/release/recoil diagnose fits/li1999-sst125-silicon.toml --out one\n");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  const std::set<std::string> listed = listed_keys("diagnosis-json.md");
  std::set<std::string> found;
  collect(nlohmann::json::parse(tree::text_of(sandbox.folder() / "one/diagnosis.json")), "", found);
  for (std::string path : found) {
    path = std::regex_replace(path, std::regex("^pairs"), "candidates");
    EXPECT_TRUE(describes(listed, path)) << "docs/diagnosis-json.md does not describe " << path;
  }
}

}  // namespace
