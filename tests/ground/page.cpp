#include "page.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "support/command.hpp"
#include "tree.hpp"

namespace page {

namespace fs = std::filesystem;

namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// The cells of one line of a table, trimmed.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::size_t begin = 1;
  for (std::size_t end; (end = line.find('|', begin)) != std::string::npos; begin = end + 1) {
    cells.push_back(trimmed(line.substr(begin, end - begin)));
  }
  return cells;
}

std::string file_named_in(const std::string& paragraph) {
  static const std::regex name(R"re(`([A-Za-z0-9_./-]+\.(?:csv|json|toml|py|R))`)re");
  std::smatch match;
  const bool named =
      !paragraph.empty() && paragraph.back() == ':' && std::regex_search(paragraph, match, name);
  return named ? match[1].str() : "";
}

/// Expects the lines of `wanted` in `output`, in this order.
void expect_shown(const std::string& output, const std::string& wanted) {
  std::size_t at = 0;
  for (const std::string& line : tree::lines_of(wanted)) {
    const std::size_t found = output.find(trimmed(line), at);
    EXPECT_NE(found, std::string::npos) << "the page shows\n"
                                        << line << "\nbut it prints\n"
                                        << output;
    if (found != std::string::npos) at = found;
  }
}

}  // namespace

std::vector<Block> blocks_of(const fs::path& markdown) {
  static const std::regex fails(R"re(<!-- fails: (\d+) -->)re");
  std::vector<Block> blocks;
  Block next;
  std::string paragraph;
  bool ended = false;  // an empty line follows the paragraph
  bool inside = false;
  for (const std::string& line : tree::lines_of(tree::text_of(markdown))) {
    std::smatch match;
    if (line.rfind("```", 0) == 0) {
      inside = !inside;
      if (!inside) continue;
      next.language = line.substr(3);
      next.file = file_named_in(paragraph);
      blocks.push_back(next);
      next = {};
      paragraph.clear();
    } else if (inside) {
      blocks.back().text += line + "\n";
    } else if (line.rfind("<!-- not run", 0) == 0) {
      next.run = false;
    } else if (std::regex_search(line, match, fails)) {
      next.exit_status = std::stoi(match[1]);
    } else if (line.empty()) {
      ended = true;
    } else {
      if (ended) paragraph.clear();
      paragraph += (paragraph.empty() ? "" : " ") + line;
      ended = false;
    }
  }
  return blocks;
}

std::size_t column_of(const fs::path& markdown, const std::string& header,
                      const std::string& title) {
  for (const std::string& line : tree::lines_of(tree::text_of(markdown))) {
    if (line.rfind(header, 0) != 0) continue;
    const std::vector<std::string> titles = cells_of(line);
    const auto found = std::find(titles.begin(), titles.end(), title);
    if (found != titles.end()) return static_cast<std::size_t>(found - titles.begin());
  }
  ADD_FAILURE() << markdown << " has no table " << header << " with a column " << title;
  return 0;
}

std::vector<std::vector<std::string>> table_of(const fs::path& markdown,
                                               const std::string& header) {
  std::vector<std::vector<std::string>> rows;
  bool inside = false;
  for (const std::string& line : tree::lines_of(tree::text_of(markdown))) {
    if (line.rfind("|", 0) != 0) inside = false;
    if (inside && line.rfind("|--", 0) != 0) {
      rows.push_back(cells_of(line));
    }
    if (line.rfind(header, 0) == 0) inside = true;
  }
  EXPECT_FALSE(rows.empty()) << markdown << " has no table " << header;
  return rows;
}

Sandbox::Sandbox() {
  fs::create_directories(folder() / "build/release");
  fs::create_symlink(RECOIL_BINARY, folder() / "build/release/recoil");
  for (const char* name : {"python", "recoil_tables"}) {
    fs::create_symlink(fs::path(RECOIL_BINARY).parent_path() / name,
                       folder() / "build/release" / name);
  }
  for (const char* name : {"datasets", "fits"}) {
    fs::copy(tree::root() / name, folder() / name, fs::copy_options::recursive);
  }
}

Sandbox::Outcome Sandbox::run(const std::string& script) const {
  const support::Outcome outcome =
      support::run_command({"bash", "-eu", "-c", "exec 2>&1\n" + script}, folder());
  return {outcome.status, outcome.out};
}

Sandbox::Counts Sandbox::follow(const std::vector<Block>& blocks) const {
  Counts counts;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Block& block = blocks[i];
    if (block.language != "sh") {
      if (block.file.empty()) continue;
      folder_.write(block.file, block.text);
      ++counts.files;
      continue;
    }
    if (!block.run) continue;
    const Outcome outcome = run(block.text);
    EXPECT_EQ(outcome.status, block.exit_status) << block.text << "\n" << outcome.output;
    if (i + 1 < blocks.size() && blocks[i + 1].language == "text") {
      expect_shown(outcome.output, blocks[i + 1].text);
    }
    counts.output += outcome.output;
    ++counts.scripts;
  }
  return counts;
}

}  // namespace page
