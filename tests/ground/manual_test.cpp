// The manual says what the program does: its tables and schemas are those that the program makes,
// and its examples run.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
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

TEST(Manual, TablesAndSignaturesAreThoseThatTheProgramMakes) {
  const page::Sandbox sandbox;
  fs::copy(tree::root() / "docs", sandbox.folder() / "docs");
  fs::copy(tree::root() / "src/python/recoil", sandbox.folder() / "package");
  const page::Sandbox::Outcome outcome =
      sandbox.run("mkdir schemas\nbuild/release/recoil_tables schemas docs package\n");
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_EQ(outcome.output, "") << "these are not up to date: ./run docs";
}

TEST(Manual, SchemasAreThoseThatTheProgramMakes) {
  const page::Sandbox sandbox;
  const page::Sandbox::Outcome outcome =
      sandbox.run("mkdir schemas\nbuild/release/recoil_tables schemas\n");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  std::set<fs::path> made;
  for (const auto& entry : fs::directory_iterator(sandbox.folder() / "schemas")) {
    made.insert(entry.path().filename());
    const fs::path file = tree::root() / "schemas" / entry.path().filename();
    ASSERT_TRUE(fs::exists(file)) << file;
    EXPECT_EQ(tree::text_of(entry.path()), tree::text_of(file))
        << file << " is not up to date: ./run docs";
  }
  for (const auto& entry : fs::directory_iterator(tree::root() / "schemas")) {
    EXPECT_EQ(made.count(entry.path().filename()), 1U) << "nothing makes " << entry.path();
  }
}

TEST(Manual, PythonHasTheArgumentsOfTheTable) {
  const std::string text = tree::text_of(tree::root() / "src/python/recoil/__init__.py");
  EXPECT_NE(text.find("    height: Quantity = 1,\n"), std::string::npos);
  EXPECT_NE(text.find("    size_edges: Optional[Sequence[Quantity]] = None,\n"), std::string::npos);
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

TEST(Manual, HelpIsThatOfTheCommand) {
  const page::Sandbox sandbox;
  for (const std::string command : {"", "check"}) {
    EXPECT_EQ(sandbox.run("build/release/recoil help " + command + "\n").output,
              sandbox.run("build/release/recoil " + command + " --help\n").output);
  }
  const page::Sandbox::Outcome wrong = sandbox.run("build/release/recoil help fitt\n");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.output.find("did you mean fit?"), std::string::npos) << wrong.output;
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

}  // namespace
