// What does not belong into a file that others will read.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tree.hpp"

namespace {

namespace fs = std::filesystem;

/// Forbidden texts, cut in two so that this file does not contain them itself.
struct Forbidden {
  std::string text;
  std::string why;
};

std::vector<std::string> offences(const fs::path& file, const std::vector<Forbidden>& forbidden) {
  std::vector<std::string> found;
  const std::string text = tree::text_of(file);
  if (text.find('\0') != std::string::npos) return found;  // not a text
  const std::vector<std::string> lines = tree::lines_of(text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (const Forbidden& word : forbidden) {
      if (lines[i].find(word.text) != std::string::npos) {
        found.push_back(file.string() + ":" + std::to_string(i + 1) + ": '" + word.text + "' " +
                        word.why);
      }
    }
  }
  return found;
}

TEST(Words, NoPathOfOneMachine) {
  const std::string why = "names a place that exists on one machine only";
  const std::vector<Forbidden> forbidden = {
      {std::string("/wo") + "rk/", why},
      {std::string("/ho") + "me/", why},
      {std::string("/ro") + "ot/", why},
      {std::string("../sha") + "red", why},
      {std::string("<<<<<") + "<< ", "is left from a merge"},
      {std::string(">>>>>") + ">> ", "is left from a merge"},
  };
  const std::vector<fs::path> files = tree::project_files();
  ASSERT_GT(files.size(), 50U) << "the search itself seems broken";
  for (const fs::path& file : files) {
    for (const std::string& offence : offences(file, forbidden)) ADD_FAILURE() << offence;
  }
}

TEST(Words, NothingIsLeftOpenInTheCode) {
  const std::string why =
      "is a promise that nobody tracks; do it, or say in the README it is absent";
  const std::vector<Forbidden> forbidden = {
      {std::string("TO") + "DO", why},
      {std::string("FIX") + "ME", why},
      {std::string("not imple") + "mented", why},
      {std::string("GTEST_") + "SKIP();", "turns a test off without a word"},
      {std::string("DISABLED") + "_", "turns a test off silently"},
  };
  for (const char* folder : {"src", "tests"}) {
    for (const fs::path& file : tree::cpp_files(tree::root() / folder)) {
      for (const std::string& offence : offences(file, forbidden)) ADD_FAILURE() << offence;
    }
  }
}

TEST(Words, OneVersionEverywhere) {
  // The version stands in CMakeLists.txt; the changelog and the citation know it.
  const std::string cmake = tree::text_of(tree::root() / "CMakeLists.txt");
  const std::size_t begin = cmake.find("VERSION ", cmake.find("project(recoil")) + 8;
  const std::string version = cmake.substr(begin, cmake.find_first_of(" \n)", begin) - begin);
  const std::string changelog = tree::text_of(tree::root() / "CHANGELOG.md");
  EXPECT_NE(changelog.find("## [" + version + "]"), std::string::npos)
      << "CHANGELOG.md has no section for version " << version;
  EXPECT_NE(tree::text_of(tree::root() / "CITATION.cff").find("\nversion: " + version + "\n"),
            std::string::npos)
      << "CITATION.cff names another version";
}

TEST(Words, LicenseIsTheGpl3) {
  const std::string license = tree::text_of(tree::root() / "LICENSE");
  EXPECT_NE(license.find("GNU GENERAL PUBLIC LICENSE"), std::string::npos);
  EXPECT_NE(license.find("Version 3, 29 June 2007"), std::string::npos);
}

}  // namespace
