// Opens pages in headless Chromium. Each check is shown to fail on a page that is broken on
// purpose.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

#include "document/html.hpp"
#include "example_analysis.hpp"
#include "plot/draw.hpp"
#include "report/fit_report.hpp"
#include "report/index_page.hpp"
#include "report/result_json.hpp"
#include "support/command.hpp"
#include "support/temporary_folder.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

class Browser : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    page_ = fit_html(sample::four_diameters());
    const Analysis analysis = sample::four_diameters();
    IndexEntry entry{"page.html", fit_json(analysis)};
    entry.picture = plot::draw_svg(thumbnail(analysis));
    index_ = html_page(index_document({entry}));
  }

  /// Names and HTML of pages.
  using Pages = std::vector<std::pair<std::string, std::string>>;

  /// The complaints of one Chromium about each page, one per line; empty without any.
  std::map<std::string, std::string> complaints(const Pages& pages, int figures,
                                                const std::vector<std::string>& options = {}) {
    std::vector<std::string> words = {"python3",
                                      RECOIL_SOURCE_DIR "/tests/report/open_in_chromium.py",
                                      "--figures", std::to_string(figures)};
    words.insert(words.end(), options.begin(), options.end());
    for (const auto& [name, html] : pages) {
      folder_.write(name + ".html", html);
      words.push_back((folder_ / (name + ".html")).string());
    }
    const support::Outcome outcome = support::run_command(words, folder_.path());
    std::map<std::string, std::string> said;
    for (const auto& [name, html] : pages) {
      const std::string place = (folder_ / (name + ".html")).string() + ": ";
      bool judged = false;
      std::istringstream lines(outcome.out);
      for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with(place)) continue;
        line.erase(0, place.size());
        judged = line.starts_with("ok, ") || line.starts_with("FAILED, ");
        if (!judged) said[name] += line + "\n";
      }
      EXPECT_TRUE(judged) << name << ": " << outcome.out << outcome.err;
      said[name];
    }
    const bool any =
        std::any_of(said.begin(), said.end(), [](const auto& one) { return !one.second.empty(); });
    EXPECT_EQ(outcome.status, any ? 1 : 0) << outcome.err;
    return said;
  }

  static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << "the page has no " << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
  }

  static inline std::string page_;
  static inline std::string index_;
  support::TemporaryFolder folder_;
};

TEST_F(Browser, ShowsAllFigures) {
  const auto said = complaints({{"joint", fit_html(sample::two_datasets())}, {"page", page_}}, 11);
  EXPECT_EQ(said.at("joint"), "");
  EXPECT_EQ(said.at("page"),
            "desktop: 6 drawn figures, at least 11 expected\n"
            "phone: 6 drawn figures, at least 11 expected\n"
            "print: 6 drawn figures, at least 11 expected\n");
}

/// A page whose list of contents takes several lines.
std::string page_of_many_sections() {
  Document document{.title = "Many sections", .heading = "Many sections"};
  for (int k = 1; k <= 15; ++k) {
    const std::string title = "Table " + std::to_string(k) + ": constants";
    document.sections.push_back(
        {.id = "table-" + std::to_string(k), .title = title, .blocks = {Paragraph{"None."}}});
  }
  return html_page(document);
}

TEST_F(Browser, ShowsNothingThatAxeFinds) {
  const fs::path axe = fs::path(RECOIL_SOURCE_DIR) / "build" / "axe" / "axe.min.js";
  if (!fs::exists(axe)) GTEST_SKIP() << "./run test could not fetch axe-core: no network";
  const auto said = complaints({{"page", page_},
                                {"index", index_},
                                {"contents", page_of_many_sections()},
                                {"broken", replaced(page_, "</main>", "<button></button></main>")}},
                               0, {"--axe", axe.string()});
  EXPECT_EQ(said.at("page"), "");
  EXPECT_EQ(said.at("index"), "");
  EXPECT_EQ(said.at("contents"), "");
  EXPECT_NE(said.at("broken").find("axe button-name"), std::string::npos) << said.at("broken");
}

TEST_F(Browser, ShowsThePageWithoutScript) {
  const auto said = complaints(
      {{"page", page_}, {"broken", replaced(page_, "</main>", "<p class='save'>Save</p></main>")}},
      6, {"--without-script"});
  EXPECT_EQ(said.at("page"), "");
  EXPECT_NE(said.at("broken").find("1 things that only a script makes"), std::string::npos)
      << said.at("broken");
}

TEST_F(Browser, ComplainsOfWhatAReaderWouldSeeGoWrong) {
  std::string no_plot = page_;
  const auto svg = no_plot.find("<svg ");
  no_plot.erase(svg, no_plot.find("</svg>") + 6 - svg);
  std::string empty_plot = page_;
  const auto plot = empty_plot.find("<g id=\"restitution-1_plot_1\"");
  ASSERT_NE(plot, std::string::npos);
  empty_plot.erase(plot, empty_plot.find("</svg>", plot) - plot);
  const auto body = [](const std::string& more) {
    return replaced(page_, "</body>", more + "</body>");
  };
  const auto main = [](const std::string& more) {
    return replaced(page_, "</main>", more + "</main>");
  };
  const auto style = [](const std::string& html, const std::string& more) {
    return replaced(html, "</style>", more + "</style>");
  };
  struct Broken {
    std::string name, html, complaint;
  };
  const std::vector<Broken> all = {
      {"console-error", body("<script>console.error('x')</script>"), "desktop: console error: x"},
      {"exception", body("<script>undefined.x()</script>"), "desktop: exception: TypeError"},
      {"missing-plot", no_plot, "no SVG"},
      {"empty-plot", empty_plot, "nothing is plotted in it"},
      {"invisible-plot", style(page_, ".picture svg { display: none }"), "has no visible box"},
      {"network", body("<img alt='' src='http://127.0.0.1:9/missing.png'>"),
       "http://127.0.0.1:9/missing.png"},
      {"wide", main("<div style='width:2000px'>.</div>"), "desktop: the page scrolls sideways"},
      {"wide-for-a-phone", main("<div style='width:600px'>.</div>"),
       "phone: the page scrolls sideways"},
      {"printed-link", style(page_, ".save { display: block !important }"), "print: prints "},
      {"broken-picture", style(page_, "figure { break-inside: auto !important }"),
       "print: a page may end within FIGURE"},
      {"lost-link", style(index_, "a::after { content: none !important }"),
       "print: does not print where "}};
  Pages pages = {{"page", page_}, {"index", index_}};
  for (const Broken& one : all) pages.emplace_back(one.name, one.html);
  const auto said = complaints(pages, 1);
  EXPECT_EQ(said.at("page"), "");
  EXPECT_EQ(said.at("index"), "");
  for (const Broken& one : all) {
    EXPECT_NE(said.at(one.name).find(one.complaint), std::string::npos)
        << one.name << ": " << said.at(one.name);
  }
}

}  // namespace
}  // namespace recoil
