#include "document/html.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/quoting.hpp"
#include "support/command.hpp"
#include "support/hostile_names.hpp"
#include "support/temporary_folder.hpp"

namespace recoil {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Html, SetsSymbolsAndUnits) {
  EXPECT_EQ(html_of(say("{C_H} {f0} {V*} {a_eq} {e} {chi}")),
            "<i>C</i><sub>H</sub> <i>f</i><sub>0</sub> <i>V</i>* <i>a</i><sub>eq</sub> <i>e</i> "
            "chi");
  EXPECT_EQ(html_of(say("{+/-} 1 {um}, {J/m2}, {kg/m3}, {uN}")), "± 1 µm, J/m², kg/m³, µN");
  EXPECT_EQ(html_of(unit("m/s") + unit("um/s")), "m/sµm/s");
  EXPECT_EQ(html_of(symbol("C_A[a<b]")), "<i>C</i><sub>A</sub> <small>(a&lt;b)</small>");
  EXPECT_EQ(html_of(say("{d}{}", exponent("-0.83"))), "<i>d</i><sup>-0.83</sup>");
  EXPECT_EQ(html_of(Sentence("C_H um +/-")), "C_H um +/-")
      << "plain text is not searched for symbols";
  EXPECT_EQ(html_of(Sentence("(1.23 +/- 0.11)e-7 s/m, (a)e-7b")),
            "(1.23 ± 0.11) × 10<sup>−7</sup> s/m, (a)e-7b");
  EXPECT_EQ(html_of(Sentence("6.89 um, 3 +/- 1 J/m2 (p < 1e-6), -1.5e+08.")),
            "6.89 µm, 3 ± 1 J/m² (p &lt; 10<sup>−6</sup>), -1.5 × 10<sup>8</sup>.");
  EXPECT_EQ(html_of(Sentence("2.5e8 Pa, 4 umbrellas, 149d13e4, v1e5")),
            "2.5 × 10<sup>8</sup> Pa, 4 umbrellas, 149d13e4, v1e5");
}

TEST(Html, EscapesWhateverItIsGiven) {
  const std::string hostile = "<script>\"'&";
  const std::string safe = "&lt;script&gt;&quot;&#39;&amp;";
  Table table;
  table.caption = hostile;
  table.columns = {{hostile}, {hostile, hostile}};
  table.rows = {{hostile, Number{1.0, significant(1), 0.0, hostile}}};
  Document document;
  document.title = hostile;
  document.heading = hostile;
  document.subtitle = hostile;
  document.foot = hostile;
  document.foreword = {Banner{hostile, hostile}, Remark{hostile, hostile, hostile}};
  document.sections = {{hostile,
                        hostile,
                        hostile,
                        {table, Paragraph{strong(hostile)}, Paragraph{code(hostile)},
                         Paragraph{link(hostile, hostile)}, List{{hostile}},
                         Figures{{{hostile, hostile, hostile, "<svg/>"}}}},
                        hostile}};
  const std::string page = html_page(document);
  EXPECT_THAT(page, Not(HasSubstr("<script>")));
  EXPECT_THAT(page, HasSubstr(safe));
}

TEST(Html, ATableDropsColumnsThatSayNothing) {
  Table table;
  table.columns = {{"name"}, {"silent"}, {"value", "um"}, {"remark", "", true}};
  table.rows = {{"a", {}, Number{1.0, fixed(1)}, "words"},
                {"b", {}, Number{std::numeric_limits<double>::quiet_NaN()}, {}}};
  const std::string html = html_of(std::vector<Block>{table});
  EXPECT_THAT(html, Not(HasSubstr("silent")));
  EXPECT_THAT(html, HasSubstr("<th scope=\"col\">value [µm]</th>"));
  EXPECT_THAT(html,
              HasSubstr("<th scope=\"row\">a</th><td>1.0</td><td class=\"words\">words</td>"));
  EXPECT_THAT(html, HasSubstr("<td>n/a</td>"));
  EXPECT_THAT(html, Not(HasSubstr("nan")));
}

TEST(Html, LabelsOfStackedRowsHaveTheMarkupOfTheHeadings) {
  Table table;
  table.columns = {{"calibration"}, {symbol("C_H"), "s/m"}, {say("rms of {e}")}, {"points"}};
  table.rows = {{"two points", Number{1.0}, Number{2.0}, Number{3.0}}};
  const std::string html = html_of(std::vector<Block>{table});
  EXPECT_THAT(html, HasSubstr("<th scope=\"col\"><i>C</i><sub>H</sub> [s/m]</th>"));
  EXPECT_THAT(html, HasSubstr("<td><span class=\"label\"><i>C</i><sub>H</sub> [s/m]</span>1</td>"));
  EXPECT_THAT(html, HasSubstr("<span class=\"label\">rms of <i>e</i></span>2</td>"));
  const std::vector<Section> without_a_page = {{"a", "A", "", {table}}};
  EXPECT_THAT(html_of(without_a_page), Not(HasSubstr("label")));
}

TEST(Html, SectionsWithoutAPageHaveHeadings) {
  const std::vector<Section> sections = {{"a", "A", "", {Paragraph{"x"}}},
                                         {"b", "B", "", {List{}}}};
  EXPECT_EQ(html_of(sections), "<h3>A</h3>\n<p>x</p>\n");
}

TEST(Html, ContentsListWhatIsThere) {
  Document document;
  document.title = document.foot = "t";
  document.heading = "t";
  document.sections = {{"one", "One", "", {Paragraph{"x"}}}, {"absent", "Absent", "", {List{}}}};
  const std::string page = html_page(document);
  EXPECT_THAT(page, HasSubstr("<a href=\"#one\">One</a>"));
  EXPECT_THAT(page, Not(HasSubstr("absent")));
  document.cards = true;
  document.sections[0].address = "one.html";
  EXPECT_THAT(html_page(document), HasSubstr("<h2><a href=\"one.html\">One</a></h2>"));
}

TEST(Html, CarriesTheDataOfPicturesAsJsonWithoutMarkup) {
  Figure figure{"one", "", "A caption", "<svg viewBox=\"0 0 1 1\"></svg>"};
  figure.explored = R"({"name":"</script>"})";
  figure.csv = "a</script><b>,\"c\"\n1,,,,,2,,3,&\n";
  Document document;
  document.name = "my \"fit\"";
  document.script = "const mine = 1;\n";
  document.sections = {{"s", "S", {}, {Figures{{figure}}}}};
  const std::string page = html_page(document);
  EXPECT_THAT(page, HasSubstr("<script type=\"application/json\" class=\"csv\">\"a\\u003c/script>"
                              "\\u003cb>,\\\"c\\\"\\n1,,,,,2,,3,&\\n\"</script>"));
  EXPECT_THAT(page, HasSubstr("class=\"explore\">{\"name\":\"\\u003c/script>\"}</script>"));
  EXPECT_THAT(page, HasSubstr("const mine = 1;\n</script>\n</body>"));
  EXPECT_THAT(page, HasSubstr("<body data-name=\"my &quot;fit&quot;\">"));
}

TEST(Html, HostileNamesAreTextAndNothingReachesTheNetwork) {
  Document document;
  std::vector<Block> blocks;
  for (const std::string& name : support::hostile_names()) {
    Table table;
    table.caption = name;
    table.columns = {{name}, {name, name}};
    table.rows = {{Sentence(name), Sentence(name)}};
    blocks.emplace_back(Paragraph{Sentence(name) + link(name, url_path(name))});
    blocks.emplace_back(table);
    document.title = document.name = document.foot = name;
    document.heading = document.subtitle = name;
    document.sections = {{"s", name, name, blocks}};
  }
  const support::TemporaryFolder folder;
  folder.write("page.html", html_page(document));
  folder.write("read.py",
               "import html.parser\n"
               "class Reader(html.parser.HTMLParser):\n"
               "    def handle_starttag(self, tag, attributes):\n"
               "        assert tag not in ('script', 'img', 'iframe', 'object'), tag\n"
               "        for name, value in attributes:\n"
               "            assert not name.startswith('on'), name\n"
               "            assert name != 'href' or ':' not in value or value == 'data:,', value\n"
               "text = open('page.html', errors='surrogateescape').read()\n"
               "Reader().feed(text)\n"
               "policy = text.index('Content-Security-Policy')\n"
               "assert \"default-src 'none'\" in text[policy:policy + 300]\n"
               "assert policy < text.index('<style') and policy < text.index('<body')\n");
  const support::Outcome read = support::run_command({"python3", "read.py"}, folder.path());
  EXPECT_EQ(read.status, 0) << read.err;
}

TEST(Html, PageWithoutPicturesHasNoScript) {
  Document document;
  document.script = "never();";
  document.sections = {{"s", "S", {}, {Paragraph{"words"}}}};
  EXPECT_THAT(html_page(document), Not(HasSubstr("<script")));
}

}  // namespace
}  // namespace recoil
