// The picture of the coverage study: colours against hand-worked values, cells against the results.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <map>

#include "core/files.hpp"
#include "plot/draw.hpp"
#include "validation/studies/coverage_page.hpp"

namespace recoil {
namespace {

using testing::HasSubstr;

std::string coverage_colour(double share, double level) {
  return plot::colour_of(coverage_colours(level), share);
}

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

std::pair<std::string, IntervalCoverage> counted(const std::string& interval, int offered,
                                                 int contained) {
  return {interval, {offered, contained, 0, 0, {}}};
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

plot::Picture picture(const std::vector<ParameterCoverage>& rows) {
  return coverage_picture(rows, 0.95, "example <fit>", "made up & not measured");
}

/// The words of a picture, with their colours.
std::map<std::string, plot::Colour> words_of(const plot::Picture& picture) {
  std::map<std::string, plot::Colour> words;
  for (const plot::Layer& layer : picture.plots.at(0).layers) {
    if (const auto* one = std::get_if<plot::Words>(&layer)) words[one->text] = one->colour;
  }
  return words;
}

const plot::Boxes& cells_of(const plot::Picture& picture) {
  return std::get<plot::Boxes>(picture.plots.at(0).layers.at(0));
}

TEST(CoveragePicture, HasEveryCellOfTheGrid) {
  const plot::Picture shown = picture(study());
  EXPECT_THAT(shown.title, HasSubstr("example <fit>"));
  EXPECT_THAT(shown.plots.at(0).remark, HasSubstr("made up & not measured"));
  // 72 designs x 2 parameters x 6 kinds, 36 with f0 x 6, 72 x 2 kinds of V*.
  EXPECT_EQ(cells_of(shown).size(), 72U * 12U + 36U * 6U + 72U * 2U);
  EXPECT_EQ(cells_of(shown).values.size(), cells_of(shown).size());
  EXPECT_EQ(shown.plots.at(0).y.ticks.size(), 72U);
  // What is identifiable, and the kinds, of C_H, C_A and f0; two kinds of V*.
  EXPECT_EQ(shown.plots.at(0).x.ticks.size(), 3U * 7U + 2U);
  const std::string svg = plot::draw_svg(shown);
  if (const char* file = std::getenv("RECOIL_COVERAGE_PICTURE")) write_whole_file(file, svg);
  EXPECT_LT(svg.size(), 400000U);
}

TEST(CoveragePicture, ShowsTheShareThatContainedAndTheShareThatWasCalledIdentifiable) {
  ParameterCoverage row;
  row.design = GridDesign{20, GridNoise::near_capture, false, true, true}.name();
  row.parameter = "f0";
  row.usable = 200;
  row.identifiable = 150;
  row.intervals = {counted("recommended", 200, 183), counted("wald", 80, 60),
                   counted("bca", 1000, 876)};
  const plot::Picture shown = picture({row});
  std::map<std::string, plot::Colour> words = words_of(shown);
  EXPECT_TRUE(words.contains("91.5"));
  EXPECT_TRUE(words.contains("75.0")) << "of those that were offered";
  EXPECT_TRUE(words.contains("87.6")) << "of which only the share is known";
  EXPECT_TRUE(words.contains("75"));
  EXPECT_EQ(shown.plots.at(0).y.ticks.at(0).label, row.design);
  // recommended 183 / 200, BCa 0.876, Wald 60 / 80, in the order of the columns
  EXPECT_EQ(cells_of(shown).values, (std::vector<double>{0.915, 0.876, 0.75}));
  EXPECT_EQ(std::get<plot::Boxes>(shown.plots.at(0).layers.at(1)).size(), 0U);
  row.identifiable = 20;
  const plot::Picture warned = picture({row});
  EXPECT_EQ(std::get<plot::Boxes>(warned.plots.at(0).layers.at(1)).size(), 3U)
      << "pale: warned in nine of ten";
}

}  // namespace
}  // namespace recoil
