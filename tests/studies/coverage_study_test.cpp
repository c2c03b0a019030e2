// Rows, verdicts and the summary of the coverage study, from facts made up by hand.
#include "validation/studies/coverage_study.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "support/document_parts.hpp"
#include "validation/studies/coverage_page.hpp"

namespace recoil {
namespace {

ParameterCoverage row(const std::string& design, const std::string& parameter, int identifiable,
                      int contained, int contained_identifiable) {
  ParameterCoverage made;
  made.design = design;
  made.parameter = parameter;
  made.unit = "s/m";
  made.usable = 400;
  made.identifiable = identifiable;
  made.intervals = {{"recommended", {400, contained, identifiable, contained_identifiable, {}}},
                    {"wald", {400, 350, 0, 0, 0.3}}};
  return made;
}

TEST(CoverageVerdict, AsksAllDataSets) {
  EXPECT_EQ(verdict_of(row("d", "C_H", 400, 380, 380)), CoverageVerdict::nominal);
  EXPECT_EQ(verdict_of(row("d", "C_H", 400, 371, 371)), CoverageVerdict::too_narrow);
  EXPECT_EQ(verdict_of(row("d", "C_H", 400, 372, 372)), CoverageVerdict::nominal) << "93 %";
  EXPECT_EQ(verdict_of(row("d", "C_H", 400, 388, 388)), CoverageVerdict::nominal) << "97 %";
  EXPECT_EQ(verdict_of(row("d", "C_H", 400, 389, 389)), CoverageVerdict::too_wide);
  EXPECT_EQ(verdict_of(row("d", "C_H", 200, 380, 185)), CoverageVerdict::nominal)
      << "not only those with a small estimate of the error";
}

TEST(CoverageVerdict, IsMisleadingWhereALargeErrorIsCalledIdentifiable) {
  ParameterCoverage edge = row("d", "C_A", 20, 380, 14);
  EXPECT_FALSE(misleads(edge)) << "nobody knows its error";
  edge.actual_error = 0.11;
  EXPECT_FALSE(misleads(edge)) << "in 5 % of the data sets";
  edge.identifiable = 21;
  EXPECT_TRUE(misleads(edge));
  edge.actual_error = 0.09;
  EXPECT_FALSE(misleads(edge));
  edge.actual_error = 0.11;
  edge.parameter = "V*(4.9 um)";
  EXPECT_FALSE(misleads(edge));
}

TEST(CoverageVerdict, IsAWarningWhereNineOfTenWereWarned) {
  EXPECT_EQ(verdict_of(row("d", "C_H", 40, 300, 10)), CoverageVerdict::warned);
  EXPECT_EQ(verdict_of(row("d", "C_H", 40, 380, 10)), CoverageVerdict::nominal_warned);
  EXPECT_EQ(verdict_of(row("d", "C_H", 41, 300, 10)), CoverageVerdict::too_narrow);
  EXPECT_EQ(verdict_of(row("d", "C_H", 0, 300, 0)), CoverageVerdict::warned);
}

TEST(CoverageSummary, TheWorstRowIsAMissThenWhatNobodyWarnedOf) {
  const ParameterCoverage warned = row("d", "C_A", 8, 320, 3);
  const ParameterCoverage fine = row("d", "f0", 400, 384, 384);
  const ParameterCoverage finer = row("d", "C_H", 400, 381, 381);
  const ParameterCoverage miss = row("d", "V*(4.9 um)", 400, 370, 370);
  EXPECT_EQ(worst_of({&warned, &fine, &finer, &miss}).parameter, "V*(4.9 um)");
  EXPECT_EQ(worst_of({&warned, &finer, &fine}).parameter, "f0")
      << "what the verdict warned of is not the worst";
  const CoverageTally tally = tally_of({warned, fine, finer, miss});
  EXPECT_EQ(tally.rows, 4);
  EXPECT_EQ(tally.nominal(), 2);
  EXPECT_EQ(tally.of[CoverageVerdict::warned], 1);
  EXPECT_EQ(tally.of[CoverageVerdict::too_narrow], 1);
}

TEST(CoverageSummary, HasTheDesignsOfTheGridInItsOrder) {
  CoverageStudy study;
  study.stamp.study = "coverage-grid-n20";
  study.grid_of = "example";
  study.datasets = 400;
  study.rows = {row("n20 10 % stated f0-free", "f0", 400, 384, 384),
                row("n20 equal estimated f0-fixed captures", "C_H", 400, 385, 385)};
  const Document page = coverage_summary({study});
  const Section* grid = support::section_of(page, "grid");
  ASSERT_NE(grid, nullptr);
  ASSERT_EQ(support::tables_of(*grid).size(), 1U);
  const Table& table = *support::tables_of(*grid).front();
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(plain_text(words_of_cell(table.rows[0][1])), "equal");
  EXPECT_EQ(plain_text(words_of_cell(table.rows[1][1])), "10 %");
  EXPECT_EQ(figures_of(*grid).size(), 1U);
}

class Files : public testing::Test {
 protected:
  Files() : file_(testing::TempDir() + "recoil-study-" + std::to_string(getpid()) + ".json") {}
  ~Files() override { std::filesystem::remove(file_); }
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;
  std::filesystem::path file_;
};

TEST_F(Files, AStudyComesBackFromItsJson) {
  CoverageStudy study;
  study.stamp = {"coverage-designs", "recoil_study coverage-designs a.toml", "0123"};
  study.datasets = 400;
  study.replicates = 39;
  study.seed = 7;
  study.level = 0.95;
  study.designs = {{"dahneke", TruthOrigin::recipe, 1, 0}};
  study.sources = {{"dahneke", Provenance::reconstruction}};
  study.rows = {row("dahneke", "C_H", 390, 381, 372)};
  study.rows.front().relative_width = 0.25;
  study.rows.front().actual_error = 0.06;
  study.exact_materials = false;
  write_whole_file(file_, study_json(study), Replacing::data);
  const CoverageStudy back = read_coverage_study(file_);
  EXPECT_EQ(study_json(back), study_json(study));
  EXPECT_EQ(back.designs.front().truth, TruthOrigin::recipe);
  EXPECT_EQ(back.designs.front().fits_failed, 1);
  EXPECT_EQ(back.designs.front().refits_failed, 0);
  EXPECT_FALSE(back.exact_materials);
  EXPECT_DOUBLE_EQ(back.rows.front().recommended().share().value(), 381.0 / 400.0);
  EXPECT_DOUBLE_EQ(back.rows.front().find("wald")->share().value(), 0.875);
  EXPECT_DOUBLE_EQ(back.rows.front().find("wald")->relative_width.value(), 0.3);
  EXPECT_DOUBLE_EQ(back.rows.front().actual_error.value(), 0.06);
  EXPECT_FALSE(back.rows.front().find("wald")->share_identifiable().has_value());
}

TEST_F(Files, WhatIsNoStudyIsRefused) {
  for (const char* text : {"", "{}", "[1]", R"({"study": "a", "command": "b", "key": "c"})"}) {
    write_whole_file(file_, text, Replacing::data);
    EXPECT_THROW(read_coverage_study(file_), InputError) << text;
  }
}

}  // namespace
}  // namespace recoil
