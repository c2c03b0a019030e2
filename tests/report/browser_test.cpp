// Opens pages in headless Chromium. Each check is shown to fail on a page that is broken on
// purpose.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

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

  /// 0 when Chromium is content with `html`.
  int open(const std::string& html, int figures, const std::vector<std::string>& options = {}) {
    const fs::path file = folder_ / "page.html";
    folder_.write("page.html", html);
    std::vector<std::string> words = {"python3",
                                      RECOIL_SOURCE_DIR "/tests/report/open_in_chromium.py",
                                      "--figures", std::to_string(figures), file.string()};
    words.insert(words.end(), options.begin(), options.end());
    const support::Outcome outcome = support::run_command(words, folder_.path());
    last_words_ = outcome.out + outcome.err;
    return outcome.status;
  }

  static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << "the page has no " << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
  }

  static inline std::string page_;
  static inline std::string index_;
  std::string last_words_;  // of the browser
  support::TemporaryFolder folder_;
};

TEST_F(Browser, ShowsThePage) { EXPECT_EQ(open(page_, 6), 0); }

TEST_F(Browser, ShowsNothingThatAxeFinds) {
  const fs::path axe = fs::path(RECOIL_SOURCE_DIR) / "build" / "axe" / "axe.min.js";
  if (!fs::exists(axe)) return;  // no network: `./run test` says so
  EXPECT_EQ(open(page_, 6, {"--axe", axe.string()}), 0) << last_words_;
  EXPECT_EQ(open(index_, 0, {"--axe", axe.string()}), 0) << last_words_;
  EXPECT_EQ(
      open(replaced(page_, "</main>", "<button></button></main>"), 6, {"--axe", axe.string()}), 1);
  EXPECT_NE(last_words_.find("axe button-name"), std::string::npos) << last_words_;
}

TEST_F(Browser, ShowsThePageWithoutScript) {
  EXPECT_EQ(open(page_, 6, {"--without-script"}), 0);
  EXPECT_EQ(
      open(replaced(page_, "</main>", "<p class='save'>Save</p></main>"), 6, {"--without-script"}),
      1)
      << "a page without its script must not show links that need it";
}

TEST_F(Browser, ShowsAJointPage) { EXPECT_EQ(open(fit_html(sample::two_datasets()), 11), 0); }

TEST_F(Browser, ShowsTheIndex) { EXPECT_EQ(open(index_, 1), 0); }

TEST_F(Browser, ComplainsOfAConsoleError) {
  EXPECT_EQ(open(replaced(page_, "</body>", "<script>console.error('x')</script></body>"), 1), 1);
}

TEST_F(Browser, ComplainsOfAnException) {
  EXPECT_EQ(open(replaced(page_, "</body>", "<script>undefined.x()</script></body>"), 1), 1);
}

TEST_F(Browser, ComplainsOfAMissingPlot) {
  std::string broken = page_;
  const auto begin = broken.find("<svg ");
  broken.erase(begin, broken.find("</svg>") + 6 - begin);
  EXPECT_EQ(open(broken, 1), 1);
  EXPECT_EQ(open(page_, 7), 1) << "fewer figures than asked for";
}

TEST_F(Browser, ComplainsOfAnEmptyPlot) {
  std::string broken = page_;
  const auto begin = broken.find("<g id=\"restitution-1_plot_1\"");
  ASSERT_NE(begin, std::string::npos);
  broken.erase(begin, broken.find("</svg>", begin) - begin);
  EXPECT_EQ(open(broken, 1), 1);
}

TEST_F(Browser, ComplainsOfAnInvisiblePlot) {
  EXPECT_EQ(open(replaced(page_, "</style>", ".picture svg { display: none }</style>"), 1), 1);
}

TEST_F(Browser, ComplainsOfTheNetwork) {
  EXPECT_EQ(
      open(replaced(page_, "</body>", "<img alt='' src='http://127.0.0.1:9/missing.png'></body>"),
           1),
      1);
}

TEST_F(Browser, ComplainsOfAPageThatScrollsSideways) {
  EXPECT_EQ(open(replaced(page_, "</main>", "<div style='width:2000px'>.</div></main>"), 1), 1);
  EXPECT_EQ(open(replaced(page_, "</main>", "<div style='width:600px'>.</div></main>"), 1), 1)
      << "too wide for a phone only";
}

TEST_F(Browser, ComplainsOfWhatDoesNotBelongOnPaper) {
  EXPECT_EQ(open(replaced(page_, "</style>", ".save { display: block !important }</style>"), 1), 1)
      << "links that save";
  EXPECT_EQ(
      open(replaced(page_, "</style>", "figure { break-inside: auto !important }</style>"), 1), 1)
      << "a page that ends within a picture";
  EXPECT_EQ(open(replaced(index_, "</style>", "a::after { content: none !important }</style>"), 1),
            1)
      << "links that lead nowhere on paper";
}

}  // namespace
}  // namespace recoil
