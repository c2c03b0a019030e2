#include "validation/studies/markdown.hpp"

#include <gtest/gtest.h>

namespace recoil {
namespace {

TEST(Markdown, WritesATable) {
  Table table;
  table.caption = "Two rows";
  table.columns = {{"name"}, {"silent"}, {"value", "um"}, {"remark", "", true}};
  table.rows = {{symbol("C_H"), {}, Number{1.0, fixed(1)}, "a|b"}, {symbol("V*"), {}, {}, "c"}};
  EXPECT_EQ(markdown_of(std::vector<Block>{table}),
            "Two rows\n\n| name | value \\[um\\] | remark |\n|---|---:|---|\n"
            "| C_H | 1.0 | a\\|b |\n| V\\* | – | c |\n\n");
}

TEST(Markdown, WritesADocument) {
  Document document;
  document.heading = "Title";
  document.foreword = {Banner{"digitised", "From a figure."}};
  document.sections = {
      {"one", "One", "", {Paragraph{strong("So") + link("there", "x.md")}, List{{"a", code("b")}}}},
      {"none", "None", "", {List{}}}};
  EXPECT_EQ(markdown_page(document),
            "# Title\n\n> **digitised**: From a figure.\n\n## One\n\n**So**[there](x.md)\n\n"
            "- a\n- `b`\n");
}

}  // namespace
}  // namespace recoil
