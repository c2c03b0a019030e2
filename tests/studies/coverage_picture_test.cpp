// The picture of the coverage study: colours against hand-worked values, cells against the results.
#include "studies/coverage_picture.hpp"

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
Rgb rgb(double share) {
  Rgb c;
  EXPECT_EQ(std::sscanf(coverage_colour(share, 0.95).c_str(), "#%2x%2x%2x",
                        reinterpret_cast<unsigned*>(&c.red), reinterpret_cast<unsigned*>(&c.green),
                        reinterpret_cast<unsigned*>(&c.blue)),
            3);
  return c;
}

TEST(CoverageColour, IsWhiteWhereTheStudyIsContent) {
  for (const double share : {0.93, 0.94, 0.95, 0.96, 0.97}) {
    EXPECT_EQ(coverage_colour(share, 0.95), "#ffffff") << share;
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

IntervalCoverage counted(const std::string& interval, int offered, int contained) {
  return {interval, offered, contained, 0, 0, {}};
}

/// Every design, numbers that can be recognised.
std::vector<ParameterCoverage> study() {
  std::vector<ParameterCoverage> rows;
  int n = 0;
  for (const GridDesign& design : coverage_grid()) {
    for (const char* name : {"C_H", "C_A", "f0", "V*(4.90 um)"}) {
      if (std::string(name) == "f0" && !design.adhesion_free) continue;
      ParameterCoverage row;
      row.design = design.name();
      row.parameter = name;
      row.usable = 1000;
      row.identifiable = std::string(name) == "V*(4.90 um)" ? 0 : 1000 - 13 * n;
      int k = 0;
      for (const char* kind :
           {"recommended", "profile", "percentile", "bca", "studentized", "wald"}) {
        const bool none = std::string(name) == "V*(4.90 um)" && k != 0 && k != 2;
        row.intervals.push_back(
            counted(kind, none ? 0 : 1000, 950 + 2 * (n % 21 - 10) - 25 * (k > 1 ? k : 0)));
        ++k;
      }
      rows.push_back(row);
    }
    ++n;
  }
  return rows;
}

std::string picture(const std::vector<ParameterCoverage>& rows) {
  return coverage_picture(rows, 0.95, "example <fit>", "made up & not measured");
}

std::size_t occurrences(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at) ++count;
  return count;
}

TEST(CoveragePicture, HasEveryCellOfTheGrid) {
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

TEST(CoveragePicture, ShowsTheShareThatContainedAndTheShareThatWasCalledIdentifiable) {
  ParameterCoverage row;
  row.design = GridDesign{20, GridNoise::near_capture, false, true, true}.name();
  row.parameter = "f0";
  row.usable = 200;
  row.identifiable = 150;
  row.intervals = {
      counted("recommended", 200, 183), counted("wald", 80, 60), {"bca", {}, {}, {}, {}, 0.876}};
  const std::string svg = picture({row});
  EXPECT_THAT(svg, HasSubstr(">91.5<"));
  EXPECT_THAT(svg, HasSubstr(">75.0<")) << "of those that were offered";
  EXPECT_THAT(svg, HasSubstr(">87.6<")) << "of which only the share is known";
  EXPECT_THAT(svg, HasSubstr(">75<"));
  EXPECT_THAT(svg, HasSubstr(">near-capture<"));
  EXPECT_THAT(svg, HasSubstr(">estimated<"));
  EXPECT_THAT(svg, HasSubstr(">free<"));
  EXPECT_THAT(svg, HasSubstr(">with<"));
  EXPECT_THAT(svg, Not(HasSubstr("opacity=")));
  row.identifiable = 20;
  EXPECT_THAT(picture({row}), HasSubstr("opacity=")) << "warned in nine of ten";
}

}  // namespace
}  // namespace recoil
