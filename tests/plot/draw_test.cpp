// What gnuplot makes of pictures: every kind of layer, any text, the same bytes every time.
#include "plot/draw.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <set>

#include "core/error.hpp"
#include "plot/gnuplot_script.hpp"
#include "plot/xml.hpp"
#include "support/hostile_names.hpp"

namespace recoil::plot {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

Plot plot_with(Layer layer) {
  Plot plot;
  plot.x = {"velocity V", "m/s"};
  plot.x.set_range({0.0, 4.0});
  plot.y = {"C_H"};
  plot.y.set_range({0.0, 4.0});
  plot.layers = {std::move(layer)};
  return plot;
}

Picture picture_with(Layer layer) {
  return {"one", "A <picture> & more", 480, 340, {plot_with(std::move(layer))}};
}

Points three_points() { return {{1.0, 2.0, 3.0}, {2.0, NAN, 3.0}}; }

Contour hill() {
  Contour contour{{0.0, 4.0}, {0.0, 4.0}, {}, 0.5, {"#112233", 2.0}};
  for (int r = 0; r < 21; ++r) {
    contour.rows.emplace_back();
    for (int c = 0; c < 21; ++c) {
      contour.rows.back().push_back(std::exp(-0.02 * ((r - 10) * (r - 10) + (c - 10) * (c - 10))));
    }
  }
  return contour;
}

void for_each(const XmlNode& node, const std::function<void(const XmlNode&)>& act) {
  act(node);
  for (const XmlNode& child : node.children) for_each(child, act);
}

/// Whatever paints in this colour.
std::vector<XmlNode> painted(const std::string& svg, const std::string& colour) {
  std::vector<XmlNode> found;
  for_each(parse_xml(svg), [&](const XmlNode& node) {
    for (const char* key : {"stroke", "fill", "color"}) {
      const std::string* value = node.attribute(key);
      if (value != nullptr && *value == colour) {
        found.push_back(node);
        return;
      }
    }
  });
  return found;
}

TEST(Draw, IsReadyToInline) {
  const std::string svg = draw_svg(picture_with(three_points()));
  EXPECT_THAT(svg, StartsWith("<svg id=\"one\" viewBox=\"0 0 480 340\""));
  const XmlNode root = parse_xml(svg);
  EXPECT_EQ(*root.attribute("role"), "img");
  EXPECT_EQ(*root.attribute("aria-label"), "A &lt;picture&gt; &amp; more");
}

TEST(Draw, EveryIdBeginsWithTheNameAndEveryReferenceHasItsTarget) {
  Picture picture = picture_with(three_points());
  picture.plots.push_back(plot_with(hill()));
  picture.plots[0].frame = Frame{50.0, 200.0, 50.0, 300.0};
  picture.plots[1].frame = Frame{260.0, 460.0, 50.0, 300.0};
  std::multiset<std::string> ids;
  std::set<std::string> targets;
  for_each(parse_xml(draw_svg(picture)), [&](const XmlNode& node) {
    for (const auto& [key, value] : node.attributes) {
      if (key == "id") ids.insert(value);
      if (key == "xlink:href") targets.insert(value.substr(1));
    }
  });
  for (const std::string& id : ids) {
    EXPECT_THAT(id, StartsWith("one"));
    EXPECT_EQ(ids.count(id), 1U) << id;
  }
  EXPECT_FALSE(targets.empty());
  for (const std::string& target : targets) EXPECT_TRUE(ids.contains(target)) << target;
}

TEST(Draw, IsTheSameTwiceAndAmongOthers) {
  const Picture one = picture_with(three_points());
  Picture other = picture_with(hill());
  other.name = "other";
  const std::string alone = draw_svg(one);
  const std::vector<std::string> drawn = draw_svg({&other, &one, &other});
  ASSERT_EQ(drawn.size(), 3U);
  EXPECT_EQ(drawn[1], alone);
  EXPECT_EQ(drawn[0], drawn[2]);
  EXPECT_EQ(drawn[0], draw_svg(other));
}

TEST(Draw, DoesNotDependOnTheLocaleOrTheUsersSettings) {
  const Picture picture = picture_with(three_points());
  const std::string plain = draw_svg(picture);
  setenv("LC_ALL", "de_DE.UTF-8", 1);
  setenv("LC_NUMERIC", "de_DE.UTF-8", 1);
  setenv("GNUTERM", "nonsense", 1);
  EXPECT_EQ(draw_svg(picture), plain);
  unsetenv("LC_ALL");
  unsetenv("LC_NUMERIC");
  unsetenv("GNUTERM");
}

TEST(Draw, AMissingGnuplotIsAComputationError) {
  try {
    draw_svg(picture_with(three_points()), "no-such-gnuplot");
    FAIL() << "drew without gnuplot";
  } catch (const ComputationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no-such-gnuplot"));
    EXPECT_THAT(error.what(), HasSubstr("gnuplot-nox"));
  }
}

TEST(Draw, WhatGnuplotComplainsOfIsSaidInOneLine) {
  try {
    run_gnuplot("plot $nothing\n");
    FAIL() << "drew nonsense";
  } catch (const ComputationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no datablock named $nothing"));
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
  }
}

TEST(Draw, AProgramThatDrawsNothingIsAnError) {
  EXPECT_THROW(draw_svg(picture_with(three_points()), "true"), ComputationError);
  EXPECT_THROW(draw_svg(picture_with(three_points()), "false"), ComputationError);
}

TEST(Draw, HostileNamesAreText) {
  for (const std::string& name : support::hostile_names()) {
    if (name.find_first_of("\xff\xc3") != std::string::npos)
      continue;  // refused where text is read
    Picture picture = picture_with(three_points());
    picture.title = picture.plots.front().heading = name;
    picture.plots.front().x = {name, name};
    picture.plots.front().x.set_range({0.0, 4.0});
    const std::string svg = draw_svg(picture);
    for_each(parse_xml(svg), [](const XmlNode& node) {
      EXPECT_TRUE(node.name != "script" && node.name != "img" && node.name != "a") << node.name;
    });
  }
  EXPECT_FALSE(std::filesystem::exists("PWNED"));
}

TEST(Draw, OneThatHangsIsStopped) {
  EXPECT_THROW(run_gnuplot("pause 1000\n", "gnuplot", std::chrono::milliseconds(200)),
               ComputationError);
}

TEST(Draw, TextIsNeverMarkupNorACommand) {
  const std::filesystem::path witness =
      std::filesystem::temp_directory_path() / "recoil-gnuplot-witness";
  std::filesystem::remove(witness);
  const std::string hostile = "it's `touch " + witness.string() +
                              "` $(touch x) a_b^{c} @d &{e} ~f \\n \"g\" <script>\n plot x";
  Points points = three_points();
  points.name = hostile;
  Picture picture = picture_with(points);
  Plot& plot = picture.plots.front();
  plot.layers.push_back(Words{hostile, on_axis(1.0), share_of_plot(0.5)});
  plot.heading = plot.remark = plot.x.label = plot.y.label = hostile;
  plot.x.ticks = {{1.0, hostile}, {2.0, hostile, true}};
  plot.key.place = KeyPlace::below;
  const std::string svg = draw_svg(picture);
  EXPECT_FALSE(std::filesystem::exists(witness));
  EXPECT_THAT(svg, HasSubstr("a_b^{c} @d "));
  EXPECT_THAT(svg, HasSubstr("&lt;script"));
  EXPECT_THAT(svg, Not(HasSubstr("<script")));
}

TEST(Draw, LeavesNoFileBehind) {
  const auto files = [] {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::current_path())) {
      static_cast<void>(entry);
      ++count;
    }
    return count;
  };
  const std::size_t before = files();
  draw_svg(picture_with(three_points()));
  EXPECT_EQ(files(), before);
}

TEST(Draw, SymbolsOfTheModelHaveSubscripts) {
  EXPECT_EQ(gnuplot_text("bias of C_H and f0"), "'bias of C_{H} and f_{0}'");
  EXPECT_EQ(gnuplot_text("(e - e_model) / sd"), "'(e - e_{model}) / sd'");
  EXPECT_EQ(gnuplot_text("C_Hx xC_H C_H_1 f0.5x a_b"), "'C\\_Hx xC\\_H C\\_H\\_1 f_{0}.5x a\\_b'");
  EXPECT_EQ(gnuplot_text("quartz\nC_A"), "'quartz'.\"\\n\".'C_{A}'");
}

// Every kind of layer leaves its marks, in its colour.

TEST(DrawLayers, PointsWithErrorBars) {
  for (const Mark mark :
       {Mark::dot, Mark::circle, Mark::square, Mark::open_square, Mark::triangle,
        Mark::triangle_down, Mark::open_triangle_down, Mark::diamond, Mark::cross}) {
    Points points{{1.0, 2.0}, {1.0, 3.0}};
    points.with_sd({0.5, 0.5});
    points.marker = {"#112233", mark};
    const std::vector<XmlNode> found = painted(draw_svg(picture_with(points)), "#112233");
    const auto marks = std::count_if(found.begin(), found.end(),
                                     [](const XmlNode& node) { return node.name == "use"; });
    EXPECT_EQ(marks, 2) << static_cast<int>(mark);
    EXPECT_GT(found.size(), 2U) << "no error bars with mark " << static_cast<int>(mark);
  }
}

TEST(DrawLayers, ACloudIsOnePathWithEveryDotInItsPlace) {
  constexpr std::size_t count = 400;
  Points cloud;
  for (std::size_t i = 0; i < count; ++i) {
    cloud.x.push_back(2.0 + std::sin(7.0 * static_cast<double>(i)));
    cloud.y.push_back(2.0 + std::cos(3.0 * static_cast<double>(i)));
  }
  cloud.x[0] = 1.0;
  cloud.y[0] = 1.0;
  cloud.x[1] = 3.0;
  cloud.y[1] = 2.0;
  cloud.marker.colour = "#112233";
  Picture picture = picture_with(cloud);
  picture.plots.front().frame = Frame{40.0, 440.0, 40.0, 340.0};  // 100 px and 75 px per unit
  const std::vector<XmlNode> found = painted(draw_svg(picture), "#112233");
  ASSERT_EQ(found.size(), 1U) << "gnuplot's dots are not recognised";
  EXPECT_EQ(*found[0].attribute("stroke-linecap"), "round");
  const std::string& path = *found[0].attribute("d");
  EXPECT_LT(path.size(), count * 17) << "bytes per dot";
  double x[2] = {};
  double y[2] = {};
  ASSERT_EQ(std::sscanf(path.c_str(), "M%lf %lfh0M%lf %lfh0", &x[0], &y[0], &x[1], &y[1]), 4);
  EXPECT_NEAR(x[0], 140.0, 1.0);
  EXPECT_NEAR(x[1] - x[0], 200.0, 1.0);
  EXPECT_NEAR(y[0] - y[1], 75.0, 1.0) << "upwards";
}

std::size_t vertices(const std::string& svg, const std::string& colour) {
  std::size_t count = 0;
  for (const XmlNode& node : painted(svg, colour)) {
    if (const std::string* d = node.attribute("d")) {
      count += static_cast<std::size_t>(std::count(d->begin(), d->end(), ','));
    }
  }
  return count;
}

TEST(DrawLayers, ALevelLineNeedsNoPointsBetweenItsEndsAndASlopeKeepsThem) {
  Line level{{}, {}, {"#112233", 1.0}};
  Line slope{{}, {}, {"#445566", 1.0}};
  Line step{{}, {}, {"#778899", 1.0}};
  for (int i = 0; i <= 40; ++i) {
    const double x = 0.1 * i;
    for (Line* line : {&level, &slope, &step}) line->x.push_back(x);
    level.y.push_back(3.0);
    slope.y.push_back(x);
    step.y.push_back(x < 2.0 ? 1.0 : 2.0);
  }
  Picture picture = picture_with(level);
  picture.plots.front().layers.insert(picture.plots.front().layers.end(), {slope, step});
  const std::string svg = draw_svg(picture);
  EXPECT_EQ(vertices(svg, "#112233"), 2U);
  EXPECT_EQ(vertices(svg, "#445566"), 41U);
  EXPECT_EQ(vertices(svg, "#778899"), 4U) << "its corners";
}

TEST(DrawLayers, ALineThatComesBackKeepsItsTurningPoint) {
  EXPECT_EQ(
      vertices(draw_svg(picture_with(Line{{1, 3, 2}, {2, 2, 2}, {"#112233", 1.0}})), "#112233"),
      3U);
}

TEST(DrawLayers, ALineIsInterruptedWhereItHasNoValue) {
  const std::string svg =
      draw_svg(picture_with(Line{{0, 1, 2, 3, 4}, {1, 2, NAN, 2, 1}, {"#112233", 1.0}}));
  const std::vector<XmlNode> found = painted(svg, "#112233");
  ASSERT_EQ(found.size(), 1U);
  const std::string& path = *found[0].attribute("d");
  EXPECT_EQ(std::count(path.begin(), path.end(), 'M'), 2);
}

TEST(DrawLayers, EveryOtherKind) {
  Boxes boxes;
  boxes.add(0.5, 1.5, 0.0, 3.0);
  boxes.add(1.5, 2.5, 0.0, 2.0);
  boxes.fill = {"#112233", 1.0};
  EXPECT_EQ(painted(draw_svg(picture_with(boxes)), "#112233").size(), 2U);
  boxes.colours = {"#010203", "#aabbcc"};
  const std::string coloured = draw_svg(picture_with(boxes));
  EXPECT_EQ(painted(coloured, "#010203").size(), 1U);
  EXPECT_EQ(painted(coloured, "#aabbcc").size(), 1U);

  EXPECT_FALSE(
      painted(draw_svg(picture_with(Band{{0, 2, 4}, {1, 1, 2}, {2, 3, 3}, {"#112233", 0.2}})),
              "#112233")
          .empty());
  EXPECT_FALSE(
      painted(draw_svg(picture_with(Spans{{1, 2}, {1, 2}, {2, 3}, {"#112233", 2.5}})), "#112233")
          .empty());
  EXPECT_FALSE(
      painted(draw_svg(picture_with(Region{1.0, 2.0, {}, {}, {"#112233", 0.2}})), "#112233")
          .empty());
  for (const Direction direction : {Direction::vertical, Direction::horizontal}) {
    EXPECT_EQ(vertices(draw_svg(picture_with(Rule{direction, 2.0, {"#112233", 1.0}})), "#112233"),
              2U);
  }
  EXPECT_GT(vertices(draw_svg(picture_with(hill())), "#112233"), 20U);
  const Words words{"said here", on_axis(1.0), share_of_plot(0.5)};
  EXPECT_THAT(draw_svg(picture_with(words)), HasSubstr(">said here<"));
}

TEST(DrawLayers, ColoursTellValues) {
  Picture picture = picture_with(Discs{{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}, {-1.0, 0.0, 1.0}});
  picture.plots.front().colours =
      ColourScale{"how far", {-1.0, 1.0}, {{-1.0, "#0000ff"}, {0.0, "#eeeeee"}, {1.0, "#ff0000"}}};
  const std::string svg = draw_svg(picture);
  EXPECT_FALSE(painted(svg, "#0000ff").empty());
  EXPECT_FALSE(painted(svg, "#ff0000").empty());
  EXPECT_THAT(svg, HasSubstr("how far"));
}

TEST(DrawLayers, TheKeyNamesEveryLayerOnce) {
  Points points = three_points();
  points.name = "measured";
  Rule rule;
  rule.at = 1.0;
  rule.name = "estimate";
  Picture picture = picture_with(points);
  picture.plots.front().layers.push_back(rule);
  picture.plots.front().key.place = KeyPlace::above;
  const auto count = [](const std::string& text, const std::string& word) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at) ++found;
    return found;
  };
  std::string svg = draw_svg(picture);
  EXPECT_EQ(count(svg, ">measured<"), 1U);
  EXPECT_EQ(count(svg, ">estimate<"), 1U);
  // Two plots with the same names share one key.
  picture.plots.front().key.place = KeyPlace::none;
  picture.plots.push_back(picture.plots.front());
  picture.plots[0].frame = Frame{50.0, 200.0, 50.0, 300.0};
  picture.plots[1].frame = Frame{260.0, 460.0, 50.0, 300.0};
  picture.key.place = KeyPlace::above;
  svg = draw_svg(picture);
  EXPECT_EQ(count(svg, ">measured<"), 1U);
  EXPECT_EQ(count(svg, ">estimate<"), 1U);
}

}  // namespace
}  // namespace recoil::plot
