// Pictures as SVG: every kind of layer, any text, the same bytes every time.
#include "plot/draw.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <pugixml.hpp>
#include <set>

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

/// The document, which has to be well-formed.
pugi::xml_document parsed(const std::string& svg) {
  pugi::xml_document document;
  const pugi::xml_parse_result result =
      document.load_string(svg.c_str(), pugi::parse_full | pugi::parse_ws_pcdata);
  EXPECT_TRUE(result) << result.description();
  return document;
}

void for_each(const pugi::xml_node& node, const std::function<void(const pugi::xml_node&)>& act) {
  act(node);
  for (const pugi::xml_node& child : node.children()) for_each(child, act);
}

struct Painted {
  std::string name, path;
  std::string linecap;
};

/// The shapes, without their texts, that this colour paints.
std::vector<Painted> painted(const std::string& svg, const std::string& colour) {
  std::vector<Painted> found;
  for_each(parsed(svg), [&](const pugi::xml_node& node) {
    for (const char* key : {"stroke", "fill"}) {
      if (node.attribute(key).value() != colour) continue;
      found.push_back(
          {node.name(), node.attribute("d").value(), node.attribute("stroke-linecap").value()});
      return;
    }
  });
  return found;
}

TEST(Draw, IsReadyToInline) {
  const std::string svg = draw_svg(picture_with(three_points()));
  EXPECT_THAT(svg, StartsWith("<svg id=\"one\" viewBox=\"0 0 480 340\""));
  const pugi::xml_document document = parsed(svg);
  const pugi::xml_node root = document.document_element();
  EXPECT_STREQ(root.attribute("role").value(), "img");
  EXPECT_STREQ(root.attribute("aria-label").value(), "A <picture> & more");
}

TEST(Draw, ForPrintHasItsSizeInMillimetres) {
  const pugi::xml_document document = parsed(draw_svg(picture_with(three_points()), 96.0));
  EXPECT_STREQ(document.document_element().attribute("width").value(), "96mm");
  EXPECT_STREQ(document.document_element().attribute("height").value(), "68mm");
}

TEST(Draw, EveryIdBeginsWithTheNameAndEveryReferenceHasItsTarget) {
  Picture picture = picture_with(three_points());
  picture.plots.push_back(plot_with(Discs{{1.0}, {2.0}, {0.5}}));
  picture.plots[1].colours = ColourScale{"", {}, {{0.0, "#0000ff"}, {1.0, "#ff0000"}}};
  picture.plots[1].layers.push_back(Line{{1.0, 2.0}, {1.0, 2.0}});
  picture.plots[0].frame = Frame{50.0, 200.0, 50.0, 300.0};
  picture.plots[1].frame = Frame{260.0, 400.0, 50.0, 300.0};
  std::multiset<std::string> ids;
  std::set<std::string> targets;
  for_each(parsed(draw_svg(picture)), [&](const pugi::xml_node& node) {
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      const std::string value = attribute.value();
      if (std::string(attribute.name()) == "id") ids.insert(value);
      if (value.starts_with("url(#")) targets.insert(value.substr(5, value.size() - 6));
    }
  });
  for (const std::string& id : ids) {
    EXPECT_THAT(id, StartsWith("one"));
    EXPECT_EQ(ids.count(id), 1U) << id;
  }
  EXPECT_GE(targets.size(), 2U);
  for (const std::string& target : targets) EXPECT_TRUE(ids.contains(target)) << target;
}

TEST(Draw, DoesNotDependOnTheLocale) {
  const Picture picture = picture_with(three_points());
  const std::string plain = draw_svg(picture);
  EXPECT_EQ(draw_svg(picture), plain);
  for (const char* locale : {"de_DE.UTF-8", "C.UTF-8"}) {
    setlocale(LC_ALL, locale);
    EXPECT_EQ(draw_svg(picture), plain) << locale;
  }
  setlocale(LC_ALL, "C");
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
    for_each(parsed(svg), [](const pugi::xml_node& node) {
      const std::string element = node.name();
      EXPECT_TRUE(element != "script" && element != "img" && element != "a") << element;
    });
  }
}

TEST(Draw, TextIsNeverMarkup) {
  const std::string hostile = "it's &amp; a_b^{c} \n \"g\" <script>\n plot x";
  Points points = three_points();
  points.name = hostile;
  Picture picture = picture_with(points);
  Plot& plot = picture.plots.front();
  plot.layers.push_back(Words{hostile, on_axis(1.0), share_of_plot(0.5)});
  plot.heading = plot.remark = plot.x.label = plot.y.label = hostile;
  plot.x.ticks = {{1.0, hostile}, {2.0, hostile}};
  plot.key = KeyPlace::below;
  const std::string svg = draw_svg(picture);
  EXPECT_THAT(svg, HasSubstr("it&#39;s &amp;amp; a_b^{c} "));
  EXPECT_THAT(svg, HasSubstr("&lt;script"));
  EXPECT_THAT(svg, Not(HasSubstr("<script")));
  parsed(svg);
}

/// The text in `label` and its subscripts.
std::pair<std::string, std::string> set_text(const std::string& label) {
  Picture picture = picture_with(three_points());
  picture.plots.front().heading = label;
  std::pair<std::string, std::string> found;
  const pugi::xml_document document = parsed(draw_svg(picture));
  double shift = 0.0;
  for_each(document, [&](const pugi::xml_node& node) {
    if (std::string(node.name()) != "text" || node.attribute("font-size").as_double() != 14.0)
      return;
    for (const pugi::xml_node& part : node.children()) {
      shift += part.attribute("dy").as_double();
      const std::string words = part.child_value()[0] != 0 ? part.child_value() : part.value();
      found.first += words;
      if (shift > 0.0) found.second += words;
    }
    EXPECT_NEAR(shift, label.back() == 'H' || label.back() == '0' ? 0.25 : 0.0, 1e-12);
  });
  return found;
}

TEST(Draw, SymbolsOfTheModelHaveSubscripts) {
  using Text = std::pair<std::string, std::string>;
  EXPECT_EQ(set_text("bias of C_H and f0"), Text("bias of CH and f0", "H0"));
  EXPECT_EQ(set_text("(e - e_model) / sd"), Text("(e - emodel) / sd", "model"));
  EXPECT_EQ(set_text("C_Hx xC_H C_H_1 f0.5x a_b"), Text("C_Hx xC_H C_H_1 f0.5x a_b", "0"));
  EXPECT_EQ(set_text("f0 C_H"), Text("f0 CH", "0H"));
}

// Every kind of layer leaves its marks, in its colour.

TEST(DrawLayers, PointsWithErrorBars) {
  for (const Mark mark :
       {Mark::dot, Mark::circle, Mark::square, Mark::open_square, Mark::triangle,
        Mark::triangle_down, Mark::open_triangle_down, Mark::diamond, Mark::cross}) {
    Points points{{1.0, 2.0}, {1.0, 3.0}};
    points.with_sd({0.5, 0.5});
    points.marker = {"#112233", mark};
    const std::vector<Painted> found = painted(draw_svg(picture_with(points)), "#112233");
    ASSERT_EQ(found.size(), 2U) << "bars and marks " << static_cast<int>(mark);
    const int strokes = mark == Mark::cross ? 2 : 1;
    EXPECT_EQ(std::count(found[0].path.begin(), found[0].path.end(), 'M'), 2);
    EXPECT_EQ(std::count(found[1].path.begin(), found[1].path.end(), 'M'), 2 * strokes);
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
  const std::vector<Painted> found = painted(draw_svg(picture), "#112233");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].linecap, "round");
  const std::string& path = found[0].path;
  EXPECT_LT(path.size(), count * 17) << "bytes per dot";
  double x[2] = {};
  double y[2] = {};
  ASSERT_EQ(std::sscanf(path.c_str(), "M%lf %lfh0M%lf %lfh0", &x[0], &y[0], &x[1], &y[1]), 4);
  EXPECT_NEAR(x[0], 140.0, 0.1);
  EXPECT_NEAR(x[1] - x[0], 200.0, 0.1);
  EXPECT_NEAR(y[0] - y[1], 75.0, 0.1) << "upwards";
}

TEST(DrawLayers, ALineIsInterruptedWhereItHasNoValue) {
  const std::string svg =
      draw_svg(picture_with(Line{{0, 1, 2, 3, 4}, {1, 2, NAN, 2, 1}, {"#112233", 1.0}}));
  const std::vector<Painted> found = painted(svg, "#112233");
  ASSERT_EQ(found.size(), 1U);
  const std::string& path = found[0].path;
  EXPECT_EQ(std::count(path.begin(), path.end(), 'M'), 2);
}

TEST(DrawLayers, EveryOtherKind) {
  Boxes boxes;
  boxes.add(0.5, 1.5, 0.0, 3.0);
  boxes.add(1.5, 2.5, 0.0, 2.0);
  boxes.fill = {"#112233", 1.0};
  const std::vector<Painted> plain = painted(draw_svg(picture_with(boxes)), "#112233");
  ASSERT_EQ(plain.size(), 1U);
  EXPECT_EQ(std::count(plain[0].path.begin(), plain[0].path.end(), 'M'), 2);
  boxes.colours = {"#010203", "#aabbcc"};
  const std::string coloured = draw_svg(picture_with(boxes));
  EXPECT_EQ(painted(coloured, "#010203").size(), 1U);
  EXPECT_EQ(painted(coloured, "#aabbcc").size(), 1U);

  Band band{{0, 1, 2, 3, 4}, {1, 1, NAN, 1, 1}, {2, 3, 3, 3, 3}, {"#112233", 0.2}};
  const std::vector<Painted> parts = painted(draw_svg(picture_with(band)), "#112233");
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(std::count(parts[0].path.begin(), parts[0].path.end(), 'z'), 2) << "interrupted";
  // 100 and 75 px per unit; the plot begins 40 px from the left and ends 40 px above the foot.
  Picture framed = picture_with(Region{1.0, 2.0, {}, {}, {"#112233", 0.2}});
  framed.plots.front().frame = Frame{40.0, 440.0, 40.0, 340.0};
  ASSERT_EQ(painted(draw_svg(framed), "#112233").size(), 1U);
  EXPECT_EQ(painted(draw_svg(framed), "#112233")[0].path, "M140 0H240V300H140z");
  framed.plots.front().layers = {Rule{.at = 2.0, .stroke = {"#112233", 1.0}},
                                 Rule{.vertical = false, .at = 1.0, .stroke = {"#445566", 1.0}}};
  EXPECT_EQ(painted(draw_svg(framed), "#112233")[0].path, "M240 300V0");
  EXPECT_EQ(painted(draw_svg(framed), "#445566")[0].path, "M40 225H440");
  // A logarithmic axis: the middle of 1 and 100 is 10.
  framed.plots.front().x.logarithmic = true;
  framed.plots.front().x.set_range({1.0, 100.0});
  framed.plots.front().layers = {Rule{.at = 10.0, .stroke = {"#112233", 1.0}}};
  EXPECT_EQ(painted(draw_svg(framed), "#112233")[0].path, "M240 300V0");
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
  EXPECT_FALSE(painted(svg, "#eeeeee").empty());
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
  picture.plots.front().key = KeyPlace::above;
  const auto count = [](const std::string& text, const std::string& word) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at) ++found;
    return found;
  };
  picture.plots.front().layers.push_back(rule);
  const std::string svg = draw_svg(picture);
  EXPECT_EQ(count(svg, ">measured<"), 1U);
  EXPECT_EQ(count(svg, ">estimate<"), 1U) << "two layers of one name";
}

}  // namespace
}  // namespace recoil::plot
