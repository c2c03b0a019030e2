// One page of the tables of the coverage study, read from files.
#include "report/coverage_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.hpp"
#include "core/files.hpp"

namespace recoil {
namespace {

using testing::HasSubstr;

const std::string heads =
    "| design | parameter | identifiable, % | warned, % | recommended, % | where identifiable, % | "
    "profile | |\n|---|---|---|---|---|---|---|---|\n";

class Summary : public testing::Test {
 protected:
  Summary() : folder_(testing::TempDir() + "recoil-coverage-summary-" + std::to_string(getpid())) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~Summary() override { std::filesystem::remove_all(folder_); }
  Summary(const Summary&) = delete;
  Summary& operator=(const Summary&) = delete;

  void write(const std::string& name, const std::string& rows) const {
    write_whole_file(folder_ / name, "## T\n\n400 simulated data sets per design, level 95 %.\n\n" +
                                         heads + rows + "\nafter it | nothing\n");
  }

  std::filesystem::path folder_;
};

TEST_F(Summary, NamesTheWorstParameterOfEveryDesign) {
  write("coverage-designs.md", "| dahneke | C_H | 99.0 | 1.0 | 95.1 | 95.0 | 95.1 | holds |\n");
  write("coverage-grid-n20.md",
        "| n20 10 % stated f0-free | C_A | 2.0 | 98.0 | 80.0 | 40.0 | 80.0 | warned |\n"
        "| n20 10 % stated f0-free | f0 | 100.0 | 0.0 | 95.9 | 95.9 | 95.9 | holds |\n"
        "| n20 equal estimated f0-fixed captures | C_H | 98.0 | 2.0 | 96.9 | 96.9 | 1 | holds |\n"
        "| n20 equal estimated f0-fixed captures | V*(4.9 um) | 100.0 | 0.0 | 92.5 | 92.5 | | TOO "
        "NARROW |\n");
  write_whole_file(folder_ / "coverage-old.md", "| a | table |\n|---|---|\n| of | others |\n");
  const std::vector<CoverageTable> tables = read_coverage_tables(folder_);
  ASSERT_EQ(tables.size(), 2U) << "the third is no table of coverage";
  EXPECT_EQ(tables[1].datasets, 400);
  EXPECT_DOUBLE_EQ(tables[1].level, 0.95);
  const std::string page = coverage_summary(tables, "picture.svg");
  EXPECT_THAT(page, HasSubstr("| dahneke | C_H | 99.0 |"));
  EXPECT_THAT(page, HasSubstr("| 20 | equal | estimated | fixed | with | 400 | V*: 92.5 (92.5) | 0 "
                              "| - | V* too narrow |"));
  EXPECT_THAT(page, HasSubstr("| 20 | 10 % | stated | free | - | 400 | f0: 95.9 (95.9) | 0 | C_A | "
                              "holds |"))
      << "what the verdict warned of is not the worst";
  EXPECT_THAT(page, HasSubstr("of 4 rows 2 hold, in 1 more the verdict warns, 1 are too narrow and "
                              "0 too wide"));
  EXPECT_THAT(page, HasSubstr("(picture.svg)"));
  EXPECT_LT(page.find("| 20 | equal"), page.find("| 20 | 10 %")) << "the order of the grid";
  const std::vector<GridResult> grid = grid_of_tables(tables);
  ASSERT_EQ(grid.size(), 2U);
  EXPECT_EQ(grid[0].coverage.rows[1].cells[0].held, 370);
}

TEST_F(Summary, RefusesATableThatItCannotRead) {
  EXPECT_THROW(read_coverage_tables(folder_), InputError);
  write("coverage-a.md", "| n20 | C_A | 2.0 | 98.0 | 80.0 |\n");
  EXPECT_THROW(read_coverage_tables(folder_), InputError);
  write_whole_file(folder_ / "coverage-a.md",
                   heads + "| n20 | C_A | 2.0 | 98.0 | 80.0 | 40.0 | 80.0 | holds |\n");
  EXPECT_THROW(read_coverage_tables(folder_), InputError) << "of how many?";
  write("coverage-a.md", "| n20 | C_A | 2.0 | 98.0 | many | 40.0 | 80.0 | holds |\n");
  EXPECT_THROW(read_coverage_tables(folder_), InputError);
}

}  // namespace
}  // namespace recoil
