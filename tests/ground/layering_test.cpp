// The shape of the source tree: who may include whom, and that no part leans on what leans on it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tree.hpp"

namespace {

namespace fs = std::filesystem;

/// The folders of src in pipeline order. The last two are recoil and the Python module, which know
/// nothing of each other.
const std::vector<std::string> kStages = {
    "core",     "data",     "experiment", "impact",  "mechanism", "estimate", "uncertainty",
    "coverage", "predict",  "diagnosis",  "plan",    "analysis",  "json",     "export",
    "plot",     "document", "report",     "options", "cli",       "python",   "web"};

std::size_t position(const std::string& stage) {
  return static_cast<std::size_t>(std::find(kStages.begin(), kStages.end(), stage) -
                                  kStages.begin());
}

/// May `from` include `target`? Both are paths from src.
bool may_include(const std::string& from, const std::string& target) {
  const std::string stage = fs::path(from).begin()->string();
  const std::string to = fs::path(target).begin()->string();
  if (stage == "python" && to == "cli") return false;
  return position(to) < kStages.size() && position(to) <= position(stage);
}

/// The files of the recipes that bring a truth and the tool's pairing together: the points of a
/// recipe may come from simulated passages.
bool pairs_passages(const std::string& file) { return file.starts_with("recipe/reconstruction."); }

/// May `from`, a path from tests/validation, include `target`, a path from src or from tests? Truth
/// is made by code that the fitter does not use, so that neither can hide the other's mistakes.
bool may_validation_include(const std::string& from, const std::string& target) {
  const std::string folder = fs::path(from).begin()->string();
  const std::string to = fs::path(target).begin()->string();
  if (folder == "studies") return true;
  if (folder == "synthetic") {
    return to == "core" || target.starts_with("validation/synthetic/") ||
           target.starts_with("validation/truth/");
  }
  if (target == "data/contact.hpp") return false;  // a recipe derives its contact by itself
  if (to == "core" || to == "data" || target.starts_with("validation/truth/")) return true;
  return folder == "recipe" &&
         (target.starts_with("validation/recipe/") || (to == "experiment" && pairs_passages(from)));
}

struct Include {
  fs::path file;
  std::size_t line;
  std::string target;
};

/// Follows raw strings from line to line: what stands in one is a program for somebody else.
class RawStrings {
 public:
  /// Does `line` begin within one?
  bool begins_within(const std::string& line) {
    static const std::regex opening(R"re(R"([a-z]*)\()re");
    const bool within = !closing_.empty();
    std::size_t at = 0;
    if (within) {
      at = line.find(closing_);
      if (at == std::string::npos) return true;
      closing_.clear();
    }
    const std::string rest = line.substr(at);
    for (auto it = std::sregex_iterator(rest.begin(), rest.end(), opening);
         it != std::sregex_iterator(); ++it) {
      const std::string closing = ")" + (*it)[1].str() + "\"";
      const auto after = static_cast<std::size_t>(it->position() + it->length());
      closing_ = rest.find(closing, after) == std::string::npos ? closing : "";
    }
    return within;
  }

 private:
  std::string closing_;  // of the string that is open
};

/// Every #include "..." below `folder`.
std::vector<Include> quoted_includes(const fs::path& folder = tree::root() / "src") {
  static const std::regex pattern(R"re(^\s*#\s*include\s*"([^"]+)")re");
  std::vector<Include> includes;
  for (const fs::path& file : tree::cpp_files(folder)) {
    const std::vector<std::string> lines = tree::lines_of(tree::text_of(file));
    RawStrings strings;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      std::smatch match;
      if (strings.begins_within(lines[i])) continue;
      if (std::regex_search(lines[i], match, pattern)) includes.push_back({file, i + 1, match[1]});
    }
  }
  return includes;
}

std::string path_from_src(const fs::path& file) {
  return fs::relative(file, tree::root() / "src").generic_string();
}

TEST(Layering, RawStringsAreNoIncludes) {
  RawStrings strings;
  EXPECT_FALSE(strings.begins_within("const char* text = R\"cc(one"));
  EXPECT_TRUE(strings.begins_within("#include \"udf.h\""));
  EXPECT_TRUE(strings.begins_within(")cc\";"));
  EXPECT_FALSE(strings.begins_within("#include \"core/error.hpp\""));
  EXPECT_FALSE(strings.begins_within("f(R\"(a whole one)\");"));
  EXPECT_FALSE(strings.begins_within("#include \"core/error.hpp\""));
}

TEST(Layering, TheRuleItself) {
  EXPECT_TRUE(may_include("impact/a.cpp", "core/b.hpp"));
  EXPECT_FALSE(may_include("core/a.cpp", "impact/b.hpp"));
  EXPECT_FALSE(may_include("python/a.cpp", "cli/b.hpp"));
  EXPECT_FALSE(may_include("cli/a.cpp", "validation/truth/b.hpp"));
  EXPECT_FALSE(may_validation_include("truth/a.cpp", "impact/b.hpp"));
  EXPECT_FALSE(may_validation_include("recipe/a.cpp", "data/contact.hpp"));
  EXPECT_FALSE(may_validation_include("recipe/passages.cpp", "experiment/b.hpp"));
  EXPECT_TRUE(may_validation_include("recipe/reconstruction.cpp", "experiment/b.hpp"));
  EXPECT_FALSE(may_validation_include("recipe/reconstruction.cpp", "impact/b.hpp"));
  EXPECT_FALSE(may_validation_include("synthetic/a.cpp", "impact/b.hpp"));
  EXPECT_FALSE(may_validation_include("synthetic/a.cpp", "validation/studies/b.hpp"));
  EXPECT_TRUE(may_validation_include("studies/a.cpp", "report/b.hpp"));
}

TEST(Layering, TruthSharesNothingWithTheFitter) {
  const fs::path folder = tree::root() / "tests/validation";
  const std::vector<Include> includes = quoted_includes(folder);
  ASSERT_GT(includes.size(), 20U) << "the search itself seems broken";
  for (const Include& include : includes) {
    EXPECT_TRUE(
        may_validation_include(fs::relative(include.file, folder).generic_string(), include.target))
        << include.file << ":" << include.line << " must not include " << include.target;
  }
}

TEST(Layering, EveryFolderIsAStage) {
  for (const fs::directory_entry& entry : fs::directory_iterator(tree::root() / "src")) {
    if (!entry.is_directory()) continue;
    EXPECT_LT(position(entry.path().filename().string()), kStages.size())
        << entry.path() << " is no stage of the pipeline; add it to kStages where it belongs";
  }
}

TEST(Layering, IncludesPointUpstream) {
  const std::vector<Include> includes = quoted_includes();
  ASSERT_GT(includes.size(), 20U) << "the search itself seems broken";
  for (const Include& include : includes) {
    const std::string where = include.file.string() + ":" + std::to_string(include.line);
    EXPECT_TRUE(fs::is_regular_file(tree::root() / "src" / include.target))
        << where << ": \"" << include.target << "\" is not a path from src";
    EXPECT_TRUE(may_include(path_from_src(include.file), include.target))
        << where << " must not include " << include.target;
  }
}

TEST(Layering, TheRootOfCMakeStaysSmall) {
  EXPECT_LT(tree::lines_of(tree::text_of(tree::root() / "CMakeLists.txt")).size(), 100U);
}

/// A source and the header of its name are one unit; the units that each unit of src includes.
std::map<std::string, std::set<std::string>> included_units() {
  const auto unit_of = [](const std::string& path) { return path.substr(0, path.rfind('.')); };
  std::map<std::string, std::set<std::string>> graph;
  for (const Include& include : quoted_includes()) {
    const std::string from =
        unit_of(fs::relative(include.file, tree::root() / "src").generic_string());
    const std::string to = unit_of(include.target);
    if (from != to) graph[from].insert(to);
  }
  return graph;
}

/// Takes away what includes nothing that is left until nothing can be taken: the rest is in, or
/// leads into, a circle.
std::set<std::string> circular(std::map<std::string, std::set<std::string>> graph) {
  for (bool smaller = true; smaller;) {
    smaller = false;
    for (auto unit = graph.begin(); unit != graph.end();) {
      std::erase_if(unit->second, [&](const std::string& to) { return graph.count(to) == 0; });
      smaller = smaller || unit->second.empty();
      unit = unit->second.empty() ? graph.erase(unit) : std::next(unit);
    }
  }
  std::set<std::string> left;
  for (const auto& [unit, targets] : graph) left.insert(unit);
  return left;
}

TEST(Layering, CirclesAreSeen) {
  EXPECT_TRUE(circular({{"a", {"b", "c"}}, {"b", {"c"}}}).empty());
  EXPECT_EQ(circular({{"a", {"b"}}, {"b", {"c"}}, {"c", {"b"}}}).count("b"), 1U);
}

/// Results are plain types of their own: what orchestrates a folder includes its parts, and no part
/// includes what orchestrates it.
TEST(Layering, NoPartIncludesItsOrchestrator) {
  auto graph = included_units();
  // Circles among the parts of one folder; those of folders upstream are theirs.
  for (const std::string folder : {"uncertainty", "predict", "diagnosis"}) {
    std::map<std::string, std::set<std::string>> own;
    for (const auto& [unit, targets] : graph) {
      if (unit.rfind(folder + "/", 0) == 0) own[unit] = targets;
    }
    EXPECT_GT(own.size(), 5U) << folder;
    for (const std::string& unit : circular(own)) {
      ADD_FAILURE() << "src/" << unit << " is part of a circle of includes, or leads into one";
    }
  }
}

TEST(Layering, HeadersAreGuarded) {
  for (const fs::path& file : tree::cpp_files(tree::root() / "src")) {
    if (file.extension() != ".hpp") continue;
    const std::string text = tree::text_of(file);
    EXPECT_EQ(text.rfind("#pragma once", 0), 0U) << file << " must begin with #pragma once";
    EXPECT_EQ(text.find("using namespace"), std::string::npos) << file;
  }
}

/// The header of a source has its name, or the first words of it: html.hpp declares what
/// html_style.cpp defines. Others have their declarations in a register: the commands of a program,
/// and the mechanisms, which their CMakeLists.txt lists.
bool has_its_header(fs::path source) {
  std::string stem = source.stem().string();
  for (;;) {
    if (fs::exists(source.replace_filename(stem + ".hpp"))) return true;
    const std::size_t last = stem.rfind('_');
    if (last == std::string::npos) return false;
    stem.resize(last);
  }
}

TEST(Layering, EverySourceHasAHeaderOfItsName) {
  const std::string mechanisms = tree::text_of(tree::root() / "src/mechanism/CMakeLists.txt");
  const std::size_t listed = mechanisms.find("set(mechanism_files");
  ASSERT_NE(listed, std::string::npos);
  for (const fs::path& file : tree::cpp_files(tree::root() / "src")) {
    if (file.extension() != ".cpp" || file.stem() == "main") continue;
    if (file.stem().string().rfind("command_", 0) == 0) continue;
    const bool mechanism =
        file.parent_path().filename() == "mechanism" &&
        mechanisms.find("\n  " + file.filename().string(), listed) != std::string::npos;
    EXPECT_TRUE(mechanism || has_its_header(file)) << file;
  }
}

/// The sources that the CMakeLists.txt of `folder` names: NAME.cpp, or recoil_fuzz(NAME).
std::set<std::string> listed_sources(const fs::path& folder) {
  static const std::regex name(R"re([A-Za-z0-9_./-]+\.cpp)re");
  static const std::regex fuzz_target(R"re(recoil_fuzz\(([a-z_]+)\))re");
  std::set<std::string> names;
  const std::string text = tree::text_of(folder / "CMakeLists.txt");
  for (auto it = std::sregex_iterator(text.begin(), text.end(), name); it != std::sregex_iterator();
       ++it) {
    names.insert((folder / it->str()).lexically_normal().string());
  }
  for (auto it = std::sregex_iterator(text.begin(), text.end(), fuzz_target);
       it != std::sregex_iterator(); ++it) {
    names.insert((folder / ((*it)[1].str() + ".cpp")).lexically_normal().string());
  }
  return names;
}

/// The nearest folder at or above `file` with a CMakeLists.txt.
fs::path governing_folder(const fs::path& file) {
  fs::path folder = file.parent_path();
  while (!fs::exists(folder / "CMakeLists.txt")) folder = folder.parent_path();
  return folder;
}

TEST(Layering, CMakeListsEverySourceThatExists) {
  std::map<std::string, std::set<std::string>> listed;
  for (const char* top : {"src", "tests"}) {
    for (const fs::path& file : tree::cpp_files(tree::root() / top)) {
      if (file.extension() != ".cpp") continue;
      const fs::path folder = governing_folder(file);
      if (!listed.count(folder.string())) listed[folder.string()] = listed_sources(folder);
      EXPECT_TRUE(listed[folder.string()].count(file.lexically_normal().string()))
          << file << " is not listed in " << folder / "CMakeLists.txt";
    }
  }
}

}  // namespace
