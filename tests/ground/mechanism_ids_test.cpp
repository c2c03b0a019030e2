// A mechanism is one file and its line in CMakeLists.txt: nothing else knows its id or the names of
// its parameters.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "tree.hpp"

namespace {

namespace fs = std::filesystem;

/// The ids of the catalogue and the names of its parameters, as the files of the mechanisms say.
std::set<std::string> names_of_mechanisms() {
  static const std::regex entry(R"re(\.(id|name) = "([a-z0-9_]+)")re");
  std::set<std::string> names;
  for (const fs::path& file : tree::cpp_files(tree::root() / "src/mechanism")) {
    const std::string text = tree::text_of(file);
    if (text.find(".id = ") == std::string::npos) continue;
    for (auto it = std::sregex_iterator(text.begin(), text.end(), entry);
         it != std::sregex_iterator(); ++it) {
      names.insert((*it)[2].str());
    }
  }
  return names;
}

TEST(MechanismIds, StandInTheirFilesOnly) {
  const std::set<std::string> names = names_of_mechanisms();
  ASSERT_GT(names.size(), 30U) << "the search itself seems broken";
  for (const fs::path& file : tree::cpp_files(tree::root() / "src")) {
    const std::string folder = fs::relative(file, tree::root() / "src").begin()->string();
    // Studies set known effects against the catalogue; a correction may be called like the mistake.
    if (folder == "mechanism") continue;
    if (folder == "reconstruction") continue;  // the independent truth has names of its own
    const std::string text = tree::text_of(file);
    static const std::regex quoted(R"re("([a-z0-9_]+)\\?")re");
    for (auto it = std::sregex_iterator(text.begin(), text.end(), quoted);
         it != std::sregex_iterator(); ++it) {
      EXPECT_FALSE(names.count((*it)[1].str()))
          << file << " knows " << it->str()
          << ": make what is special about it a field of its entry";
    }
  }
}

}  // namespace
