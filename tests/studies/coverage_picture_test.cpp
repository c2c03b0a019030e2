// The picture of the coverage study: colours against hand-worked values, cells against the results.
#include "report/coverage_picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "core/files.hpp"

namespace recoil {
namespace {

using testing::HasSubstr;
using testing::Not;

struct Rgb {
  int red = 0, green = 0, blue = 0;
};
Rgb rgb(double held) {
  Rgb c;
  EXPECT_EQ(std::sscanf(coverage_colour(held, 0.95).c_str(), "#%2x%2x%2x",
                        reinterpret_cast<unsigned*>(&c.red), reinterpret_cast<unsigned*>(&c.green),
                        reinterpret_cast<unsigned*>(&c.blue)),
            3);
  return c;
}

TEST(CoverageColour, IsWhiteWhereTheStudyIsContent) {
  for (const double held : {0.93, 0.94, 0.95, 0.96, 0.97}) {
    EXPECT_EQ(coverage_colour(held, 0.95), "#ffffff") << held;
  }
}

TEST(CoverageColour, IsOrangeBelowAndBlueAbove) {
  EXPECT_EQ(coverage_colour(0.80, 0.95), "#d55e00");
  EXPECT_EQ(coverage_colour(0.10, 0.95), "#d55e00");
  EXPECT_EQ(coverage_colour(1.00, 0.95), "#0072b2");
  const Rgb low = rgb(0.92);
  EXPECT_GT(low.red, low.blue);
  EXPECT_LT(low.blue, 255) << "one percent beyond is visible";
  const Rgb high = rgb(0.98);
  EXPECT_GT(high.blue, high.red);
  EXPECT_GT(rgb(0.90).blue, rgb(0.85).blue) << "deeper further away";
}

/// Every design, numbers that can be recognised.
std::vector<GridResult> study() {
  std::vector<GridResult> results;
  for (const GridDesign& design : coverage_grid()) {
    GridResult result;
    result.design = design;
    result.coverage.datasets = 1010;
    result.coverage.failed = 10;
    const int n = static_cast<int>(results.size());
    for (const char* name : {"C_H", "C_A", "f0", "V*(4.90 um)"}) {
      if (std::string(name) == "f0" && !design.adhesion_free) continue;
      CoverageRow row;
      row.parameter = name;
      row.identifiable = std::string(name) == "V*(4.90 um)" ? 0 : 1000 - 13 * n;
      for (const char* kind :
           {"recommended", "profile", "percentile", "bca", "studentized", "wald"}) {
        CoverageCell cell;
        cell.interval = kind;
        cell.offered = 1000;
        const int k = static_cast<int>(row.cells.size());
        cell.held = 950 + 2 * (n % 21 - 10) - 25 * (k > 1 ? k : 0);
        if (std::string(name) == "V*(4.90 um)" && k != 0 && k != 2) cell.offered = 0;
        row.cells.push_back(cell);
      }
      result.coverage.rows.push_back(row);
    }
    results.push_back(result);
  }
  return results;
}

std::string picture(const std::vector<GridResult>& results) {
  FitSpec spec;
  spec.id = "example <fit>";
  CoverageOptions options;
  options.datasets = 1010;
  options.uncertainty.level = 0.95;
  return coverage_picture(results, spec, options, "made up & not measured");
}

std::size_t occurrences(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at) ++count;
  return count;
}

TEST(CoveragePicture, HoldsEveryCellOfTheGrid) {
  const std::string svg = picture(study());
  if (const char* file = std::getenv("RECOIL_COVERAGE_PICTURE")) write_whole_file(file, svg);
  EXPECT_TRUE(svg.starts_with("<svg ")) << svg.substr(0, 40);
  EXPECT_THAT(svg, HasSubstr("example &lt;fit&gt;"));
  EXPECT_THAT(svg, HasSubstr("made up &amp; not measured"));
  // 72 designs x 2 parameters x 6 kinds, 36 with f0 x 6, 72 x 2 kinds of V*, and the background.
  EXPECT_EQ(occurrences(svg, "<rect "), 72U * 12U + 36U * 6U + 72U * 2U + 1U + 7U /* legend */);
  EXPECT_EQ(occurrences(svg, "<text"), occurrences(svg, "</text>"));
  EXPECT_LT(svg.size(), 400000U);
}

TEST(CoveragePicture, ShowsTheShareThatHeldAndTheShareThatWasCalledIdentifiable) {
  GridResult result;
  result.design = {20, GridNoise::near_capture, false, true, true};
  result.coverage.datasets = 210;
  result.coverage.failed = 10;
  CoverageRow row;
  row.parameter = "f0";
  row.identifiable = 150;  // of 200 usable: 75 %
  row.cells = {{"recommended", 200, 183, 0, 0, 0.0}, {"wald", 80, 60, 0, 0, 0.0}};
  result.coverage.rows = {row};
  const std::string svg = picture({result});
  EXPECT_THAT(svg, HasSubstr(">91.5<"));
  EXPECT_THAT(svg, HasSubstr(">75.0<")) << "of those that were offered";
  EXPECT_THAT(svg, HasSubstr(">75<"));
  EXPECT_THAT(svg, HasSubstr(">near-capture<"));
  EXPECT_THAT(svg, HasSubstr(">estimated<"));
  EXPECT_THAT(svg, HasSubstr(">free<"));
  EXPECT_THAT(svg, HasSubstr(">with<"));
  EXPECT_THAT(svg, Not(HasSubstr("opacity=")));
  result.coverage.rows[0].identifiable = 20;
  EXPECT_THAT(picture({result}), HasSubstr("opacity=")) << "warned in nine of ten";
}

}  // namespace
}  // namespace recoil
