#include "report/svg_plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "core/error.hpp"

namespace recoil {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

PlotScript line() {
  PlotScript script;
  script.name = "line";
  script.title = "A <line> & more";
  script.commands = data_block("d", {{1.0, 2.0}, {2.0, NAN}, {3.0, 4.0}}) +
                    "plot $d using 1:2 with points pt 7 notitle\n";
  return script;
}

TEST(SvgPlot, IsReadyToInline) {
  const std::string svg = draw_svg(line());
  EXPECT_THAT(svg, StartsWith("<svg id=\"line\" viewBox=\"0 0 480 340\""));
  EXPECT_THAT(svg, HasSubstr("role=\"img\" aria-label=\"A &lt;line&gt; &amp; more\""));
  EXPECT_THAT(svg, HasSubstr("</svg>"));
  EXPECT_THAT(svg, Not(HasSubstr("<?xml")));
  EXPECT_THAT(svg, Not(HasSubstr("<!DOCTYPE")));
  EXPECT_THAT(svg, Not(HasSubstr("'gp"))) << "an id without the figure's name";
  EXPECT_THAT(svg, HasSubstr("href='#line-gpPt6'"));
  EXPECT_THAT(svg, HasSubstr("id='line-gpPt6'"));
}

TEST(SvgPlot, IsTheSameTwice) { EXPECT_EQ(draw_svg(line()), draw_svg(line())); }

TEST(SvgPlot, DoesNotDependOnTheLocaleOrTheUsersSettings) {
  const std::string plain = draw_svg(line());
  setenv("LC_ALL", "de_DE.UTF-8", 1);
  setenv("LC_NUMERIC", "de_DE.UTF-8", 1);
  setenv("GNUTERM", "nonsense", 1);
  EXPECT_EQ(draw_svg(line()), plain);
  unsetenv("LC_ALL");
  unsetenv("LC_NUMERIC");
  unsetenv("GNUTERM");
}

TEST(SvgPlot, AMissingGnuplotIsAComputationError) {
  try {
    draw_svg(line(), "no-such-gnuplot");
    FAIL() << "drew without gnuplot";
  } catch (const ComputationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("gnuplot cannot be started"));
    EXPECT_THAT(error.what(), HasSubstr("gnuplot-nox"));
  }
}

TEST(SvgPlot, AMistakeInTheScriptIsAComputationErrorWithGnuplotsWords) {
  PlotScript script = line();
  script.commands = "plot $nothing\n";
  try {
    draw_svg(script);
    FAIL() << "drew nonsense";
  } catch (const ComputationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no datablock named $nothing"));
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
  }
}

TEST(SvgPlot, AProgramThatDrawsNothingIsAnError) {
  EXPECT_THROW(draw_svg(line(), "true"), ComputationError);
  EXPECT_THROW(draw_svg(line(), "false"), ComputationError);
}

TEST(SvgPlot, TextIsNeverMarkupNorACommand) {
  const std::filesystem::path witness =
      std::filesystem::temp_directory_path() / "recoil-gnuplot-witness";
  std::filesystem::remove(witness);
  const std::string hostile = "it's `touch " + witness.string() +
                              "` $(touch x) a_b^{c} @d &{e} ~f \\n \"g\" <script>\n plot x";
  PlotScript script = line();
  script.commands = "set title " + gnuplot_text(hostile) + "\n" + script.commands;
  const std::string svg = draw_svg(script);
  EXPECT_FALSE(std::filesystem::exists(witness));
  EXPECT_THAT(svg, HasSubstr("a_b^{c} @d "));
  EXPECT_THAT(svg, HasSubstr("&lt;script"));
  EXPECT_THAT(svg, Not(HasSubstr("<script")));
}

TEST(SvgPlot, LeavesNoFileBehind) {
  const auto files = [] {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::current_path())) {
      static_cast<void>(entry);
      ++count;
    }
    return count;
  };
  const std::size_t before = files();
  draw_svg(line());
  EXPECT_EQ(files(), before);
}

/// The points of the path with this colour.
std::vector<std::string> path_of(const std::string& svg, const std::string& colour) {
  const std::size_t stroke = svg.find("<path stroke='" + colour + "'");
  if (stroke == std::string::npos) return {};
  const std::size_t begin = svg.find(" d='", stroke) + 4;
  std::istringstream words(svg.substr(begin, svg.find('\'', begin) - begin));
  return {std::istream_iterator<std::string>(words), {}};
}

TEST(SvgPlot, ALevelLineNeedsNoPointsBetweenItsEndsAndASlopeKeepsThem) {
  PlotScript script = line();
  script.commands =
      "set xrange [0:4]\nset yrange [0:4]\nset samples 41\nunset key\n"
      "plot 3 lc rgb '#112233', x lc rgb '#445566', (x < 2 ? 1 : 2) lc rgb '#778899'\n";
  const std::string svg = draw_svg(script);
  EXPECT_EQ(path_of(svg, "#112233").size(), 2U);
  EXPECT_EQ(path_of(svg, "#445566").size(), 41U);
  const std::vector<std::string> step = path_of(svg, "#778899");
  ASSERT_EQ(step.size(), 4U) << "its corners";
  for (const std::string& point : step) EXPECT_THAT(point, Not(StartsWith("L")));
  EXPECT_THAT(step.front(), StartsWith("M"));
  const auto height = [&](std::size_t i) { return step[i].substr(step[i].find(',')); };
  EXPECT_EQ(height(0), height(1));
  EXPECT_EQ(height(2), height(3));
  EXPECT_NE(height(1), height(2));
}

TEST(SvgPlot, ALineThatComesBackKeepsItsTurningPoint) {
  PlotScript script = line();
  script.commands = "set xrange [0:4]\nset yrange [0:4]\n" +
                    data_block("d", {{1, 2}, {3, 2}, {2, 2}}) +
                    "plot $d using 1:2 with lines lc rgb '#112233' notitle\n";
  EXPECT_EQ(path_of(draw_svg(script), "#112233").size(), 3U);
}

TEST(SvgPlot, NamesAreFitForIds) {
  EXPECT_EQ(plot_name("overview-wall 1990/a_b"), "overview-wall-1990-a-b");
  EXPECT_EQ(plot_name("1990"), "f-1990");
  EXPECT_EQ(plot_name("'><"), "f-");
}

TEST(SvgPlot, LogarithmicTicksLieInTheRange) {
  EXPECT_EQ(log_ticks('x', 0.9, 12.0), "set xtics ('1' 1, '2' 2, '5' 5, '10' 10)\n");
  EXPECT_EQ(log_ticks('y', 0.1, 1000.0),
            "set ytics ('0.1' 0.1, '1' 1, '10' 10, '100' 100, '1000' 1000)\n");
}

}  // namespace
}  // namespace recoil
