// The README's tour is run exactly as it is printed, its links lead somewhere, and its numbers are
// those of the reports.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "page.hpp"
#include "tree.hpp"

namespace {

namespace fs = std::filesystem;

fs::path readme() { return tree::root() / "README.md"; }

TEST(Readme, TheTourRunsAsPrinted) {
  const page::Sandbox sandbox;
  const page::Sandbox::Counts counts = sandbox.follow(page::blocks_of(readme()));
  EXPECT_EQ(counts.files, 2) << "nothing else to type but commands";
  EXPECT_EQ(counts.scripts, 2);
  // Nobody may take the example for a measurement.
  EXPECT_NE(counts.output.find("synthetic"), std::string::npos);
  EXPECT_TRUE(fs::is_regular_file(sandbox.folder() / "my-pages/fit.html"));
  EXPECT_TRUE(fs::is_regular_file(sandbox.folder() / "my-pages/index.html"));
  // e = sqrt(38.1 / 50), and the drag of air makes it a little larger.
  const auto first_row = [&](const char* folder) {
    return tree::lines_of(tree::text_of(sandbox.folder() / folder / "points.csv")).at(1);
  };
  EXPECT_NE(first_row("my-points").find(",4.9,1.2,0.61"), std::string::npos)
      << first_row("my-points");
  EXPECT_NE(first_row("my-balls").find(",0.87"), std::string::npos) << first_row("my-balls");
}

TEST(Readme, TheThreeCalibrationsAreThoseOfTheFit) {
  const page::Sandbox sandbox;
  const auto run = sandbox.run(
      "build/release/recoil fit fits/wall1990-molybdenum.toml --replicates 39 --out fitted");
  ASSERT_EQ(run.status, 0) << run.output;
  const auto fit = nlohmann::json::parse(tree::text_of(sandbox.folder() / "fitted/fit.json"));
  const auto rows = page::table_of(readme(), "| molybdenum");
  ASSERT_EQ(rows.size(), fit["comparison"].size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto& way = fit["comparison"][k];
    const double found[] = {way["C_H"], way["C_A"], way["f0"], way["rmse"]};
    for (std::size_t j = 0; j < 4; ++j) {
      EXPECT_NEAR(std::stod(rows[k][j + 1]) / found[j], 1.0, 5e-3) << rows[k][0];  // three digits
    }
  }
}

TEST(Readme, IsShort) { EXPECT_LE(tree::lines_of(tree::text_of(readme())).size(), 120U); }

TEST(Readme, LinksLeadSomewhere) {
  static const std::regex link(R"re(\]\(([^)#:]+)\))re");
  std::vector<fs::path> pages = {readme()};
  for (const auto& entry : fs::directory_iterator(tree::root() / "docs")) {
    pages.push_back(entry.path());
  }
  ASSERT_GT(pages.size(), 20U);
  for (const fs::path& file : pages) {
    const std::string text = tree::text_of(file);
    for (auto it = std::sregex_iterator(text.begin(), text.end(), link);
         it != std::sregex_iterator(); ++it) {
      const std::string target = (*it)[1].str();
      EXPECT_TRUE(fs::exists(file.parent_path() / target)) << file << " links to " << target;
    }
  }
}

TEST(Readme, TheManualsListHasEveryPage) {
  const std::string text = tree::text_of(tree::root() / "docs/README.md");
  for (const auto& entry : fs::directory_iterator(tree::root() / "docs")) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() != ".md" || name == "README") continue;
    EXPECT_NE(text.find("| [" + name + "](" + name + ".md) |"), std::string::npos) << name;
  }
}

TEST(Readme, NamesEveryShippedDataset) {
  // What has no recipe was measured.
  std::size_t count = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(tree::root() / "datasets")) {
    if (!entry.is_directory()) continue;
    ++count;
    const bool made = fs::exists(entry.path() / "recipe.toml");
    for (const fs::path& file :
         {readme(), tree::root() / (made ? "docs/reconstruct.md" : "docs/table-tennis.md")}) {
      const std::string text = tree::text_of(file);
      const std::string name = "`" + entry.path().filename().string() + "`";
      EXPECT_NE(text.find(name), std::string::npos) << file << " lacks " << name;
    }
  }
  EXPECT_EQ(count, 9U);
}

TEST(Readme, TheFilmsOfTheManualAreThoseOfThePoints) {
  const auto rows = page::table_of(tree::root() / "docs/table-tennis.md", "| dataset |");
  for (const std::vector<std::string>& row : rows) {
    const std::string folder = row.at(0).substr(1, row.at(0).size() - 2);
    const double least = std::stod(row.at(1));
    const double most = std::stod(row.at(1).substr(row.at(1).find("to ") + 3));
    double count = 0.0;
    double sum = 0.0;
    std::vector<std::string> header;
    for (const std::string& line :
         tree::lines_of(tree::text_of(tree::root() / "datasets" / folder / "points.csv"))) {
      std::vector<std::string> cells;
      std::istringstream text(line);
      for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
      if (header.empty()) {
        header = cells;
        continue;
      }
      const auto value = [&](const char* name) {
        const auto at = std::ranges::find(header, name) - header.begin();
        return std::stod(cells.at(static_cast<std::size_t>(at)));
      };
      if (value("incident_velocity") < least || value("incident_velocity") >= most) continue;
      count += 1.0;
      sum += value("restitution");
    }
    EXPECT_EQ(std::to_string(static_cast<int>(count)), row.at(2)) << folder << " " << row.at(1);
    EXPECT_NEAR(sum / count, std::stod(row.at(3)), 6e-4) << folder << " " << row.at(1);
  }
}

TEST(Readme, TheManualNamesEveryFolderOfTheSource) {
  const std::string text = tree::text_of(tree::root() / "docs/extend.md");
  for (const fs::directory_entry& entry : fs::directory_iterator(tree::root() / "src")) {
    if (!entry.is_directory()) continue;
    const std::string row = "| `" + entry.path().filename().string() + "` |";
    EXPECT_NE(text.find(row), std::string::npos) << "docs/extend.md lacks the row " << row;
  }
}

/// What the table of the shipped designs has to say of one parameter; of capture velocities, that
/// of the size whose intervals contain the truth least often.
std::string coverage_words(const std::vector<std::vector<std::string>>& study,
                           const std::string& design, const std::string& parameter,
                           std::size_t recommended, std::size_t identifiable) {
  const std::vector<std::string>* least = nullptr;
  for (const std::vector<std::string>& row : study) {
    if (row.at(0) != design || row.at(1).rfind(parameter, 0) != 0) continue;
    if (least == nullptr || std::stod(row.at(recommended)) < std::stod(least->at(recommended))) {
      least = &row;
    }
  }
  if (least == nullptr) return "not in the study";
  const bool warned = std::stod(least->at(identifiable)) <= 10.0;
  return least->at(recommended) + " %" + (warned ? ", warned" : "");
}

TEST(Readme, CoverageIsThatOfTheStudy) {
  const fs::path report = tree::root() / "reports/coverage-designs.md";
  const auto study = page::table_of(report, "| design |");
  const std::size_t recommended = page::column_of(report, "| design |", "recommended, %");
  const std::size_t identifiable = page::column_of(report, "| design |", "well determined, %");
  const fs::path file = tree::root() / "docs/coverage.md";
  const auto rows = page::table_of(file, "| design");
  EXPECT_GE(rows.size(), 4U);
  for (const std::vector<std::string>& row : rows) {
    ASSERT_EQ(row.size(), 4U);
    const std::string design = row[0].substr(1, row[0].find('`', 1) - 1);
    const char* parameters[] = {"C_H", "C_A", "V\\*"};
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(row[k + 1], coverage_words(study, design, parameters[k], recommended, identifiable))
          << file << " " << design << " " << parameters[k];
    }
  }
}

TEST(Readme, TheGridOfCoverageIsThatOfTheStudy) {
  static const std::regex grid(
      R"re(coverage-grid-n(\d+)-(\w+)\.md\): (\d+) data sets per design; of 42 rows (\d+) [a-z ]+, in (\d+) more the verdict warns, (\d+) are too narrow and (\d+) too wide)re");
  const auto rows = page::table_of(tree::root() / "docs/coverage.md", "| noise | points");
  const std::string study = tree::text_of(tree::root() / "reports/coverage.md");
  std::size_t compared = 0;
  for (auto it = std::sregex_iterator(study.begin(), study.end(), grid);
       it != std::sregex_iterator(); ++it) {
    for (const std::vector<std::string>& row : rows) {
      if (row.at(0) != (*it)[2] || row.at(1) != (*it)[1]) continue;
      for (std::size_t i = 2; i < 7; ++i) EXPECT_EQ(row.at(i), (*it)[i + 1]) << row[1] << row[0];
      ++compared;
    }
  }
  EXPECT_EQ(compared, rows.size());
}

/// "**65 %**, 86 of 132 (47 % at 10)" and "65 % (57 to 73), 86 of 132": the two numbers.
std::string share_in(const std::string& cell) {
  static const std::regex share(R"re((\d+) %.*?(\d+) of (\d+))re");
  std::smatch match;
  return std::regex_search(cell, match, share)
             ? match[1].str() + " %, " + match[2].str() + " of " + match[3].str()
             : cell;
}

TEST(Readme, DiagnosisIsThatOfTheStudy) {
  auto study = page::table_of(tree::root() / "reports/hidden-effects.md", "| bar |");
  std::erase_if(study, [](const auto& row) { return row.at(3) == "not studied"; });
  const auto manual =
      page::table_of(tree::root() / "docs/diagnose-accuracy.md", "| several diameters");
  ASSERT_EQ(manual.size(), study.size()) << "one row for every bar, in the same order";
  for (std::size_t i = 0; i < study.size(); ++i) {
    EXPECT_EQ(share_in(manual[i].at(2)), share_in(study[i].at(2))) << manual[i][0];
  }
  // "of 154 ... it named 65 outright, listed 124 ..., raised 6 alarms in 412"
  static const std::regex sentence(
      R"re(of (\d+) visible hidden effects it named (\d+) outright, listed (\d+) among possible causes, and named (none|\d+)\s+wrongly; where nothing was hidden it raised (\d+) alarms in (\d+) data sets)re");
  std::smatch said;
  const std::string text = tree::text_of(readme());
  ASSERT_TRUE(std::regex_search(text, said, sentence));
  const std::string numbers[] = {said[2].str() + " of " + said[1].str(),
                                 said[3].str() + " of " + said[1].str(),
                                 (said[4] == "none" ? "0" : said[4].str()) + " of " + said[1].str(),
                                 said[5].str() + " of " + said[6].str()};
  for (const std::string& number : numbers) {
    EXPECT_TRUE(std::any_of(study.begin(), study.end(), [&](const auto& row) {
      return row.at(2).find(number) != std::string::npos;
    })) << number;
  }
}

TEST(Readme, PlainMethodsAreThoseOfTheStudy) {
  const fs::path report = tree::root() / "reports/hidden-effects.md";
  const fs::path file = tree::root() / "docs/diagnose-compared.md";
  const auto asked = [](const fs::path& text) {
    return tree::text_of(text).find("\n| method |") != std::string::npos;
  };
  ASSERT_TRUE(asked(file));
  ASSERT_TRUE(asked(report)) << "the study was made without --baseline";
  const auto study = page::table_of(report, "| method |");
  const auto manual = page::table_of(file, "| method |");
  ASSERT_EQ(manual.size(), study.size()) << "one row for every method, in the same order";
  for (std::size_t i = 0; i < study.size(); ++i) {
    ASSERT_EQ(manual[i].size(), study[i].size());
    EXPECT_EQ(manual[i][0], study[i][0]);
    for (std::size_t k = 1; k < study[i].size(); ++k) {
      EXPECT_EQ(manual[i][k], share_in(study[i][k])) << manual[i][0];
    }
  }
  // The README has the wrong causes of stepwise AICc: "66 %, 101 of 154".
  std::string wrong = manual.at(1).at(3);
  wrong = std::regex_replace(wrong, std::regex("^.*, (\\d+) of (\\d+)$"), "$1 of the $2");
  EXPECT_NE(tree::text_of(tree::root() / "README.md").find("named a wrong cause in " + wrong),
            std::string::npos)
      << wrong;
}

}  // namespace
