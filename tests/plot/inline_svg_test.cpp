// SVG made fit for a page: by what it means, whatever program wrote it.
#include "plot/inline_svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <map>

#include "core/error.hpp"
#include "plot/draw.hpp"
#include "plot/gnuplot_script.hpp"
#include "plot/xml.hpp"

namespace recoil::plot {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string inlined(const std::string& inside) {
  const Picture picture{"p", "t", 100, 100, {}};
  return inline_svg("<?xml version=\"1.0\"?>\n<!DOCTYPE svg>\n<svg>" + inside + "</svg>", picture);
}

TEST(Xml, ReadsAndWrites) {
  const XmlNode root = parse_xml(
      "<?xml version='1.0'?>\n<!-- a --><a x = 'it' y=\"&lt;\">\n\t<b/>words <c> </c><!-- d "
      "--></a>");
  EXPECT_EQ(root.name, "a");
  EXPECT_EQ(*root.attribute("x"), "it");
  EXPECT_EQ(*root.attribute("y"), "&lt;");
  ASSERT_EQ(root.children.size(), 3U);
  EXPECT_EQ(root.children[1].text, "words ");
  EXPECT_EQ(root.children[2].children.at(0).text, " ");
  EXPECT_EQ(write_xml(parse_xml(write_xml(root))), write_xml(root));
}

TEST(Xml, RefusesWhatIsNotWellFormed) {
  for (const char* broken :
       {"", "words", "<a>", "<a></b>", "<a x></a>", "<a x=1/>", "<a x='1/>", "<a><b></a>", "<a"}) {
    EXPECT_THROW(parse_xml(broken), ComputationError) << broken;
  }
}

TEST(InlineSvg, WhatIsInheritedIsNotSaidAgain) {
  const std::string svg = inlined(
      "<g stroke='red' stroke-width='2.00'><g stroke='red' stroke-width='2.00'>"
      "<path d='M1,1 L2,2'/><path stroke='blue' d='M3,3 L4,4'/></g></g>");
  EXPECT_THAT(svg, HasSubstr("stroke=\"blue\""));
  EXPECT_EQ(svg.find("stroke=\"red\""), svg.rfind("stroke=\"red\"")) << "said once";
}

TEST(InlineSvg, ReadsNumbersInAnyLocale) {
  const std::string inside =
      "<g stroke='rgb( 34,  34,  34)' stroke-width='1.50'><path d='M1.26,2.04 L-0.01,3'/></g>";
  const std::string expected = inlined(inside);
  EXPECT_THAT(expected, HasSubstr("#222222"));
  EXPECT_THAT(expected, HasSubstr("M1.3,2 0,3"));
  EXPECT_THAT(expected, HasSubstr("stroke-width=\"1.5\""));
  // where de_DE is installed its decimal comma must change nothing
  for (const char* name : {"C", "de_DE.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) == nullptr) continue;
    EXPECT_EQ(inlined(inside), expected) << name;
  }
  std::setlocale(LC_ALL, "C");
}

TEST(InlineSvg, AShapeWithoutColoursStaysBlackAndWithoutARim) {
  const std::string svg = inlined("<rect x='0'/><g fill='none' stroke='red'><rect x='1'/></g>");
  const XmlNode root = parse_xml(svg);
  std::map<std::string, const XmlNode*> rects;
  for (const XmlNode& child : root.children) {
    if (child.name == "rect") rects[*child.attribute("x")] = &child;
  }
  ASSERT_TRUE(rects.contains("0"));
  EXPECT_EQ(*rects["0"]->attribute("fill"), "black");
  EXPECT_EQ(*rects["0"]->attribute("stroke"), "none");
  ASSERT_TRUE(rects.contains("1")) << "a group around one element dissolves";
  EXPECT_EQ(*rects["1"]->attribute("stroke"), "red");
}

TEST(InlineSvg, NumbersHaveATenthOfAPixel) {
  EXPECT_THAT(inlined("<g stroke='red'><path d='M76.00,198.18 L77.26,-0.04 Z M1,1 L2.5,3 '/></g>"),
              HasSubstr("d=\"M76,198.2 77.3,0ZM1,1 2.5,3\""));
  EXPECT_THAT(inlined("<polygon fill = 'rgb(  0, 114, 178)' points = '104.81,232.55 1.00,2.00 '/>"),
              HasSubstr("fill=\"#0072b2\" points=\"104.8,232.6 1,2\""));
}

TEST(InlineSvg, OnlyUsedDefinitionsStay) {
  const std::string svg = inlined(
      "<defs><circle id='a' r='1'/><use xlink:href='#a' id='b'/><path id='c' d='M0,0'/>"
      "<filter id='f'><feFlood/></filter></defs><use xlink:href='#b' transform='translate(1,1)'/>");
  EXPECT_THAT(svg, HasSubstr("id=\"p-a\""));
  EXPECT_THAT(svg, HasSubstr("id=\"p-b\""));
  EXPECT_THAT(svg, Not(HasSubstr("id=\"p-c\"")));
  EXPECT_THAT(svg, Not(HasSubstr("filter")));
}

TEST(InlineSvg, WhatPointsNowhereIsNoDot) {
  std::string dots;
  for (const char* place : {"1,1", "2,1", "3,1"}) {
    dots += std::string("<use xlink:href='#b' transform='translate(") + place + ") scale(2)'/>";
  }
  const std::string round = "<circle id='a' r='1'/>";
  const std::string pointer = "<use xlink:href='#a' id='b' fill='currentColor'/>";
  EXPECT_THAT(inlined("<defs>" + round + pointer + "</defs>" + dots), HasSubstr("stroke-linecap"));
  EXPECT_THAT(inlined("<defs>" + pointer + "</defs>" + dots), Not(HasSubstr("stroke-linecap")));
}

TEST(InlineSvg, ColoursAreNoReferences) {
  const std::string svg =
      inlined("<defs><path id='abc' d='M0,0'/></defs><rect fill='#abc' stroke='#0072B2'/>");
  EXPECT_THAT(svg, HasSubstr("fill=\"#abc\""));
  EXPECT_THAT(svg, HasSubstr("stroke=\"#0072B2\""));
}

TEST(InlineSvg, BlanksBetweenWordsStay) {
  EXPECT_THAT(inlined("<g stroke='none'><text><tspan>a</tspan><tspan dy='3'>b</tspan>"
                      "<tspan dy='-3'> </tspan><tspan>c</tspan></text></g>"),
              HasSubstr("a<tspan dy=\"3\">b</tspan><tspan dy=\"-3\"> </tspan>c"));
}

TEST(InlineSvg, UnknownElementsStayAsTheyAre) {
  EXPECT_THAT(inlined("<g stroke='red'><image href='x.png' new='1'/></g>"),
              HasSubstr("href=\"x.png\" new=\"1\""));
}

/// A newer gnuplot that writes other SVG has to be looked at: what follows is what the pages need
/// of it. The bounds are a fifth above what 5.4 gives.
TEST(InlineSvg, GnuplotsSvgBecomesSmall) {
  Plot plot;
  plot.x = {"velocity V", "m/s"};
  plot.x.set_range({0.0, 10.0});
  plot.y = {"C_H"};
  plot.y.set_range({-1.0, 1.0});
  Points cloud;
  Line line;
  for (int i = 0; i < 200; ++i) {
    cloud.x.push_back(0.05 * i);
    cloud.y.push_back(std::sin(7.0 * i));
    line.x.push_back(0.05 * i);
    line.y.push_back(std::sin(0.05 * i));
  }
  const Picture empty{"p", "t", 480, 340, {plot}};
  plot.layers = {cloud};
  const Picture dots{"p", "t", 480, 340, {plot}};
  plot.layers = {line};
  const Picture curve{"p", "t", 480, 340, {plot}};
  const std::size_t axes = draw_svg(empty).size();
  EXPECT_LT(axes, 5200U) << "axes with eighteen ticks";
  EXPECT_LT(draw_svg(dots).size() - axes, 200U * 17U);
  EXPECT_LT(draw_svg(curve).size() - axes, 200U * 13U);
  EXPECT_GT(run_gnuplot(gnuplot_script({&dots})).size(), 5 * draw_svg(dots).size())
      << "nothing gained: is the tidying still needed?";
}

}  // namespace
}  // namespace recoil::plot
