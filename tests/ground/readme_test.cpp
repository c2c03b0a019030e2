// The README's tour is run exactly as it is printed, and its links lead somewhere.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "tree.hpp"

namespace {

namespace fs = std::filesystem;

/// A fenced block: its language, its text, and the file name in backticks that ends, with a colon
/// or a full stop, the nearest paragraph before it.
struct Block {
  std::string language;
  std::string text;
  std::string file;
};

/// The blocks of the section whose heading begins with `heading`.
std::vector<Block> blocks_of_section(const std::string& heading) {
  static const std::regex name(R"re(`([A-Za-z0-9_./-]+\.(?:csv|json|toml))`)re");
  std::vector<Block> blocks;
  bool inside_section = false;
  bool inside_block = false;
  std::string paragraph;
  for (const std::string& line : tree::lines_of(tree::text_of(tree::root() / "README.md"))) {
    if (!inside_block && line.rfind("## ", 0) == 0) inside_section = line.rfind(heading, 0) == 0;
    if (!inside_section) continue;
    if (line.rfind("```", 0) == 0) {
      inside_block = !inside_block;
      if (!inside_block) continue;
      std::smatch match;
      const bool named = std::regex_search(paragraph, match, name);
      blocks.push_back({line.substr(3), "", named ? match[1].str() : ""});
      paragraph.clear();
    } else if (inside_block) {
      blocks.back().text += line + "\n";
    } else if (!line.empty()) {
      paragraph += line + "\n";
    } else if (paragraph.find('`') == std::string::npos) {
      paragraph.clear();
    }
  }
  return blocks;
}

TEST(Readme, TheTourRunsAsPrinted) {
  std::string place = (fs::temp_directory_path() / "recoil-readme-XXXXXX").string();
  ASSERT_NE(mkdtemp(place.data()), nullptr);
  const fs::path folder = place;
  fs::create_directories(folder / "build/release");
  fs::create_symlink(RECOIL_BINARY, folder / "build/release/recoil");

  int files = 0;
  int commands = 0;
  for (const Block& block : blocks_of_section("## Five minutes")) {
    if (block.language != "sh") {
      ASSERT_FALSE(block.file.empty()) << "no file name before the block\n" << block.text;
      fs::create_directories((folder / block.file).parent_path());
      std::ofstream(folder / block.file) << block.text;
      ++files;
      continue;
    }
    for (const std::string& line : tree::lines_of(block.text)) {
      const std::string log = (folder / "log").string();
      const std::string command = "cd '" + place + "' && " + line + " >log 2>&1 </dev/null";
      EXPECT_EQ(std::system(command.c_str()), 0) << line << "\n" << tree::text_of(log);
      // Nobody may take the example for a measurement.
      if (line.find(" check ") != std::string::npos || line.find(" fit ") != std::string::npos) {
        EXPECT_NE(tree::text_of(log).find("synthetic"), std::string::npos) << line;
      }
      ++commands;
    }
  }
  EXPECT_EQ(files, 3);
  EXPECT_EQ(commands, 4);
  EXPECT_TRUE(fs::is_regular_file(folder / "my-result/fit.json"));
  EXPECT_TRUE(fs::is_regular_file(folder / "my-pages/my-spheres.html"));
  EXPECT_TRUE(fs::is_regular_file(folder / "my-pages/index.html"));
  if (!HasFailure()) fs::remove_all(folder);
}

TEST(Readme, LinksLeadSomewhere) {
  static const std::regex link(R"re(\]\(([^)#:]+)\))re");
  const std::string text = tree::text_of(tree::root() / "README.md");
  for (auto it = std::sregex_iterator(text.begin(), text.end(), link); it != std::sregex_iterator();
       ++it) {
    const std::string target = (*it)[1].str();
    EXPECT_TRUE(fs::exists(tree::root() / target)) << "README.md links to " << target;
  }
}

TEST(Readme, NamesEveryShippedDataset) {
  const std::string text = tree::text_of(tree::root() / "README.md");
  std::size_t count = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(tree::root() / "datasets")) {
    if (!entry.is_directory()) continue;
    const std::string row = "| `" + entry.path().filename().string() + "` |";
    EXPECT_NE(text.find(row), std::string::npos) << "the README's table lacks " << row;
    ++count;
  }
  EXPECT_EQ(count, 6U);
}

}  // namespace
